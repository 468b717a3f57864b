// Tests layouts besides the best one: all demands hold in them, and they differ.
#include "actors/judge/design/alternatives.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/design/solve_layout.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"

namespace luxodus {
namespace {

using test::nobody;
using test::silent;

/// A corridor with a place every metre; each place lights the points within `reach` of it.
LayoutProblem row_of_places(uint32_t count, uint32_t reach) {
  LayoutProblem out;
  out.groups.push_back({DemandKind::minimum, RuleId::E5, {SubjectKind::route, "way"}, 1, 0});
  for (uint32_t i = 0; i < count; ++i) {
    LayoutOption option;
    option.place = i;
    option.position = {i, 0};
    out.options.push_back(option);
  }
  for (uint32_t p = 0; p < count; ++p) {
    auto terms = std::make_shared<std::vector<Term>>();
    for (uint32_t i = 0; i < count; ++i)
      if (std::max(i, p) - std::min(i, p) <= reach) terms->push_back({i, 1});
    out.points.push_back({terms, {p, 0, 0}});
    out.covers.push_back({0, terms, 1, {p, 0, 0}});
  }
  return out;
}

Layout best_of(const LayoutProblem& problem) {
  const LayoutAnswer answer = solve_layout(problem, {}, nobody, silent);
  REQUIRE(answer.end == LayoutEnd::optimal);
  return answer.layout;
}

}  // namespace

TEST_CASE("alternatives to a layout hold, differ, and stay below the allowed objective",
          "[design]") {
  const LayoutProblem problem = row_of_places(30, 2);
  const Layout best = best_of(problem);
  CHECK(objective_of(problem, best) == 6);
  AlternativesWish wish;
  wish.count = 10;
  wish.dearer = 0.34;
  const auto layouts = alternatives_to(problem, best, wish, nobody);
  CHECK(layouts.size() == wish.count);
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  bool any_dearer = false;
  for (size_t i = 0; i < layouts.size(); ++i) {
    sums.set(layouts[i]);
    CHECK(sums.holds());
    CHECK(objective_of(problem, layouts[i]) <= 6 * 1.34);
    any_dearer = any_dearer || objective_of(problem, layouts[i]) > 6;
    CHECK(places_that_differ(problem, layouts[i], best) > 0);
    for (size_t k = 0; k < i; ++k) CHECK(places_that_differ(problem, layouts[i], layouts[k]) > 0);
  }
  CHECK(any_dearer);
  CHECK(alternatives_to(problem, best, wish, nobody) == layouts);  // same seed
}

TEST_CASE("if only one layout is feasible there is no alternative", "[design]") {
  const LayoutProblem problem = row_of_places(3, 0);
  CHECK(alternatives_to(problem, best_of(problem), {}, nobody).empty());
}

TEST_CASE("fixed luminaires are at the same places in all alternatives", "[design]") {
  LayoutProblem problem = row_of_places(20, 2);
  problem.options[7].fixed = true;
  for (const Layout& layout : alternatives_to(problem, best_of(problem), {}, nobody))
    CHECK(layout[7] == 1);
}

TEST_CASE("an interrupted search for alternatives returns those found so far", "[design]") {
  const LayoutProblem problem = row_of_places(30, 2);
  const std::atomic<bool> interrupted{true};
  CHECK(alternatives_to(problem, best_of(problem), {}, interrupted).empty());
}

}  // namespace luxodus
