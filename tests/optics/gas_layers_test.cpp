// Infinite layers of gas that absorb and emit without scattering: exponential integrals. The scenes
// are those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr CaseOptions gas{.min_share = 1e-3, .min_particles = 1 << 20, .max_particles = 1 << 25};

}  // namespace

TEST_CASE("a layer of gas transmits and absorbs diffuse light as the exponential integral states") {
  check_cases("layer of gas", 8, gas);
}

TEST_CASE("the exact share of the light of a uniformly glowing layer escapes") {
  check_cases("glowing layer", 6, gas);
}

TEST_CASE("a flame between absorbing layers lights floor and ceiling in the exact shares") {
  check_cases("flame between layers", 3, gas);
}

}  // namespace luxodus::light
