// Compares layouts with those of all subsets, and tests proofs of infeasibility.
#include "actors/judge/design/solve_layout.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "actors/judge/design/greedy.hpp"
#include "runtime/core/random.hpp"
#include "tests/unit/actors/judge/design/problems.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"

namespace luxodus {
namespace {

using test::ask;
using test::best_of_all_subsets;
using test::nobody;
using test::random_problem;
using test::silent;
using test::sum_of;
using test::with_options;

LayoutAnswer solved(const LayoutProblem& problem, SolveSettings settings = {}) {
  settings.greedy_rounds = 20;
  return solve_layout(problem, settings, nobody, silent);
}

}  // namespace

TEST_CASE("a layout is as good as the best of all subsets, and no bound is above that",
          "[design]") {
  int feasible = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    INFO("seed " << seed);
    const LayoutProblem problem = random_problem(seed, 12, 25);
    const double best = best_of_all_subsets(problem);
    const LayoutAnswer answer = solved(problem);
    if (std::isinf(best)) {
      CHECK(answer.end == LayoutEnd::infeasible);
      continue;
    }
    ++feasible;
    REQUIRE_FALSE(answer.layout.empty());
    CHECK(answer.end == LayoutEnd::optimal);
    CHECK(answer.objective == Approx(best).margin(1e-6));
    CHECK(answer.bound <= best + 1e-6);
    const LayoutIndex index(problem);
    LayoutSums sums(index);
    sums.set(answer.layout);
    CHECK(sums.holds());
  }
  CHECK(feasible >= 4);
}

TEST_CASE("the bound of an interrupted search is below every layout", "[design]") {
  for (uint64_t seed = 20; seed < 24; ++seed) {
    INFO("seed " << seed);
    const LayoutProblem problem = random_problem(seed, 12, 25);
    const double best = best_of_all_subsets(problem);
    SolveSettings hasty;
    hasty.gap = 0.3;
    const LayoutAnswer answer = solved(problem, hasty);
    CHECK(answer.bound <= best + 1e-6);
    if (!answer.layout.empty()) CHECK(answer.objective >= best - 1e-6);
  }
}

TEST_CASE("a known bound of a region is not applied to a part with only some of its options",
          "[design]") {
  // Two rooms. The last option lights nothing and goes to the first room's part, although its
  // region is the second. There no option weighs as much as the second room needs.
  LayoutProblem problem = with_options(5);
  for (const uint32_t i : {0U, 1U, 2U}) problem.options[i].region = 1;
  for (const uint32_t i : {3U, 4U}) problem.options[i].region = 2;
  problem.options[2].weight = 1.9;
  ask(problem, {{0, 0.6f}, {1, 0.5f}, {2, 1}}, 1, "first room");
  ask(problem, {{3, 1}}, 1, "second room");
  SolveSettings settings;
  settings.start = {1, 1, 0, 1, 0};  // only the program can find a better layout
  settings.known_regions = {{{1}, 1.5}, {{2}, 1}};
  settings.greedy_rounds = 0;
  const LayoutAnswer answer = solve_layout(problem, settings, nobody, silent);
  CHECK(answer.end == LayoutEnd::optimal);
  CHECK(answer.objective == Approx(2.9));
  CHECK(answer.bound == Approx(2.9));
}

TEST_CASE("the same problem and seed give the same layout", "[design]") {
  const LayoutProblem problem = random_problem(3, 16, 40);
  CHECK(solved(problem).layout == solved(problem).layout);
}

TEST_CASE("a fixed luminaire is in every layout and adds nothing to the objective", "[design]") {
  LayoutProblem problem = with_options(3);
  problem.options[2].fixed = true;
  problem.options[2].weight = 0;
  ask(problem, {{0, 1}, {1, 1}, {2, 0.5}}, 1, "a");
  const LayoutAnswer answer = solved(problem);
  REQUIRE(answer.layout.size() == 3);
  CHECK(answer.layout[2] == 1);
  CHECK(answer.objective == Approx(1));
}

TEST_CASE("a row that all places together cannot satisfy is named with the share that they give",
          "[design]") {
  LayoutProblem problem = with_options(3);
  ask(problem, {{0, 1}, {1, 1}}, 1, "lit");
  ask(problem, {{0, 0.2f}, {2, 0.3f}}, 2, "dark");
  CHECK(solved(problem).end == LayoutEnd::infeasible);
  const Conflict conflict = conflict_of(problem, 10, nobody);
  REQUIRE(conflict.shortages.size() == 1);
  CHECK(problem.groups[conflict.shortages[0].group].subject.name == "dark");
  CHECK(conflict.shortages[0].share == Approx(0.25));
}

TEST_CASE("for constraints that cannot hold together a smallest infeasible subset is named",
          "[design]") {
  // One luminaire at each of three places. The first point needs all the light of place 0, and the
  // ratio of the two points forbids it. The third demand is unrelated.
  LayoutProblem problem = with_options(3);
  ask(problem, {{0, 10}}, 10, "bright");
  ask(problem, {{1, 1}, {2, 1}}, 1, "aside");
  problem.points.push_back({sum_of({{0, 10}}), {0, 0, 0}});
  problem.points.push_back({sum_of({{0, 0.1f}, {1, 0.1f}, {2, 0.1f}}), {5, 0, 0}});
  problem.groups.push_back(
      {DemandKind::spread, RuleId::E4, {SubjectKind::route, "even"}, 10, no_region});
  problem.spreads.push_back({2, 10, {1}, {0}});
  CHECK(solved(problem).end == LayoutEnd::infeasible);
  const Conflict conflict = conflict_of(problem, 10, nobody);
  CHECK(conflict.shortages.empty());
  CHECK(conflict.proven);
  CHECK(conflict.groups == std::vector<uint32_t>{0, 2});
}

TEST_CASE("with any one luminaire failed the light of the others is enough", "[design]") {
  LayoutProblem problem = with_options(4);
  std::vector<Term> all;
  for (uint32_t i = 0; i < 4; ++i) all.push_back({i, 1});
  ask(problem, all, 1, "a");
  CHECK(solved(problem).objective == Approx(1));
  problem.points.push_back({sum_of(all), {}});
  problem.groups.push_back(
      {DemandKind::failed, RuleId::none, {SubjectKind::route, "a"}, 2, no_region});
  problem.failures.push_back({1, 2, {0}});
  CHECK(solved(problem).objective == Approx(3));
}

TEST_CASE("a barred luminaire is in no layout, whatever it weighs", "[design]") {
  for (const double weight : {0.0, 0.1}) {
    LayoutProblem problem = with_options(3);
    problem.options[0].weight = weight;
    problem.options[0].barred = true;
    ask(problem, {{0, 1}, {1, 1}}, 1, "a");
    const LayoutAnswer answer = solved(problem);
    CHECK(answer.end == LayoutEnd::optimal);
    CHECK(answer.layout == Layout{0, 1, 0});
    problem.options[1].barred = true;
    CHECK(solved(problem).end == LayoutEnd::infeasible);
  }
}

TEST_CASE("movable luminaires stay or move as in the best of all subsets", "[design][movable]") {
  int feasible = 0, with_moves = 0;
  for (uint64_t seed = 40; seed < 52; ++seed) {
    INFO("seed " << seed);
    LayoutProblem problem = random_problem(seed, 12, 20);
    problem.pools = {2};
    for (const uint32_t i : {0u, 2u, 5u, 7u, 9u, 11u}) {
      problem.options[i].pool = 0;
      problem.options[i].weight = i <= 2 ? 0 : 0.25;  // at their own places, and elsewhere
    }
    const double best = best_of_all_subsets(problem);
    const LayoutAnswer answer = solved(problem);
    if (std::isinf(best)) {
      CHECK(answer.end == LayoutEnd::infeasible);
      continue;
    }
    ++feasible;
    REQUIRE(answer.layout.size() == 12);
    CHECK(answer.objective == Approx(best).margin(1e-6));
    CHECK(answer.bound <= best + 1e-6);
    const LayoutIndex index(problem);
    LayoutSums sums(index);
    sums.set(answer.layout);
    CHECK(sums.lack_of(0) == 0);
    CHECK(sums.holds());
    with_moves += answer.layout[0] + answer.layout[2] < 2 ? 1 : 0;
  }
  CHECK(feasible >= 4);
  CHECK(with_moves >= 2);
}

TEST_CASE("greedy layouts are feasible, and pruning removes luminaires that are not needed",
          "[design]") {
  const LayoutProblem problem = random_problem(3, 16, 40);
  const LayoutIndex index(problem);
  Random random(1, RandomStream::test);
  random.start(0);
  const auto greedy = completed(index, {}, 0, random);
  REQUIRE(greedy);
  LayoutSums sums(index);
  const Layout& all = *greedy;
  const Layout lean = pruned(index, all);
  sums.set(lean);
  CHECK(sums.holds());
  const auto chosen = [](const Layout& layout) {
    return std::count(layout.begin(), layout.end(), 1);
  };
  CHECK(chosen(lean) <= chosen(all));
  for (uint32_t i = 0; i < lean.size(); ++i) {
    if (lean[i] == 0) continue;
    sums.remove(i);
    CHECK_FALSE(sums.holds());
    sums.add(i);
  }
}

}  // namespace luxodus
