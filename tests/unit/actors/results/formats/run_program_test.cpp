// External programs: their exit codes, their folder, and their output.
#include "actors/results/formats/run_program.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("a program's exit code and the end of its output are kept", "[output]") {
  const TemporaryFolder folder;
  const auto said = folder / "said.txt";
  const auto well = run_program({"sh", "-c", "exit 0"}, said);
  REQUIRE(well.ok());
  CHECK(well.value() == 0);
  CHECK(last_words(said).empty());
  const auto badly = run_program({"sh", "-c", "echo out; echo no room for it >&2; exit 3"}, said);
  REQUIRE(badly.ok());
  CHECK(badly.value() == 3);
  CHECK(last_words(said) == ", which said: out\nno room for it\n");
  // Only the end of a long output is repeated.
  REQUIRE(run_program({"sh", "-c", "yes | head -c 9000; echo end"}, said).ok());
  CHECK(last_words(said).size() < 4100);
  CHECK(last_words(said).ends_with("end\n"));
}

TEST_CASE("a missing program is distinguished from one that fails", "[output]") {
  const TemporaryFolder folder;
  const auto said = folder / "said.txt";
  CHECK(run_program({"there-is-no-such-program"}, said).value() == -1);
  const auto killed = run_program({"sh", "-c", "kill -9 $$"}, said);
  REQUIRE_FALSE(killed.ok());
  CHECK(killed.problem().what.find("ended by a signal") != std::string::npos);
}

TEST_CASE("a program runs in the given folder, without input", "[output]") {
  const TemporaryFolder folder;
  const auto inner = folder / "50%06d";
  std::filesystem::create_directory(inner);
  const auto ran = run_program({"sh", "-c", "cat > here.txt"}, folder / "said.txt", inner);
  REQUIRE(ran.ok());
  CHECK(ran.value() == 0);
  CHECK(std::filesystem::exists(inner / "here.txt"));
  CHECK(std::filesystem::file_size(inner / "here.txt") == 0);
}
