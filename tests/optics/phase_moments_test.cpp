// Distance that light travels in endless fog before it is absorbed: moments of the point of
// absorption under Henyey-Greenstein scattering, for extinction 1/m, albedo c and mean cosine g.
// The scenes are those of actors/judge/validate.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {

TEST_CASE("light in fog is absorbed as the first and second moments of its random walk state") {
  // A history of albedo 0.99 has a hundred collisions.
  check_cases("beam in fog, c=0.3;", 5, {.max_particles = 1 << 20});
  check_cases("beam in fog, c=0.6;", 5, {.max_particles = 1 << 20});
  check_cases("beam in fog, c=0.9;", 9, {.max_particles = 1 << 18});
  check_cases("beam in fog, c=0.99;", 5, {.min_particles = 1 << 16, .max_particles = 1 << 16});
}

}  // namespace luxodus::light
