#include "scenes/formats/fds_input/boxes.hpp"

#include <catch2/catch.hpp>

using namespace luxodus::fds_input;

TEST_CASE("a box minus a hole is the boxes around the hole, with their volume", "[fds_input]") {
  Comparisons comparisons;
  const Box box{{0, 0, 0}, {3, 3, 3}};
  const auto left = without_all(box, {{{1, 1, 1}, {2, 2, 2}}}, 10, comparisons);
  REQUIRE(left);
  CHECK(left->size() == 6);
  double volume = 0;
  for (const Box& piece : *left) {
    const glm::dvec3 size = piece.high - piece.low;
    volume += size.x * size.y * size.z;
  }
  CHECK(volume == Approx(26));
}

TEST_CASE("holes that cut nothing count as comparisons, and too many end the computation",
          "[fds_input]") {
  const std::vector<Box> elsewhere(100, Box{{9, 9, 9}, {10, 10, 10}});
  const Box box{{0, 0, 0}, {1, 1, 1}};
  Comparisons comparisons{0, 250};
  CHECK(without_all(box, elsewhere, 10, comparisons));
  CHECK(without_all(box, elsewhere, 10, comparisons));
  CHECK_FALSE(without_all(box, elsewhere, 10, comparisons));
  CHECK(comparisons.too_many());
}
