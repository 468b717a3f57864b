#include "actors/results/formats/output_folder.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

std::string refusal(const fs::path& folder, const OutputPlan& plan = {}) {
  const auto claimed = OutputFolder::claim(folder, plan);
  REQUIRE_FALSE(claimed.ok());
  return claimed.problem().text();
}

}  // namespace

TEST_CASE("a claimed folder is made if missing, and removed if nothing was written", "[format]") {
  const test::TemporaryFolder scratch;
  const fs::path folder = scratch / "a" / "b";
  {
    const auto claimed = OutputFolder::claim(folder, {});
    REQUIRE(claimed.ok());
    CHECK(claimed->path() == fs::canonical(folder));
  }
  CHECK(scratch.entries() == 0);
  {
    const auto claimed = OutputFolder::claim(folder, {});
    REQUIRE(claimed.ok());
    REQUIRE(write_file_atomically(claimed->path() / "x", std::string_view("x")).ok());
  }
  CHECK(fs::exists(folder / "x"));
  CHECK(std::distance(fs::directory_iterator(folder), {}) == 1);  // the lock is gone
}

TEST_CASE("only one process at a time writes into a folder, and a second one is told which",
          "[format]") {
  const test::TemporaryFolder scratch;
  {
    const auto first = OutputFolder::claim(scratch.path(), {});
    REQUIRE(first.ok());
    CHECK_THAT(refusal(scratch.path()),
               Contains("process " + std::to_string(::getpid())) && Contains("writes into"));
  }
  CHECK(OutputFolder::claim(scratch.path(), {}).ok());
}

TEST_CASE("a folder is unlocked however its holder ends", "[format]") {
  const test::TemporaryFolder scratch;
  int told[2];
  REQUIRE(::pipe(told) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto claimed = OutputFolder::claim(scratch.path(), {});
    const char word = claimed.ok() ? 'y' : 'n';
    if (::write(told[1], &word, 1) == 1) ::pause();
    ::_exit(0);
  }
  char word = 0;
  REQUIRE(::read(told[0], &word, 1) == 1);
  REQUIRE(word == 'y');
  CHECK_THAT(refusal(scratch.path()), Contains("process " + std::to_string(child)));
  ::kill(child, SIGKILL);
  REQUIRE(::waitpid(child, nullptr, 0) == child);
  CHECK(OutputFolder::claim(scratch.path(), {}).ok());
  ::close(told[0]);
  ::close(told[1]);
}

TEST_CASE("anything but a plain file in the place of a result is refused before the work",
          "[format]") {
  const test::TemporaryFolder scratch;
  const OutputPlan plan{{"flux.lux", "views/door.png"}, {"views"}};
  CHECK(OutputFolder::claim(scratch.path(), plan).ok());
  fs::create_directory(scratch / "flux.lux");
  CHECK_THAT(refusal(scratch.path(), plan), Contains("flux.lux") && Contains("is a folder"));
  fs::remove(scratch / "flux.lux");
  fs::create_symlink("/dev/null", scratch / "flux.lux");
  CHECK_THAT(refusal(scratch.path(), plan), Contains("symbolic link"));
  fs::remove(scratch / "flux.lux");
  REQUIRE(::mkfifo((scratch / "flux.lux").c_str(), 0600) == 0);
  CHECK_THAT(refusal(scratch.path(), plan), Contains("device or a pipe"));
  fs::remove(scratch / "flux.lux");

  const test::TemporaryFolder elsewhere;
  fs::create_directory_symlink(elsewhere.path(), scratch / "views");
  CHECK_THAT(refusal(scratch.path(), plan), Contains("views") && Contains("symbolic link"));
  fs::remove(scratch / "views");
  std::ofstream(scratch / "views") << "x";
  CHECK_THAT(refusal(scratch.path(), plan), Contains("views") && Contains("a file"));
}

TEST_CASE("a folder that cannot be made or written is named with the system's reason", "[format]") {
  const test::TemporaryFolder scratch;
  std::ofstream(scratch / "file") << "x";
  CHECK_THAT(refusal(scratch / "file"), Contains("file: cannot make this folder"));
  CHECK_THAT(refusal(scratch / "file" / "below"), Contains("Not a directory"));
  CHECK_THAT(refusal("/proc/luxodus"), Contains("cannot make this folder"));
  // A lock file that is a link is not followed.
  fs::create_symlink(scratch / "file", scratch / ".luxodus.lock");
  CHECK_THAT(refusal(scratch.path()), Contains("cannot write into this folder"));
}

TEST_CASE("a folder that its user has made a link is followed, once", "[format]") {
  const test::TemporaryFolder scratch;
  fs::create_directory(scratch / "disk");
  fs::create_directory_symlink("disk", scratch / "out");
  const auto claimed = OutputFolder::claim(scratch / "out", {});
  REQUIRE(claimed.ok());
  CHECK(claimed->path() == fs::canonical(scratch / "disk"));
  CHECK(claimed->named() == scratch / "out");
}

TEST_CASE("a test of whether a file can be written leaves nothing", "[format]") {
  const test::TemporaryFolder scratch;
  CHECK(check_output_file(scratch / "a.luxpack").ok());
  CHECK(scratch.entries() == 0);
  CHECK_FALSE(check_output_file(scratch / "none" / "a.luxpack").ok());
  CHECK_FALSE(check_output_file(scratch.path()).ok());
}
