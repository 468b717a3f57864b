// A room with one luminaire and one sign, for tests of assessments.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "actors/judge/assess/record_assessment.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/room_texts.hpp"

namespace luxodus::test {

/// 12 m by 4 m by 3 m, black; a lamp above the middle, a sign at the end.
inline const std::string room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "black5"

[[object]]
name = "table"
shape = "box"
low = [8.6, -0.4, 0.7]
high = [9.4, 0.4, 0.75]
material = "grey50"
tags = ["furniture"]
)" + middle_lamp + exit_sign_at("[11.95, 0, 2.2]") +
                                "lighting = \"internal\"\n" +
                                judged_way("[[1, 0, 0], [11, 0, 0]]", "1.6");

inline Result<Assessment> tried(const std::string& text, AssessOptions options = {}) {
  static const std::atomic<bool> nobody{false};
  if (options.rules.empty()) options.rules = {"en1838-2013"};
  return assess(described_text(text), options, nobody, [](const std::string&, double) {});
}

inline Assessment assessed(const std::string& text, const AssessOptions& options = {}) {
  auto result = tried(text, options);
  INFO((result.ok() ? "" : result.problem().text()));
  REQUIRE(result.ok());
  return std::move(result).value();
}

/// The record of its assessment, by version "1.2.3" of the program.
inline AssessmentRecord recorded(const std::string& text, const AssessOptions& options = {}) {
  return record_of(*described_text(text), assessed(text, options), "1.2.3");
}

/// The first check of a rule.
inline const Check& check_of(const Assessment& a, RuleId id) {
  for (const Check& check : a.checks)
    if (check.rule.id == id) return check;
  FAIL("no check");
  return a.checks.front();
}

/// Ten steps of 0.17 m by 0.28 m from x = 4 to 6.8 m in a black room, and the landing at their end.
/// `underside`: of the steps, as the scene file names it.
inline std::string stair_room(const std::string& underside) {
  return R"(
[[object]]
name = "room"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 5]
material = "black5"
[[object]]
name = "steps"
shape = "stairs"
material = "grey50"
steps = 10
rise = 0.17
going = 0.28
width = 4
translate = [4, -2, 0]
underside = ")" +
         underside +
         R"("
[[object]]
name = "landing"
shape = "box"
low = [6.8, -2, 0]
high = [12, 2, 1.7]
material = "grey50"
[[scenario]]
name = "failed"
operation = "emergency"
)";
}

/// A point source of 1000 lm, whose emergency flux of 500 lm is the rated one. `position` in the
/// scene file's syntax.
inline std::string rated_lamp(const std::string& name, const std::string& position) {
  return "\n[[emitter]]\nname = \"" + name + R"("
shape = "point"
distribution = "isotropic"
position = )" +
         position + R"(
flux_lm = 1000
emergency = "non-maintained"
emergency_flux = 500
maintenance_factor = 1
emergency_flux_is = "rated"
)";
}

inline std::string with_smoke(double extinction, double albedo) {
  return room + "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = " +
         std::to_string(extinction) + "\nalbedo = " + std::to_string(albedo) + "\n";
}

inline AssessOptions codes_alone() {
  AssessOptions options;
  options.reality = false;
  return options;
}

}  // namespace luxodus::test
