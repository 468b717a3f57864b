#include "runtime/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <string>

#include "runtime/core/output_path.hpp"
#include "runtime/core/regular_file.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

std::string read(const std::filesystem::path& path) {
  Result<std::vector<std::byte>> bytes = read_whole_file(path, 1 << 24);
  REQUIRE(bytes.ok());
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

bool says(const Problem& problem, const std::string& part) {
  INFO(problem.text());
  return problem.text().find(part) != std::string::npos;
}

/// Limits file sizes of this process, like a disk that is full after so many bytes.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : before_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, before_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*before_handler_)(int);
};

}  // namespace

TEST_CASE("a file reads back as written, and leaves nothing else in the folder", "[format]") {
  const test::TemporaryFolder folder;
  const std::string text("line\n\0\xff end", 11);
  REQUIRE(write_file_atomically(folder / "a.txt", std::string_view(text)).ok());
  CHECK(read(folder / "a.txt") == text);
  REQUIRE(write_file_atomically(folder / "a.txt", std::string_view("")).ok());
  CHECK(read(folder / "a.txt").empty());
  const std::string large(5 << 20, 'x');
  REQUIRE(write_file_atomically(folder / "a.txt", std::string_view(large)).ok());
  CHECK(read(folder / "a.txt") == large);
  CHECK(folder.entries() == 1);
}

TEST_CASE("a file may have any name that the system accepts", "[format]") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> names = {
      "ä ö ü.txt",   "with space", "new\nline", "\xff\xfe", "-rf",
      "a'b\"c<d>&e", "%s%n",       "*?[]$(x)`", ".hidden",  std::string(255, 'n')};
  for (const std::string& name : names) {
    REQUIRE(write_file_atomically(folder / name, std::string_view(name)).ok());
    CHECK(read(folder / name) == name);
  }
  CHECK(folder.entries() == names.size());
}

TEST_CASE("a full disk leaves the old file, no new one, and gives the reason", "[format]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_file_atomically(folder / "a.txt", std::string_view("old")).ok());
  {
    const FileSizeLimit limit(1000);
    const std::string large(100000, 'x');
    const auto over = write_file_atomically(folder / "a.txt", std::string_view(large));
    REQUIRE_FALSE(over.ok());
    CHECK(over.problem().where.file == (folder / "a.txt").string());
    CHECK(says(over.problem(), "File too large"));
    CHECK_FALSE(write_file_atomically(folder / "b.txt", std::string_view(large)).ok());
  }
  CHECK(read(folder / "a.txt") == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a target that cannot be written is reported with the system's reason", "[format]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_file_atomically(folder / "file", std::string_view("x")).ok());
  const auto reason = [](const std::filesystem::path& path) {
    const auto result = write_file_atomically(path, std::string_view("text"));
    REQUIRE_FALSE(result.ok());
    CHECK(result.problem().where.file == path.string());
    return result.problem().what;
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(reason(folder / "none" / "a.txt"), Contains("No such file or directory"));
  CHECK_THAT(reason(folder / "file" / "a.txt"), Contains("Not a directory"));
  CHECK_THAT(reason(folder.path()), Contains("this is a folder"));
  CHECK_THAT(reason(folder.path() / ""), Contains("no file is named"));
  CHECK_THAT(reason(""), Contains("no file is named"));
  CHECK_THAT(reason(folder / std::string(256, 'n')), Contains("File name too long"));
  CHECK_THAT(reason(folder / std::string("a\0b", 3)), Contains("zero byte"));
  CHECK_THAT(reason("/dev/null"), Contains("device"));
  CHECK_THAT(reason("/proc/luxodus"), Contains("cannot write this file"));
  CHECK(folder.entries() == 1);
}

TEST_CASE("a folder without write permission is rejected, except for root", "[format]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "locked");
  ::chmod((folder / "locked").c_str(), 0555);
  const auto result = write_file_atomically(folder / "locked" / "a", std::string_view("x"));
  if (::geteuid() == 0) {
    CHECK(result.ok());
  } else {
    REQUIRE_FALSE(result.ok());
    CHECK(says(result.problem(), "Permission denied"));
  }
  ::chmod((folder / "locked").c_str(), 0755);
}

TEST_CASE("a replaced file keeps its permissions, and no link is followed", "[format]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_file_atomically(folder / "real", std::string_view("1")).ok());
  ::chmod((folder / "real").c_str(), 0640);
  REQUIRE(write_file_atomically(folder / "real", std::string_view("2")).ok());
  struct stat about {};
  REQUIRE(::stat((folder / "real").c_str(), &about) == 0);
  CHECK((about.st_mode & 0777) == 0640);

  std::filesystem::create_symlink("real", folder / "link");
  std::filesystem::create_symlink("nowhere", folder / "dangling");
  for (const char* link : {"link", "dangling"}) {
    const auto refused = write_file_atomically(folder / link, std::string_view("3"));
    REQUIRE_FALSE(refused.ok());
    CHECK(says(refused.problem(), "symbolic link"));
    CHECK(std::filesystem::is_symlink(folder / link));
  }
  CHECK(read(folder / "real") == "2");
  CHECK_FALSE(std::filesystem::exists(folder / "nowhere"));
}

TEST_CASE("a folder that is a link is not written into unless its user resolves it", "[format]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "real");
  std::filesystem::create_directory_symlink("real", folder / "link");
  const std::filesystem::path file = folder / "link" / "a";
  const auto refused = write_file_atomically(file, std::string_view("1"));
  REQUIRE_FALSE(refused.ok());
  CHECK(says(refused.problem(), "its folder is a symbolic link"));
  CHECK(std::filesystem::is_empty(folder / "real"));
  REQUIRE(write_file_atomically(behind_links(file), std::string_view("1")).ok());
  CHECK(read(folder / "real" / "a") == "1");
}

TEST_CASE("a writer that is killed leaves nothing", "[format]") {
  const test::TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    auto file = AtomicFile::create(folder / "a");
    if (file.ok()) file->write(std::as_bytes(std::span("half of it", 10)));
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  // On file systems without unnamed files the next cleaner removes the rest.
  remove_stale_temporaries(folder.path());
  CHECK(folder.entries() == 0);
}

TEST_CASE("stale temporary files are removed, those of living writers and of others are not",
          "[format]") {
  const test::TemporaryFolder folder;
  const auto make = [&](const char* name) {
    return ::open((folder / name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  };
  const int living = make(".luxodus-1-0.tmp");
  REQUIRE(::flock(living, LOCK_EX | LOCK_NB) == 0);
  for (const char* name : {".luxodus-999999-3.tmp", "mine.tmp", ".luxodus-notes"})
    ::close(make(name));
  remove_stale_temporaries(folder.path());
  CHECK(std::filesystem::exists(folder / ".luxodus-1-0.tmp"));
  CHECK_FALSE(std::filesystem::exists(folder / ".luxodus-999999-3.tmp"));
  CHECK(std::filesystem::exists(folder / "mine.tmp"));
  CHECK(std::filesystem::exists(folder / ".luxodus-notes"));
  ::close(living);
}

TEST_CASE("a reader gets a whole file up to its limit and rejects a longer one", "[format]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_file_atomically(folder / "a", std::string_view("12345")).ok());
  CHECK(read_whole_file(folder / "a", 5).ok());
  const auto longer = read_whole_file(folder / "a", 4);
  REQUIRE_FALSE(longer.ok());
  CHECK(says(longer.problem(), "longer than 4 bytes"));
  CHECK_FALSE(read_whole_file("/dev/zero", 100000).ok());  // its size is unlimited
  CHECK(says(read_whole_file(folder / "none", 5).problem(), "No such file"));
  CHECK(says(read_whole_file(folder.path(), 5).problem(), "Is a directory"));
}
