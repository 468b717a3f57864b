// Infinite layers of gas that absorb and glow and do not scatter: exponential integrals. The scenes
// are those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr CaseOptions gas{.min_share = 1e-3, .min_particles = 1 << 20, .max_particles = 1 << 25};

}  // namespace

TEST_CASE("a layer of gas passes and absorbs of diffuse light what the exponential integral says") {
  check_cases("layer of gas", 8, gas);
}

TEST_CASE("of the light of an evenly glowing layer the share that escapes is the exact one") {
  check_cases("glowing layer", 6, gas);
}

TEST_CASE("a flame between absorbing layers reaches floor and ceiling in the exact shares") {
  check_cases("flame between layers", 3, gas);
}

}  // namespace luxodus::light
