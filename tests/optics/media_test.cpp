// Smoke of any shape: what a uniform field of light does in it, point sources in fog, glowing
// bodies. The scenes are those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {

TEST_CASE("in a closed room of equal walls white smoke of any density changes nothing anywhere") {
  check_cases("furnace, white smoke", 5, {.min_share = 0.01, .max_particles = 1 << 19});
}

TEST_CASE("smoke as hot as the walls around it absorbs in every part what it emits") {
  check_cases("furnace, smoke as hot", 1, {.min_particles = 1 << 20});
}

TEST_CASE("the mean path through white smoke is four volumes over surface, whatever its density") {
  check_cases("mean path in a", 7);
}

TEST_CASE("around a point source in endless fog light spreads as Case's solution says") {
  check_cases("point source in fog", 2, {.min_particles = 1 << 21, .max_particles = 1 << 21});
}

TEST_CASE("a ball of smoke lets out, passes and absorbs what collision probabilities say") {
  check_cases("ball of smoke", 39, {.min_particles = 1 << 20, .max_particles = 1 << 22});
}

TEST_CASE("the glowing cube of Burns and Christon loses and keeps what quadrature says") {
  check_cases("Burns and Christon", 1, {.min_particles = 1 << 24, .most = 2});
}

}  // namespace luxodus::light
