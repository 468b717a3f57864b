#include "runtime/core/regular_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

namespace {

std::string refusal(const fs::path& path) {
  const auto read = read_regular_file(path, 100);
  REQUIRE_FALSE(read.ok());
  CHECK(read.problem().where.file == path.string());
  return read.problem().what;
}

}  // namespace

TEST_CASE("a file is read whole, up to its limit", "[core][files]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "a";
  for (const size_t bytes : {size_t{0}, size_t{1}, size_t{99}, size_t{100}}) {
    std::ofstream(file, std::ios::binary) << std::string(bytes, 'x');
    const auto read = read_regular_file(file, 100);
    REQUIRE(read.ok());
    CHECK(read.value() == std::string(bytes, 'x'));
  }
  std::ofstream(file, std::ios::binary) << std::string(101, 'x');
  CHECK(refusal(file).find("longer than 100 bytes") != std::string::npos);
  CHECK(read_regular_file("/proc/self/status", 1 << 20).ok());  // it reports 0 bytes
}

TEST_CASE("a file that cannot be reached is told by what the system says", "[core][files]") {
  const test::TemporaryFolder folder;
  const auto problem_of = [](const fs::path& path) {
    const auto size = size_of_regular_file(path);
    REQUIRE_FALSE(size.ok());
    return size.problem();
  };
  std::ofstream(folder / "a") << "four";
  CHECK(size_of_regular_file(folder / "a").value() == 4);
  CHECK(problem_of(folder / "absent").what == "there is no such file");
  CHECK(problem_of(folder / "absent").kind == ProblemKind::not_found);
  CHECK(problem_of(folder.path()).what.find("Is a directory") != std::string::npos);
  fs::create_symlink("loop", folder / "loop");
  CHECK(problem_of(folder / "loop").what.find("Too many levels") != std::string::npos);
  if (::geteuid() == 0) {
    WARN("the superuser is denied no file");
    return;
  }
  fs::permissions(folder / "a", fs::perms::none);
  CHECK(problem_of(folder / "a").what.find("Permission denied") != std::string::npos);
  CHECK(problem_of(folder / "a").kind == ProblemKind::refused);
}

TEST_CASE("anything but a regular file is rejected without waiting", "[core][files]") {
  const test::TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(refusal(pipe).find("a pipe, a socket or a device") != std::string::npos);
  CHECK(refusal("/dev/zero").find("a pipe, a socket or a device") != std::string::npos);
  CHECK(refusal(folder.path()).find("Is a directory") != std::string::npos);
  CHECK(refusal(folder / "absent").find("No such file") != std::string::npos);
  CHECK(refusal(folder / std::string("a\0b", 3)).find("zero byte") != std::string::npos);
}
