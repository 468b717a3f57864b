#include "runtime/core/result.hpp"

#include <catch2/catch.hpp>
#include <cerrno>

#include "runtime/core/printable.hpp"

using namespace luxodus;

TEST_CASE("a problem prints as file:line: sentence, and without a line as file: sentence",
          "[core]") {
  CHECK(Problem{{"a.toml", 7}, "unknown key"}.text() == "a.toml:7: unknown key");
  CHECK(Problem{{"a.png", 0}, "not a PNG"}.text() == "a.png: not a PNG");
  CHECK(Problem{{}, "no scene given"}.text() == "no scene given");
}

TEST_CASE("a problem's text is one line without terminal control characters", "[core]") {
  const std::string nul(1, '\0');
  CHECK(Problem{{"a.toml", 1}, "no '\x1b[31m" + nul + "\n\x7f'"}.text() ==
        "a.toml:1: no '\\x1B[31m\\x00\\x0A\\x7F'");
  CHECK(Problem{{"evil\nname", 0}, "x"}.text() == "evil\\x0Aname: x");
  CHECK(Problem{{}, "\xC2\x9B[2J"}.text() == "\\xC2\\x9B[2J");
  const std::string umlauts = "\xC3\xA4 \xC2\xB0 \xE2\x82\xAC \xC2";  // the last is cut off
  CHECK(Problem{{}, umlauts}.text() == umlauts);
}

TEST_CASE("printable text keeps the characters that its layout needs", "[core]") {
  CHECK(printable("a\tb\n\x1b[2J", "\n\t") == "a\tb\n\\x1B[2J");
  CHECK(printable("\xC2\x9B", "\n\t") == "\\xC2\\x9B");
}

TEST_CASE("a result holds either its value or its problem", "[core]") {
  Result<int> good = 3;
  Result<int> bad = Problem{{}, "no"};
  REQUIRE(good.ok());
  CHECK(good.value() == 3);
  REQUIRE_FALSE(bad.ok());
  CHECK(bad.problem().what == "no");
}

TEST_CASE("a problem is of wrong input unless somebody says another kind, and keeps it", "[core]") {
  CHECK(problem("no").kind == ProblemKind::bad_input);
  CHECK(problem_in("a.toml", 3, "no").kind == ProblemKind::bad_input);
  const Problem full = problem("no space", ProblemKind::no_room);
  CHECK(problem_in("out", full).kind == ProblemKind::no_room);
  CHECK(problem_in("out", full).text() == "out: no space");
  CHECK(problem_in("out", 4, full).where.line == 4);
  CHECK(problem_in(SourcePlace{"out", 4}, full).kind == ProblemKind::no_room);
}

TEST_CASE("what the system says decides the kind of its problems", "[core]") {
  const auto kind = [](int error) { return system_problem("f", "cannot", error).kind; };
  CHECK(kind(ENOENT) == ProblemKind::not_found);
  CHECK(kind(ENOTDIR) == ProblemKind::not_found);
  CHECK(kind(EISDIR) == ProblemKind::bad_input);
  for (const int error : {EACCES, EPERM, EROFS, EADDRINUSE})
    CHECK(kind(error) == ProblemKind::refused);
  for (const int error : {ENOSPC, EDQUOT, ENOMEM, EMFILE, EFBIG})
    CHECK(kind(error) == ProblemKind::no_room);
  CHECK(kind(ECONNREFUSED) == ProblemKind::lost_peer);
  CHECK(kind(EIO) == ProblemKind::system);
  CHECK(system_problem("f", "cannot", EACCES).text() == "f: cannot: Permission denied");
}

TEST_CASE("problems together are of wrong input where one of them is", "[core]") {
  Problems found;
  found.add(problem("no", ProblemKind::refused));
  found.add(problem("full", ProblemKind::no_room));
  CHECK(found.kind() == ProblemKind::refused);
  found.add(problem("it is not there", ProblemKind::not_found));
  CHECK(found.kind() == ProblemKind::bad_input);
}

TEST_CASE("an excerpt is short and has only valid characters", "[core]") {
  CHECK(excerpt("LM-63-1999") == "LM-63-1999");
  CHECK(excerpt("\x1b[31mred\n") == "\\x1B[31mred\\x0A");
  CHECK(excerpt("Lampe \xC3\xA4 \xC2\x9B") == "Lampe \xC3\xA4 \\xC2\\x9B");
  CHECK(excerpt("\xFF\xC3") == "\\xFF\\xC3");  // no UTF-8
  CHECK(excerpt(std::string(60, 'a')) == std::string(60, 'a'));
  CHECK(excerpt(std::string(1000, 'a')) == std::string(60, 'a') + "...");
  // No character is split.
  CHECK(excerpt(std::string(59, 'a') + "\xC3\xA4") == std::string(59, 'a') + "...");
}
