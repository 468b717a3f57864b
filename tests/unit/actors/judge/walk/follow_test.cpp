// Steps, fields of view, signs on the way, and people in front of signs.
#include "actors/judge/walk/follow.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/emergency/adaptation.hpp"
#include "tests/unit/actors/judge/walk/walk_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// A person followed through the hall, where every sign gives the same answer at all times but
/// those in `instead`.
std::vector<WalkedPerson> followed(const std::vector<PlacedPerson>& people,
                                   const WalkOptions& options, SignAnswer always,
                                   const std::vector<std::pair<double, SignAnswer>>& instead = {}) {
  const auto scene = described_text(hall_text);
  auto walks = begin_walks(people, options);
  FoundAtEyes found;
  for (const TimedEye& eye : eyes_of(walks)) {
    SignAnswer answer = always;
    for (const auto& [time, other] : instead)
      if (eye.time_s == time) answer = other;
    found.answers.insert(found.answers.end(), scene->signs.size(), answer);
    found.extinctions.push_back(0.1 * eye.time_s);
  }
  look(*scene, people, options, found, {.at_s = 2, .since_s = {}}, walks);
  return walks;
}

}  // namespace

TEST_CASE("steps are multiples of the step on the scene's clock", "[walk]") {
  PlacedPerson one = walker_from({0, 0, 0}, {1, 0, 0}, 4);
  CHECK(step_times(one, 1) == std::vector<double>{0, 1, 2, 3, 4});
  CHECK_FALSE(std::signbit(step_times(one, 1).front()));
  one.times_s = {0.4, 2.2};
  CHECK(step_times(one, 1) == std::vector<double>{1, 2});
  CHECK(step_times(one, 0.5) == std::vector<double>{0.5, 1, 1.5, 2});
  one.times_s = {0.4, 0.7};
  CHECK(step_times(one, 1) == std::vector<double>{0.4});
}

TEST_CASE("a sign is in the field of view within half of it on each side, in plan", "[walk]") {
  const glm::dvec3 eye(0, 0, 1.6);
  CHECK(in_field_of_view(eye, {1, 0}, {1, 1.7, 9}, 120));
  CHECK_FALSE(in_field_of_view(eye, {1, 0}, {1, 1.8, 1.6}, 120));
  CHECK_FALSE(in_field_of_view(eye, {1, 0}, {-1, 0, 1.6}, 120));
  CHECK(in_field_of_view(eye, {0, 0}, {-1, 0, 1.6}, 120));  // who never moves looks around
  CHECK(in_field_of_view(eye, {1, 0}, {0, 0, 3}, 120));     // straight above
}

TEST_CASE("signs of the routes ahead belong on the way, and without routes all do", "[walk]") {
  auto scene = *described_text(hall_text);
  const auto lead_past = [&](size_t sign, const glm::dvec3& foot) {
    const SignView view = view_of_sign(scene.signs[sign], foot + glm::dvec3(0, 0, 1.6));
    return WaysAhead(scene, foot).lead_past(scene.signs[sign], view);
  };
  CHECK(lead_past(0, {5, 3, 0}));
  CHECK_FALSE(lead_past(1, {5, 3, 0}));
  CHECK_FALSE(lead_past(0, {5, 3, 5}));     // of another storey
  CHECK_FALSE(lead_past(0, {20.5, 3, 0}));  // from behind
  scene.routes.clear();
  CHECK(lead_past(1, {5, 3, 0}));
}

TEST_CASE("more steps than the limit are refused before any is made", "[walk]") {
  PlacedPerson one = walker_from({2, 3, 0}, {7, 3, 0}, 5);
  CHECK(check_steps({one, one}, 1, "hall.toml").ok());
  one.times_s = {-1e7, 1e7};
  CHECK_THAT(check_steps({one}, 1, "hall.toml").problem().text(),
             Catch::Contains("hall.toml: the people take 20000001 steps of 1 s; at most 1000000"));
  CHECK(check_steps({one}, 3600, "hall.toml").ok());
  // Two people of one place each take two steps, and the curve has all the times between them.
  PlacedPerson early = one, late = one;
  early.times_s = {-1e7};
  late.times_s = {1e7};
  early.feet = late.feet = {{2, 3, 0}};
  CHECK_THAT(check_steps({early, late}, 1, "hall.toml").problem().text(),
             Catch::Contains("from -1e+07 to 1e+07 s, more than 1000000 steps of 1 s"));
  CHECK(check_steps({early, late}, 100, "hall.toml").ok());
  // Where only their sum is too large.
  one.times_s = {0, 6e5};
  CHECK(check_steps({one}, 1, "hall.toml").ok());
  CHECK_THAT(check_steps({one, one}, 1, "hall.toml").problem().text(),
             Catch::Contains("the people take 1200002 steps"));
}

TEST_CASE("each step has its answers, and the time since a sign was read", "[walk]") {
  const auto walks = followed({walker_from({2, 3, 0}, {7, 3, 0}, 5)}, {}, SignAnswer::read,
                              {{2, SignAnswer::seen}, {3, SignAnswer::undecided}});
  REQUIRE(walks.size() == 1);
  const auto& steps = walks[0].steps;
  REQUIRE(steps.size() == 6);
  CHECK(glm::distance(steps[1].eye, glm::dvec3(3, 3, 1.6)) < 1e-12);
  CHECK(glm::distance(steps[1].facing, glm::dvec2(1, 0)) < 1e-12);
  REQUIRE(steps[1].signs.size() == 1);  // not that which leads elsewhere
  CHECK(steps[1].signs[0].sign == 0);
  CHECK(steps[1].reads());
  CHECK(steps[2].count(SignAnswer::seen) == 1);
  CHECK_FALSE(steps[2].reads());
  std::vector<double> unread;
  for (const WalkStep& step : steps) unread.push_back(step.unread_s);
  CHECK(unread == std::vector<double>{0, 0, 1, 2, 0, 0});
  CHECK(steps[3].extinction_per_m == Approx(0.3));
}

TEST_CASE("who turns away sees no sign", "[walk]") {
  const auto walks = followed({walker_from({7, 3, 0}, {2, 3, 0}, 5)}, {}, SignAnswer::read);
  for (const WalkStep& step : walks[0].steps) CHECK(step.signs.empty());
  CHECK(walks[0].steps.back().unread_s == 5);
}

TEST_CASE("eyes have what the light before the failure has bleached", "[walk]") {
  PlacedPerson one = walker_from({2, 3, 0}, {7, 3, 0}, 5);
  one.luminance_before_cd_m2 = 400;
  const auto walks = followed({one}, {}, SignAnswer::read);
  CHECK(walks[0].steps[1].bleached_cd_m2 == 0);  // the mains fail at 2 s
  CHECK(walks[0].steps[2].bleached_cd_m2 == equivalent_background(400, 0));
  CHECK(walks[0].steps[5].bleached_cd_m2 == equivalent_background(400, 3));
  CHECK(MainsFailure{.at_s = {}, .since_s = 30}.since(5) == 30.0);
  CHECK_FALSE(MainsFailure{}.since(5));
}

TEST_CASE("people hide a low sign from those behind them, and not a high one", "[walk]") {
  auto scene = *described_text(hall_text);
  Sign& sign = scene.signs[0];
  sign.frame.origin.z = 1.5;
  PlacedPerson other = walker_from({8, 3, 0}, {8, 3, 0}, 10);
  const std::vector<const PlacedPerson*> others{&other};
  const glm::dvec3 eye(5, 3, 1.6);
  CHECK(people_hide(sign, view_of_sign(sign, eye), eye, others, 1));
  // Behind the eye, beside the line, and one storey below nobody hides.
  other.feet = {{4, 3, 0}, {4, 3, 0}};
  CHECK_FALSE(people_hide(sign, view_of_sign(sign, eye), eye, others, 1));
  other.feet = {{8, 4, 0}, {8, 4, 0}};
  CHECK_FALSE(people_hide(sign, view_of_sign(sign, eye), eye, others, 1));
  other.feet = {{8, 3, -3}, {8, 3, -3}};
  CHECK_FALSE(people_hide(sign, view_of_sign(sign, eye), eye, others, 1));
  // A sign at 2.9 m is seen over a head that is 3 m before the eye.
  other.feet = {{8, 3, 0}, {8, 3, 0}};
  sign.frame.origin.z = 2.9;
  CHECK_FALSE(people_hide(sign, view_of_sign(sign, eye), eye, others, 1));
}

TEST_CASE("with --crowd-hides a sign behind a person is hidden", "[walk]") {
  PlacedPerson tall = walker_from({6, 3, 0}, {11, 3, 0}, 5);
  tall.eye_height_m = 2.4;  // a head above the line to the sign
  const std::vector<PlacedPerson> people{walker_from({5, 3, 0}, {10, 3, 0}, 5), tall};
  WalkOptions options;
  CHECK(followed(people, options, SignAnswer::read)[0].steps[1].reads());
  options.crowd_hides = true;
  const auto walks = followed(people, options, SignAnswer::read);
  const WalkStep& step = walks[0].steps[1];
  REQUIRE(step.signs.size() == 1);
  CHECK(step.signs[0].answer == SignAnswer::hidden);
  CHECK(step.signs[0].hidden_by_people);
  CHECK(walks[1].steps[1].reads());  // who is in front
}
