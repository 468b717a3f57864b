#include "scenes/light/signs/onset.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

TEST_CASE("light rises linearly between the rows of an onset, and at once without rows",
          "[emergency]") {
  const std::vector<glm::dvec2> onset{{0, 0.1}, {0.5, 0.5}, {5, 1}};
  CHECK(onset_share(onset, -1) == 0.1);
  CHECK(onset_share(onset, 0) == 0.1);
  CHECK(onset_share(onset, 0.25) == Approx(0.3));
  CHECK(onset_share(onset, 0.5) == 0.5);
  CHECK(onset_share(onset, 60) == 1);
  CHECK(onset_share({}, 0) == 1);
}
