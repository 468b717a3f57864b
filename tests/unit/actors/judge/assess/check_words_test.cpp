#include "actors/judge/assess/check_words.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/texts/texts.hpp"

using namespace luxodus;

TEST_CASE("the line of a check has no empty brackets, and no unit or value that it lacks",
          "[assess]") {
  Check check;
  check.rule.id = RuleId::E4;
  check.subject = {SubjectKind::route, "stairs"};
  check.value = 116;
  check.limit = 40;
  check.at_least = false;
  check.unit = "1";
  const std::string title = english().rule_title("E4");
  CHECK(check_words(check) == "route \"stairs\": " + title + ": 116, at most 40 (E4)");
  check.value.reset();
  CHECK(check_words(check) == "route \"stairs\": " + title + ": no value, at most 40 (E4)");
  check.reasons = {remark(RemarkId::no_sign_ahead)};
  check.conditions = {remark(RemarkId::without_furniture)};
  CHECK(check_words(check) == "route \"stairs\": " + title +
                                  ": no sign ahead faces this place, at most 40 (E4, without "
                                  "furniture)");
  check.value = 1.25;
  check.unit = "of the viewing distance";
  check.limit.reset();
  CHECK(check_words(check).find("1.25 of the viewing distance (E4") != std::string::npos);
  check.unit = "lx";
  CHECK(check_words(check).find("1.25 lx (E4") != std::string::npos);
}
