#include "scenes/emergency/legibility.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "scenes/light/signs/sign_face.hpp"

using namespace luxodus;

namespace {

/// 0.3 m by 0.15 m, half white, half green, details of 15 mm, seen along its normal.
Sign two_coloured() {
  Sign sign;
  sign.width_m = 0.3;
  sign.height_m = 0.15;
  sign.smallest_detail_m = 0.015;
  sign.face.width = 2;
  sign.face.height = 1;
  sign.face.colour = {0, 1};
  return sign;
}

/// Clear air: white 50, green 10, wall 1 cd/m2.
SignLook clear() {
  SignLook look;
  look.legend = {50, 0.1};
  look.ground = {10, 0.1};
  look.difference = {40, 0.1};
  look.face = {30, 0.1};
  look.surround = {1, 0.05};
  look.silhouette = {29, 0.11};
  return look;
}

Sight judged_at(double distance_m, const SignLook& look, SightRules rules = {}) {
  const Sign sign = two_coloured();
  return judge_sight(sign, view_of_sign(sign, {0, 0, distance_m}), look, rules);
}

}  // namespace

TEST_CASE("a bright sign is read nearby, seen from far away, and lost behind smoke",
          "[emergency][legibility]") {
  CHECK(judged_at(10, clear()).verdict == SightVerdict::legible);
  CHECK(judged_at(300, clear()).verdict == SightVerdict::visible);
  SignLook smoke = clear();
  smoke.legend = smoke.ground = smoke.face = smoke.surround = {5, 1e-4};
  smoke.difference = {40 * 1e-6, 1e-9};
  smoke.silhouette = {29 * 1e-6, 1e-9};
  smoke.transmission = 1e-6;
  const Sight lost = judged_at(10, smoke);
  CHECK(lost.verdict == SightVerdict::invisible);
  CHECK(lost.extinction == Approx(1.38155).epsilon(1e-4));
  CHECK_FALSE(lost.jin_legible);
}

TEST_CASE("a sign too few standard errors from its limit is undecided", "[emergency][legibility]") {
  SignLook noisy = clear();
  const Sight sure = judged_at(10, noisy);
  REQUIRE(sure.reading_level.value > level_read);
  // The noise is so large that 1 / 0.6 standard errors reach the limit.
  noisy.difference.error =
      0.6 * 40 * (sure.reading_level.value - level_read) / sure.reading_level.value;
  const Sight unsure = judged_at(10, noisy);
  CHECK(unsure.verdict == SightVerdict::undecided);
  CHECK(unsure.reason);
  CHECK(judged_at(10, noisy, {{}, false, 1.6}).verdict == SightVerdict::legible);
  noisy.difference.error /= 2;
  CHECK(judged_at(10, noisy).verdict == SightVerdict::legible);
  CHECK(judged_at(10, noisy, {{}, false, 5}).verdict == SightVerdict::undecided);
}

TEST_CASE(
    "a sign may be read if it is legible, or if the verdict is undecided and leaves reading open",
    "[emergency][legibility]") {
  Sight sight;
  sight.reading_level = {level_read, 0.5};
  for (const auto& [verdict, may] : {std::pair{SightVerdict::legible, true},
                                     {SightVerdict::undecided, true},
                                     {SightVerdict::visible, false},
                                     {SightVerdict::hidden, false}}) {
    sight.verdict = verdict;
    CHECK(may_be_read(sight) == may);
  }
  // Undecided is only whether the sign is seen at all.
  sight.verdict = SightVerdict::undecided;
  sight.reading_level = {1, 0.5};
  CHECK_FALSE(may_be_read(sight));
}

TEST_CASE("an error that two lights share is not counted in the difference of their levels",
          "[emergency][legibility]") {
  const Sign sign = two_coloured();
  const SignView view = view_of_sign(sign, {0, 0, 30});
  SignLook first = clear();
  first.difference.error = first.ground.error = 2;
  SignLook nothing;
  CHECK(error_of_level_beyond(first, first, nothing, view, {}) == 0);
  // An error of the difference alone has the same effect as in one light.
  SignLook beyond;
  beyond.difference.error = 0.5;
  first.difference.error = first.ground.error = 0;
  SignLook alone = first;
  alone.difference.error = 0.5;
  CHECK(error_of_level_beyond(first, first, beyond, view, {}) ==
        Approx(judge_sight(sign, view, alone, {}).reading_level.error));
  // Before a brighter ground the same error of the difference weighs less.
  SignLook other = first;
  other.ground.value += 30;
  first.difference.error = 2;
  const double before_other = error_of_level_beyond(first, other, nothing, view, {});
  CHECK(before_other > 0);
  SignLook in_first = first;
  CHECK(before_other < judge_sight(sign, view, in_first, {}).reading_level.error);
}

TEST_CASE("a silhouette before a bright wall is seen, although nothing on it can be distinguished",
          "[emergency][legibility]") {
  SignLook dark = clear();
  dark.legend = dark.ground = dark.face = {0.1, 0.001};
  dark.difference = {0, 1e-5};
  dark.surround = {5, 0.01};
  dark.silhouette = {-4.9, 0.01};
  CHECK(judged_at(10, dark).verdict == SightVerdict::visible);
  dark.surround = {0.1, 0.0001};
  dark.silhouette = {0, 0.0001};
  CHECK(judged_at(10, dark).verdict == SightVerdict::invisible);
  dark.silhouette = {0, 0.3};  // too noisy to decide
  CHECK(judged_at(10, dark).verdict == SightVerdict::undecided);
}

TEST_CASE("noise that may turn a brighter face into a darker one counts as that of a darker one",
          "[emergency][legibility]") {
  const Sign sign = two_coloured();
  const SignView view = view_of_sign(sign, {0, 0, 30});
  const auto error_at = [&](double difference) {
    SignLook look = clear();
    look.ground.error = 0;
    look.difference = {difference, 0.1};
    return judge_sight(sign, view, look, {}).reading_level.error;
  };
  CHECK(error_at(0.1) == Approx(error_at(-0.1)));
  CHECK(error_at(0.1) > error_at(10));
}

TEST_CASE("a sign of unknown place needs five times the contrast to be seen, not to be read",
          "[emergency][legibility]") {
  const SightRules unknown{{}, false, 2, true};
  SignLook faint = clear();
  faint.difference = {0, 1e-6};
  faint.silhouette = {1, 1e-6};
  const double level = judged_at(10, faint).seeing_level.value;
  faint.silhouette.value *= 4 / level;
  CHECK(judged_at(10, faint).verdict == SightVerdict::visible);
  CHECK(judged_at(10, faint, unknown).verdict == SightVerdict::invisible);
  faint.silhouette.value *= 1.5;
  CHECK(judged_at(10, faint, unknown).verdict == SightVerdict::visible);
  CHECK(judged_at(10, clear(), unknown).verdict == SightVerdict::legible);
}

TEST_CASE("the reach of a sign is where its levels fall to their limits",
          "[emergency][legibility]") {
  const Sign sign = two_coloured();
  SignLook look = clear();
  look.transmission = 0.5;
  const SignView view = view_of_sign(sign, {0, 0, 10});
  const Reach reach = reach_of(sign, view, look, {});
  // As seen from there, with the contrast that is left.
  const auto seen_from = [&](double distance) {
    SignLook there = look;
    const double left = std::pow(0.5, (distance - 10) / 10);
    there.difference.value *= left;
    there.silhouette.value *= left;
    return judge_sight(sign, view_of_sign(sign, {0, 0, distance}), there, {});
  };
  CHECK(seen_from(reach.read_m).reading_level.value == Approx(level_read).epsilon(1e-3));
  CHECK(seen_from(reach.seen_m).seeing_level.value == Approx(level_seen).epsilon(1e-3));
  CHECK(reach.read_m < reach.seen_m);
  CHECK(reach_of(sign, view, {}, {}).read_m == 0);
  // Irritant smoke ends reading before light does: 8 / 0.576 (0.133 - 1.47 lg 0.576) = 6.7 m.
  look.transmission = std::exp(-5.76);
  look.difference = {40, 0};
  const Reach stung = reach_of(sign, view, look, SightRules{{}, true});
  CHECK(stung.read_m == Approx(6.7).epsilon(0.01));
  CHECK(stung.read_m < reach_of(sign, view, look, {}).read_m);
  CHECK(stung.seen_m == reach_of(sign, view, look, {}).seen_m);
}

TEST_CASE("glare makes a legible sign illegible", "[emergency][legibility]") {
  SignLook faint = clear();
  faint.legend = {0.5, 1e-4};
  faint.ground = {0.1, 1e-4};
  faint.difference = {0.4, 1e-4};
  const double before = judged_at(10, faint).reading_level.value;
  faint.veil_cd_m2 = 100;
  CHECK(judged_at(10, faint).reading_level.value < before / 10);
}

TEST_CASE("hidden signs, half-hidden signs and faces of one colour get no verdict on legibility",
          "[emergency][legibility]") {
  SignLook look = clear();
  look.visible_share = 0;
  CHECK(judged_at(10, look).verdict == SightVerdict::hidden);
  look.visible_share = 0.5;
  CHECK(judged_at(10, look).verdict == SightVerdict::not_assessed);
  CHECK(judged_at(10, look).reason);
  Sign plain = two_coloured();
  plain.face.colour = {0, 0};
  const Sight sight = judge_sight(plain, view_of_sign(plain, {0, 0, 10}), clear(), {});
  CHECK(sight.verdict == SightVerdict::not_assessed);
}

TEST_CASE("irritant smoke limits what light alone would allow", "[emergency][legibility]") {
  SignLook look = clear();
  look.transmission = 0.01;  // over 8 m: 0.576/m
  CHECK(judged_at(8, look).verdict == SightVerdict::legible);
  const SightRules irritant{{}, true};
  const Sight stung = judged_at(8, look, irritant);
  CHECK(stung.extinction == Approx(0.5756).epsilon(1e-3));
  // 8 / 0.576 (0.133 - 1.47 lg 0.576) = 6.7 m.
  CHECK(stung.verdict == SightVerdict::visible);
  CHECK(stung.reason == remark(RemarkId::irritant_smoke));
  CHECK(judged_at(6, look, irritant).verdict != SightVerdict::undecided);
  // A sign that is undecided by its light is not read there either.
  look.difference.error = 20;
  REQUIRE(judged_at(8, look).verdict == SightVerdict::undecided);
  CHECK(may_be_read(judged_at(8, look)));
  CHECK_FALSE(may_be_read(judged_at(8, look, irritant)));
}

TEST_CASE("the verdict on a view that is worse or may be worse counts", "[emergency][legibility]") {
  const auto sight = [](SightVerdict verdict, double seeing) {
    Sight out;
    out.verdict = verdict;
    out.seeing_level = {seeing, 0.1};
    return out;
  };
  // Verdicts from the best to the worst.
  const std::vector<Sight> order{
      sight(SightVerdict::legible, 50),     sight(SightVerdict::undecided, 50),
      sight(SightVerdict::visible, 50),     sight(SightVerdict::undecided, 1.1),
      sight(SightVerdict::invisible, 0.1),  sight(SightVerdict::hidden, 0),
      sight(SightVerdict::not_assessed, 0),
  };
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = 0; j < order.size(); ++j) CHECK(is_worse(order[i], order[j]) == (i > j));
  Sight clearer = order[0];
  clearer.reading_level.value = 9;
  CHECK(is_worse(order[0], clearer));
  CHECK_FALSE(is_worse(clearer, order[0]));
}
