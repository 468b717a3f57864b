// Answers in brief: what verdicts amount to, and what holds between two times.
#include "actors/judge/visibility_map/sign_answer.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

Sight sight_of(SightVerdict verdict, double seeing_level = 0) {
  Sight sight;
  sight.verdict = verdict;
  sight.seeing_level = {seeing_level, 0};
  return sight;
}

SignEstimate of(SightVerdict verdict, double seeing_level = 0) {
  return estimate_of(sight_of(verdict, seeing_level));
}

}  // namespace

TEST_CASE("a verdict amounts to an answer, and to whether the sign is surely seen",
          "[judge][visibility_map]") {
  CHECK(of(SightVerdict::legible).answer == SignAnswer::read);
  CHECK(of(SightVerdict::legible).surely_seen);
  CHECK(of(SightVerdict::visible).answer == SignAnswer::seen);
  CHECK(of(SightVerdict::visible).surely_seen);
  CHECK(of(SightVerdict::invisible).answer == SignAnswer::invisible);
  CHECK_FALSE(of(SightVerdict::invisible).surely_seen);
  CHECK(of(SightVerdict::hidden).answer == SignAnswer::hidden);
  CHECK(of(SightVerdict::not_assessed).answer == SignAnswer::undecided);
  CHECK_FALSE(of(SightVerdict::not_assessed, 100).surely_seen);
  CHECK_FALSE(of(SightVerdict::undecided, 0.9).surely_seen);
  CHECK(of(SightVerdict::undecided, 1.1).surely_seen);
}

TEST_CASE("between two times a sign is read or seen only if it is at both",
          "[judge][visibility_map]") {
  const SightVerdict verdicts[] = {SightVerdict::legible, SightVerdict::visible,
                                   SightVerdict::invisible, SightVerdict::hidden,
                                   SightVerdict::undecided};
  for (const SightVerdict x : verdicts)
    for (const SightVerdict y : verdicts)
      for (const double level : {0.5, 2.0}) {
        const SignEstimate a = of(x, level), b = of(y, level), worse = worse_of(a, b);
        CHECK((worse.answer == SignAnswer::read) ==
              (a.answer == SignAnswer::read && b.answer == SignAnswer::read));
        CHECK(worse.surely_seen == (a.surely_seen && b.surely_seen));
        CHECK((worse.answer != SignAnswer::seen || worse.surely_seen));
        CHECK(worse_of(b, a).surely_seen == worse.surely_seen);
      }
}

TEST_CASE("levels between two times are the lower ones", "[judge][visibility_map]") {
  SignEstimate a = of(SightVerdict::legible), b = a;
  a.reading_level = {10, 1};
  b.reading_level = {8, 2};
  CHECK(worse_of(a, b).reading_level.value == 8);
  CHECK(worse_of(a, b).reading_level.error == 2);
}
