// Compares bounds of regions with all feasible layouts.
#include "actors/judge/design/region_bounds.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/design/solve_layout.hpp"
#include "tests/unit/actors/judge/design/problems.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"

namespace luxodus {
namespace {

using test::all_that_hold;
using test::nobody;

constexpr uint32_t regions = 3;
/// More time than any bound needs: these tests do not depend on time.
constexpr double ample_s = 600;

/// The random square divided into three adjacent regions.
LayoutProblem in_regions(LayoutProblem problem) {
  const auto region_of = [](double x) { return static_cast<uint32_t>(std::min(x / 4, 2.0)); };
  for (LayoutOption& option : problem.options) option.region = region_of(option.position.x);
  const std::vector<ConstraintGroup> kinds = std::move(problem.groups);
  problem.groups.clear();
  for (ConstraintGroup group : kinds)
    for (group.region = 0; group.region < regions; ++group.region) problem.groups.push_back(group);
  const FailureRows failures = problem.failures.front();
  const SpreadRows spread = problem.spreads.front();
  problem.failures.clear();
  problem.spreads.clear();
  for (CoverRow& row : problem.covers) row.group = region_of(row.place.x);
  for (uint32_t region = 0; region < regions; ++region) {
    FailureRows its{regions + region, failures.least, {}};
    SpreadRows even{2 * regions + region, spread.ratio, {}, {}};
    for (const uint32_t p : failures.points)
      if (region_of(problem.points[p].place.x) == region) {
        its.points.push_back(p);
        even.low.push_back(p);
        even.high.push_back(p);
      }
    problem.failures.push_back(its);
    problem.spreads.push_back(even);
  }
  return problem;
}

struct BoundedProblem {
  explicit BoundedProblem(const LayoutProblem& problem)
      : index(problem), sums(problem), growing(problem, false) {
    for (const Violation& v : first_rows(problem)) growing.add(v);
  }
  LayoutIndex index;
  AttainableSums sums;
  GrowingProgram growing;
};

/// The smallest weight of some regions over all layouts.
double min_weight(const RegionBounds& bounds, const RegionBound& of,
                  const std::vector<Layout>& layouts) {
  double out = bounds.weight_of(layouts.front(), of);
  for (const Layout& layout : layouts) out = std::min(out, bounds.weight_of(layout, of));
  return out;
}

double sum_of_bounds(const RegionBounds& bounds) {
  double out = 0;
  for (const RegionBound& one : bounds.bounds()) out += one.least;
  return out;
}

}  // namespace

TEST_CASE("no layout weighs less in a region than its bound, separate or joint", "[design]") {
  int feasible = 0, raised_by_joining = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    INFO("seed " << seed);
    const LayoutProblem problem = in_regions(test::random_problem(seed, 12, 25));
    const std::vector<Layout> layouts = all_that_hold(problem);
    if (layouts.empty()) continue;
    ++feasible;
    const Layout& best =
        *std::min_element(layouts.begin(), layouts.end(), [&](const Layout& a, const Layout& b) {
          return objective_of(problem, a) < objective_of(problem, b);
        });
    BoundedProblem kit(problem);
    RegionBounds bounds(problem, kit.index, kit.sums, {}, kit.growing, nobody);
    double told = 0;
    const auto tell = [&](double sum) {
      told = sum;
      return true;
    };
    // With a layout only regions that weigh more than their bound are solved, up to that weight.
    bounds.bound_each(seed % 2 == 0 ? best : Layout(), ample_s, tell);
    CHECK(told == Approx(sum_of_bounds(bounds)));
    for (const RegionBound& one : bounds.bounds())
      CHECK(one.least <= min_weight(bounds, one, layouts) + 1e-6);
    const double objective = objective_of(problem, best);
    while (bounds.join(best, ample_s, tell)) {
      ++raised_by_joining;
      CHECK(told == Approx(sum_of_bounds(bounds)));
      // The joint bound stays at most the best objective.
      CHECK(told <= objective + 1e-6);
      for (const RegionBound& one : bounds.bounds())
        CHECK(one.least <= min_weight(bounds, one, layouts) + 1e-6);
    }
  }
  CHECK(feasible >= 4);
  CHECK(raised_by_joining >= 4);
}

TEST_CASE("bounds of a stopped search are not above the weight of any layout", "[design]") {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const LayoutProblem problem = in_regions(test::random_problem(seed, 12, 25));
    const std::vector<Layout> layouts = all_that_hold(problem);
    if (layouts.empty()) continue;
    const Layout& best =
        *std::min_element(layouts.begin(), layouts.end(), [&](const Layout& a, const Layout& b) {
          return objective_of(problem, a) < objective_of(problem, b);
        });
    // Whenever time is up, the bounds so far are valid.
    for (const double seconds : {0.0, 1e-4, 1e-3, 3e-3, 1e-2, 3e-2}) {
      INFO("seed " << seed << ", " << seconds << " s");
      BoundedProblem kit(problem);
      RegionBounds bounds(problem, kit.index, kit.sums, {}, kit.growing, nobody);
      double told = 0;
      const auto tell = [&](double sum) {
        told = sum;
        return true;
      };
      bounds.bound_each(best, seconds, tell);
      while (bounds.join(best, seconds, tell)) {
      }
      CHECK(told <= objective_of(problem, best) + 1e-6);
      for (const RegionBound& one : bounds.bounds())
        CHECK(one.least <= min_weight(bounds, one, layouts) + 1e-6);
    }
  }
}

TEST_CASE("a problem in regions is solved as well as one without", "[design]") {
  int joined = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    INFO("seed " << seed);
    const LayoutProblem problem = in_regions(test::random_problem(seed, 12, 25));
    const double best = test::best_of_all_subsets(problem);
    SolveSettings settings;
    settings.greedy_rounds = 20;
    const LayoutAnswer answer = solve_layout(problem, settings, nobody, test::silent);
    if (std::isinf(best)) {
      CHECK(answer.end == LayoutEnd::infeasible);
      continue;
    }
    CHECK(answer.end == LayoutEnd::optimal);
    CHECK(answer.objective == Approx(best));
    CHECK(answer.bound <= best + 1e-6);
    joined += answer.regions.size() < regions ? 1 : 0;
    // Known bounds need not be computed again, and give the same result.
    settings.start = answer.layout;
    settings.known_regions = answer.regions;
    const LayoutAnswer again = solve_layout(problem, settings, nobody, test::silent);
    CHECK(again.end == LayoutEnd::optimal);
    CHECK(again.objective == Approx(best));
  }
  CHECK(joined > 0);
}

TEST_CASE("light from one region to another counts as the share of the requirement", "[design]") {
  LayoutProblem problem = test::with_options(3);
  problem.options[0].region = 4;
  problem.options[1].region = 7;
  test::ask(problem, {{0, 1}, {1, 0.5f}, {2, 3}}, 2, "four");
  test::ask(problem, {{0, 9}, {1, 1}}, 3, "seven");
  problem.groups[0].region = 4;
  problem.groups[1].region = 7;
  const auto light = light_between_regions(problem);
  REQUIRE(light.size() == 1);
  // 0.5 of 2 from the second region, and more than the whole requirement from the first.
  CHECK(light.at({4, 7}) == Approx(0.25 + 1));
}

}  // namespace luxodus
