// What the record of an assessment says of a view besides its verdict: the light at the eye, and
// how it stands to experiments with people.
#include <cmath>

#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("smoke dims the light at an eye, and the record holds both with and without it",
          "[assess]") {
  const AssessmentRecord smoky = recorded(with_smoke(0.5, 0.9)), clear = recorded(room);
  REQUIRE(smoky.sights.size() == clear.sights.size());
  size_t lit = 0;
  for (size_t i = 0; i < smoky.sights.size(); ++i) {
    if (!smoky.sights[i].seen) continue;
    const EyeLightRecord &in_smoke = smoky.sights[i].seen->eye_light,
                         &in_clear = clear.sights[i].seen->eye_light;
    CHECK(in_clear.lux == in_clear.clear_air_lux);
    CHECK(in_smoke.clear_air_lux == Approx(in_clear.lux));
    if (!(in_clear.lux > 0)) continue;  // the lamp is behind
    ++lit;
    CHECK(in_smoke.lux < in_clear.lux);
    const glm::dvec3 lamp{6, 0, 2.5};
    const double passed = std::exp(-0.5 * glm::length(lamp - smoky.sights[i].eye));
    CHECK(in_smoke.lux == Approx(in_clear.lux * passed).epsilon(1e-3));
  }
  CHECK(lit >= 1);
}

TEST_CASE("the record says how a view stands to people of experiments, or why nobody knows",
          "[assess]") {
  const std::string smoke = with_smoke(0.6, 0.99);
  const auto old = recorded(smoke);
  const auto young = recorded(replaced(smoke, "spacing_m = 4", "spacing_m = 4\nage_years = 23"));
  size_t known = 0;
  for (const SightRecord& sight : young.sights)
    if (sight.seen && sight.distance_m > 5.5)
      known += sight.seen->experiments.read.observer != MeanObserver::not_known ? 1 : 0;
  CHECK(known >= 1);
  for (const SightRecord& sight : old.sights) {
    if (!sight.seen) continue;
    CHECK(sight.seen->experiments.read.observer == MeanObserver::not_known);
    CHECK(sight.seen->experiments.read.untested == Untested::age);
  }
}
