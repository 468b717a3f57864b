#include "runtime/core/file_stamp.hpp"

#include <fcntl.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "runtime/core/file_descriptor.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Marks the stamp as of a file written well before.
FileStamp settled(FileStamp stamp) {
  stamp.sure = true;
  return stamp;
}

/// Writes the same number of bytes until the file system's clock has advanced since the stamp.
void write_later(const TemporaryFolder& folder, const FileStamp& before) {
  FileStamp now = before;
  while (now.changed_ns == before.changed_ns) now = stamp_at(folder.write("a", "other bytes"));
}

}  // namespace

TEST_CASE("a file that has not changed since well before its stamp has the same stamp",
          "[runtime]") {
  // Installed with the system, and thus older than any test.
  const FileStamp shell = stamp_at("/bin/sh");
  CHECK(shell.sure);
  CHECK(shell.bytes > 0);
  CHECK(shell.same_as(stamp_at("/bin/sh")));
  const TemporaryFolder folder;
  const auto path = folder.write("a", "first bytes");
  const FileStamp before = settled(stamp_at(path));
  CHECK(before.bytes == 11);
  CHECK(before.same_as(stamp_at(path)));
  // The path by which it is reached does not matter.
  std::filesystem::create_symlink(path, folder / "link");
  CHECK(before.same_as(stamp_at(folder / "link")));
  const FileDescriptor open(::open(path.c_str(), O_RDONLY));
  CHECK(before.same_as(stamp_of(open.number())));
  CHECK_FALSE(stamp_of(-1).sure);
}

TEST_CASE("the stamp of a file that was written just now is not sure", "[runtime]") {
  const TemporaryFolder folder;
  const FileStamp now = stamp_at(folder.write("a", "first bytes"));
  CHECK_FALSE(now.sure);
  CHECK_FALSE(now.same_as(now));
}

TEST_CASE("a write, another length and another file of the same name change the stamp",
          "[runtime]") {
  const TemporaryFolder folder;
  const auto path = folder.write("a", "first bytes");
  const FileStamp before = settled(stamp_at(path));
  SECTION("as many bytes, and the time of writing set back") {
    const auto written = std::filesystem::last_write_time(path);
    write_later(folder, before);
    std::filesystem::last_write_time(path, written);
    CHECK(stamp_at(path).bytes == before.bytes);
    CHECK_FALSE(before.same_as(stamp_at(path)));
  }
  SECTION("more bytes") {
    folder.write("a", "first bytes and more");
    CHECK_FALSE(before.same_as(stamp_at(path)));
  }
  SECTION("another file is renamed to it") {
    std::filesystem::rename(folder.write("b", "first bytes"), path);
    CHECK(stamp_at(path).inode != before.inode);
    CHECK_FALSE(before.same_as(stamp_at(path)));
  }
  SECTION("it is removed") {
    std::filesystem::remove(path);
    CHECK_FALSE(before.same_as(stamp_at(path)));
    CHECK_FALSE(stamp_at(path).sure);
  }
}
