#include "scenes/light/optics/equiangular.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

/// Lines near to and far from a point: the point lies before, beside and behind them.
const std::vector<EquiangularLine>& lines() {
  const glm::dvec3 way(0.6, 0, 0.8);
  static const std::vector<EquiangularLine> all = {
      {{0, 0, 0}, way, 10, {3, 1, 4}},      // beside its middle
      {{0, 0, 0}, way, 10, {3, 1e-4, 4}},   // a tenth of a millimetre beside it
      {{0, 0, 0}, way, 10, {3, 0, 4}},      // on it
      {{0, 0, 0}, way, 10, {-3, 0.1, -4}},  // before its origin
      {{0, 0, 0}, way, 10, {30, 0.1, 40}},  // behind its end
      {{0, 0, 0}, way, 1e-3, {3, 5, 4}},    // far from a short line
  };
  return all;
}

}  // namespace

TEST_CASE("points sampled by equiangular sampling follow their density", "[optics]") {
  for (const EquiangularLine& line : lines()) {
    // The distribution function up to the point drawn with u is u itself.
    const double end = line.sample(1 - 1e-15);
    for (const double u : {0.01, 0.25, 0.5, 0.75, 0.99}) {
      const double t = line.sample(u);
      REQUIRE(t >= 0);
      REQUIRE(t <= end * (1 + 1e-12));
      const double step = 1e-6;
      const double by_samples = 2 * step / (line.sample(u + step) - line.sample(u - step));
      CHECK(line.density(t) == Approx(by_samples).epsilon(1e-4));
    }
  }
}

TEST_CASE(
    "an inverse-square contribution divided by its density is the same everywhere on the line",
    "[optics]") {
  const glm::dvec3 way(0.6, 0, 0.8), point(3, 1e-3, 4);
  const EquiangularLine line({0, 0, 0}, way, 10, point);
  const auto ratio = [&](double t) {
    const glm::dvec3 from = t * way - point;
    return 1 / (glm::dot(from, from) * line.density(t));
  };
  for (const double t : {0.0, 4.0, 4.999, 5.0, 5.1, 10.0})
    CHECK(ratio(t) == Approx(ratio(5)).epsilon(1e-6));
}

TEST_CASE("nothing is sampled beyond a line's ends", "[optics]") {
  for (const EquiangularLine& line : lines()) {
    CHECK(line.density(-1e-9) == 0);
    CHECK(line.density(10.001) == 0);
    CHECK(line.sample(0) < 1e-9);
  }
}
