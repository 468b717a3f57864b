// Layout problems as numbers, for tests of solvers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "actors/judge/design/layout_problem.hpp"
#include "runtime/core/random.hpp"

namespace luxodus::test {

inline Terms sum_of(std::vector<Term> list) {
  return std::make_shared<const std::vector<Term>>(std::move(list));
}

/// A problem with `options` luminaires of one type and weight 1, each at its own place.
inline LayoutProblem with_options(uint32_t options) {
  LayoutProblem out;
  for (uint32_t i = 0; i < options; ++i)
    out.options.push_back({i, 1, false, no_region, {static_cast<double>(i), 0}});
  return out;
}

/// Adds a demand with one row: the sum is at least `least`.
inline void ask(LayoutProblem& problem, std::vector<Term> list, double least, const char* subject) {
  problem.groups.push_back(
      {DemandKind::minimum, RuleId::E1, {SubjectKind::route, subject}, least, no_region});
  problem.covers.push_back(
      {static_cast<uint32_t>(problem.groups.size() - 1), sum_of(std::move(list)), least, {}});
}

/// Random places and points in a square; two types at every other place; failures and a spread.
inline LayoutProblem random_problem(uint64_t seed, uint32_t options, uint32_t points) {
  Random random(seed, RandomStream::test);
  random.start(0);
  LayoutProblem out;
  constexpr double side_m = 12, height_m = 3;
  for (uint32_t i = 0; i < options; ++i) {
    LayoutOption option;
    option.place = i / 2;
    option.weight = i % 2 == 0 ? 1 : 1 + std::floor(3 * random.uniform_double());
    const double x = random.uniform_double(), y = random.uniform_double();
    option.position = i % 2 == 0 ? glm::dvec2(x, y) * side_m : out.options.back().position;
    out.options.push_back(option);
  }
  for (const DemandKind kind : {DemandKind::minimum, DemandKind::failed, DemandKind::spread})
    out.groups.push_back({kind, RuleId::none, {SubjectKind::open_area, "square"}, 1, no_region});
  FailureRows failures{1, 0.05, {}};
  SpreadRows spread{2, 25, {}, {}};
  for (uint32_t p = 0; p < points; ++p) {
    const double x = random.uniform_double() * side_m, y = random.uniform_double() * side_m;
    std::vector<Term> light;
    for (uint32_t i = 0; i < options; ++i) {
      const glm::dvec2 away = out.options[i].position - glm::dvec2(x, y);
      const double square = glm::dot(away, away) + height_m * height_m;
      const double candela = i % 2 == 0 ? 60 : 110;
      light.push_back({i, static_cast<float>(candela * height_m * height_m / (square * square))});
    }
    out.points.push_back({sum_of(light), {x, y, 0}});
    out.covers.push_back({0, out.points.back().light, 0.6, {x, y, 0}});
    failures.points.push_back(p);
    spread.low.push_back(p);
    spread.high.push_back(p);
  }
  out.failures.push_back(failures);
  out.spreads.push_back(spread);
  return out;
}

/// All feasible subsets with at most one option at each place.
inline std::vector<Layout> all_that_hold(const LayoutProblem& problem) {
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  std::vector<Layout> out;
  const auto count = static_cast<uint32_t>(problem.options.size());
  for (uint32_t bits = 0; bits < 1u << count; ++bits) {
    Layout layout(count, 0);
    std::vector<int> at(problem.places(), 0);
    bool one_each = true;
    for (uint32_t i = 0; i < count; ++i) {
      layout[i] = static_cast<char>(bits >> i & 1);
      at[problem.options[i].place] += layout[i];
      one_each = one_each && at[problem.options[i].place] <= 1;
    }
    if (!one_each) continue;
    sums.set(layout);
    if (sums.holds()) out.push_back(std::move(layout));
  }
  return out;
}

/// The smallest objective of all feasible subsets; infinite if there is none.
inline double best_of_all_subsets(const LayoutProblem& problem) {
  double best = std::numeric_limits<double>::infinity();
  for (const Layout& layout : all_that_hold(problem))
    best = std::min(best, objective_of(problem, layout));
  return best;
}

}  // namespace luxodus::test
