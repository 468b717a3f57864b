// Crossings of a limit between known points, and the steps that a search asks for.
#include "actors/judge/thresholds/crossing.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "actors/judge/thresholds/factor_search.hpp"

using namespace luxodus;

namespace {

/// Level e^(a - b x), known to a tenth.
LevelPoint falling(double at, double a, double b) {
  const double level = std::exp(a - b * at);
  return level_point(at, {level, 0.1 * level}, 1);
}

/// Feeds a search with a level that depends on the factor; the steps that it asked for.
template <class Excess>
std::vector<int> searched(FactorSearch& search, const Excess& excess) {
  const auto add = [&](int step) {
    const double factor = factor_of_step(step);
    search.add(step, {factor, excess(factor), 0.05, true});
  };
  std::vector<int> asked;
  add(0);
  while (const auto step = search.next()) {
    REQUIRE_FALSE(search.knows(*step));
    REQUIRE(asked.size() < 20);
    asked.push_back(*step);
    add(*step);
  }
  return asked;
}

}  // namespace

TEST_CASE("a crossing lies where the level's logarithm passes the limit") {
  const auto found = crossings({falling(0, 3, 2), falling(1, 3, 2), falling(2, 3, 2)});
  REQUIRE(found.size() == 1);
  CHECK(found[0].at.value == Approx(1.5));
  CHECK(found[0].at.error == Approx(0.1 / 2 * std::hypot(0.5, 0.5)));
  CHECK_FALSE(found[0].above);
  CHECK(crossings({falling(0, 3, 2), falling(1, 3, 2)}).empty());
  CHECK(crossings({}).empty());
}

TEST_CASE("a third point bends the curve, and its neighbours tell the error") {
  const auto point = [](double x) { return LevelPoint{x, 1 - x * x, 0, true}; };
  const Crossing linear = crossings({point(0.5), point(1.5)})[0];
  const Crossing bent = crossings({point(0.5), point(1.5), point(2)})[0];
  CHECK(linear.at.value == Approx(0.875));
  CHECK(std::abs(bent.at.value - 1) < 0.05);
  CHECK(std::abs(bent.at.value - 1) < 2 * bent.at.error);
  // A point far from the limit says nothing of the curve there.
  CHECK(crossings({point(0.5), point(1.5), point(5)})[0].at.value == Approx(linear.at.value));
}

TEST_CASE("a kink between two points is within the error of the crossing") {
  for (const double kink : {1.1, 1.3, 1.5, 1.9}) {
    INFO("kink at " << kink);
    const auto point = [kink](double x) {  // level up to the kink, then steep
      return LevelPoint{x, x < kink ? 1 - 0.1 * (x - kink) : 1 - 5 * (x - kink), 0, true};
    };
    const Crossing found = crossings({point(0), point(1), point(2), point(3)})[0];
    CHECK(std::abs(found.at.value - (kink + 0.2)) <= 1.8 * found.at.error);
  }
}

TEST_CASE("where a sign comes into sight the crossing is in the middle") {
  const auto found = crossings({impossible_point(2), falling(3, 9, 1), falling(4, 9, 1)});
  REQUIRE(found.size() == 1);
  CHECK(found[0].at.value == 2.5);
  CHECK(found[0].at.error == Approx(1 / std::sqrt(12.0)));
  CHECK(found[0].above);
  CHECK(crossings({impossible_point(1), falling(3, -9, 1)}).empty());
}

TEST_CASE("a search brackets the limit by neighbouring steps, in few of them") {
  for (const double root : {0.1, 0.5, 0.97, 1.04, 3.0, 20.0}) {
    INFO("root " << root);
    FactorSearch search;
    const auto asked = searched(search, [root](double k) { return 8 * (root - k) / root; });
    CHECK(asked.size() <= 8);
    const auto found = search.found();
    REQUIRE(found);
    CHECK(found->at.value == Approx(root).epsilon(1e-6));
    CHECK_FALSE(found->above);
    CHECK(found->at.error == Approx(0.05 * root / 8).epsilon(0.5));
  }
}

TEST_CASE("a search ends at the ends of the ladder, of which the lowest is clear air") {
  FactorSearch never, always;
  const auto down = searched(never, [](double k) { return -1 - k; });
  CHECK(down.back() == clear_air_step);
  CHECK_FALSE(never.found());
  CHECK_FALSE(never.holds_everywhere());
  const auto up = searched(always, [](double k) { return 9 - k / 10; });
  CHECK(up.back() == densest_step);
  CHECK_FALSE(always.found());
  CHECK(always.holds_everywhere());
  CHECK(factor_of_step(clear_air_step) == 0);
  CHECK(factor_of_step(0) == 1);
}
