// Compares sums of weights with those of all subsets.
#include "actors/judge/design/attainable_sums.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "tests/unit/actors/judge/design/problems.hpp"

namespace luxodus {
namespace {

LayoutProblem weighing(const std::vector<double>& weights) {
  LayoutProblem out = test::with_options(static_cast<uint32_t>(weights.size()));
  for (size_t i = 0; i < weights.size(); ++i) out.options[i].weight = weights[i];
  return out;
}

}  // namespace

TEST_CASE("a bound between two sums of weights is raised to the larger one", "[design]") {
  const std::vector<double> weights{130, 145, 160, 190, 220};
  std::set<double> all{0};
  for (double sum = 0; sum < 2000; sum += 5)
    if (all.contains(sum))
      for (const double weight : weights) all.insert(sum + weight);
  const AttainableSums sums(weighing(weights));
  for (double bound = 1; bound < 2000; bound += 1) {
    INFO("bound " << bound);
    const double expected = *all.lower_bound(bound);
    CHECK(sums.from(bound) == Approx(expected));
  }
  CHECK(sums.from(1) == Approx(130));
  CHECK(sums.from(221) == Approx(260));
  CHECK(sums.from(260) == Approx(260));
  CHECK(sums.from(400) == Approx(405));
}

TEST_CASE("no sum lies between a sum and the number just below it", "[design]") {
  const AttainableSums sums(weighing({0.5, 0.75}));
  // Sums: 0, 0.5, 0.75, 1, 1.25, ...
  CHECK(sums.just_below(0.5) > 0);
  CHECK(sums.just_below(0.5) < 0.01);
  CHECK(sums.just_below(0.75) > 0.5);
  CHECK(sums.just_below(0.75) < 0.51);
  CHECK(sums.from(sums.just_below(0.75)) == Approx(0.75));
  CHECK(sums.just_below(0) < 0);
}

TEST_CASE("weights without a common step, and fixed luminaires, leave a bound unchanged",
          "[design]") {
  CHECK(AttainableSums(weighing({1.23456, 2})).from(1.5) == Approx(1.5));
  CHECK(AttainableSums(weighing({1.23456, 2})).just_below(1.5) < 1.5);
  LayoutProblem fixed = weighing({7, 2});
  fixed.options[0].fixed = true;
  CHECK(AttainableSums(fixed).from(3) == Approx(4));
  CHECK(AttainableSums(weighing({})).from(3) == Approx(3));
}

}  // namespace luxodus
