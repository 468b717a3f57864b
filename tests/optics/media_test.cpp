// Smoke of any shape: uniform fields of light, point sources in fog, glowing bodies. The scenes are
// those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {

TEST_CASE("white smoke of any density in a closed room of equal walls changes nothing") {
  check_cases("furnace, white smoke", 5, {.min_share = 0.01, .max_particles = 1 << 19});
}

TEST_CASE("smoke as hot as the walls around it absorbs everywhere as much as it emits") {
  check_cases("furnace, smoke as hot", 1, {.min_particles = 1 << 20});
}

TEST_CASE("the mean path through white smoke is four times volume over surface at any density") {
  check_cases("mean path in a", 7);
}

TEST_CASE("light around a point source in endless fog follows Case's solution") {
  check_cases("point source in fog", 2, {.min_particles = 1 << 21, .max_particles = 1 << 21});
}

TEST_CASE("a ball of smoke emits, transmits and absorbs as collision probabilities state") {
  check_cases("ball of smoke", 39, {.min_particles = 1 << 20, .max_particles = 1 << 22});
}

TEST_CASE("the glowing cube of Burns and Christon loses and keeps as much as quadrature gives") {
  check_cases("Burns and Christon", 1, {.min_particles = 1 << 24, .most = 2});
}

}  // namespace luxodus::light
