// Tests what a layout saves without one demand: savings are known by counting.
#include "actors/judge/design/what_binds.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/actors/judge/design/problems.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"

namespace luxodus {
namespace {

using test::ask;
using test::sum_of;
using test::with_options;

LayoutAnswer best_of(const LayoutProblem& problem) {
  SolveSettings settings;
  settings.greedy_rounds = 20;
  LayoutAnswer out = solve_layout(problem, settings, test::nobody, test::silent);
  REQUIRE(out.end == LayoutEnd::optimal);
  return out;
}

std::vector<Relaxed> binding(const LayoutProblem& problem) {
  return what_binds(problem, best_of(problem), {}, test::nobody);
}

void ask_after_failure(LayoutProblem& problem, std::vector<Term> list, double least) {
  problem.points.push_back({sum_of(std::move(list)), {}});
  problem.groups.push_back(
      {DemandKind::failed, RuleId::none, {SubjectKind::route, "a"}, least, no_region});
  problem.failures.push_back({static_cast<uint32_t>(problem.groups.size() - 1),
                              least,
                              {static_cast<uint32_t>(problem.points.size() - 1)}});
}

}  // namespace

TEST_CASE("without failures two luminaires of three would not be needed", "[design][binding]") {
  LayoutProblem problem = with_options(4);
  const std::vector<Term> all{{0, 1}, {1, 1}, {2, 1}, {3, 1}};
  ask(problem, all, 1, "a");
  ask_after_failure(problem, all, 2);
  const auto found = binding(problem);
  REQUIRE_FALSE(found.empty());
  const Relaxed& most = found.front();
  CHECK(most.saved == Approx(2));
  CHECK(most.fewer == 2);
  CHECK(most.objective == Approx(1));
  CHECK(most.exact);
  CHECK((most.without.all_failures || most.without.group == 1u));
}

TEST_CASE("the single failure of one luminaire costs two more luminaires", "[design][binding]") {
  // Luminaire 0 is needed anyway and gives everything by itself; if it fails, two others must.
  LayoutProblem problem = with_options(4);
  ask(problem, {{0, 1}}, 1, "only by the first");
  ask_after_failure(problem, {{0, 2}, {1, 1}, {2, 1}, {3, 1}}, 2);
  REQUIRE(best_of(problem).objective == Approx(3));
  const auto found = binding(problem);
  const auto at = std::find_if(found.begin(), found.end(),
                               [](const Relaxed& one) { return one.without.never_fails == 0u; });
  REQUIRE(at != found.end());
  CHECK(at->saved == Approx(2));
  CHECK(at->exact);
}

TEST_CASE("a demand that costs nothing is not reported", "[design][binding]") {
  LayoutProblem problem = with_options(3);
  ask(problem, {{0, 1}, {1, 1}}, 1, "a");
  ask(problem, {{0, 1}, {1, 1}, {2, 1}}, 1, "b");
  for (const Relaxed& one : binding(problem)) CHECK(one.saved > 0);
  // Each demand follows from the other: without one of them as many are needed.
  CHECK(binding(problem).empty());
}

TEST_CASE("in a tower only the parts that contain a demand are solved again", "[design][binding]") {
  LayoutProblem problem = with_options(4);
  ask(problem, {{0, 1}, {1, 1}}, 2, "below");
  ask(problem, {{2, 1}, {3, 1}}, 1, "above");
  const auto found = binding(problem);
  REQUIRE(found.size() == 2);
  CHECK(found[0].without.group == 0u);
  CHECK(found[0].saved == Approx(2));
  CHECK(found[0].objective == Approx(1));
  CHECK(found[1].without.group == 1u);
  CHECK(found[1].saved == Approx(1));
  CHECK(found[1].objective == Approx(2));
}

TEST_CASE("all storeys share the time of a demand, and an unfinished result is not exact",
          "[design][binding]") {
  constexpr uint32_t storeys = 40;
  LayoutProblem problem = with_options(2 * storeys);
  for (uint32_t i = 0; i < 2 * storeys; i += 2) {
    const std::vector<Term> both{{i, 1}, {i + 1, 1}};
    ask(problem, both, 1, "a");
    ask_after_failure(problem, both, 1);
  }
  const LayoutAnswer best = best_of(problem);
  REQUIRE(best.objective == Approx(2 * storeys));
  const Relaxation no_failures{{}, {}, true};
  SECTION("with enough time each storey saves one luminaire") {
    const Relaxed found = solved_without(problem, best, no_failures, {}, test::nobody);
    CHECK(found.exact);
    CHECK(found.saved == Approx(storeys));
    CHECK(found.fewer == storeys);
  }
  SECTION("without time no storey is solved") {
    WhatBindsSettings none;
    none.seconds = 0;
    const Relaxed found = solved_without(problem, best, no_failures, none, test::nobody);
    CHECK_FALSE(found.exact);
    CHECK(found.saved == 0);
    CHECK(found.objective == best.objective);
    CHECK(what_binds(problem, best, none, test::nobody).empty());
  }
  SECTION("after an interrupt no storey is solved") {
    const std::atomic<bool> interrupted{true};
    const Relaxed found = solved_without(problem, best, no_failures, {}, interrupted);
    CHECK_FALSE(found.exact);
    CHECK(found.saved == 0);
    CHECK(what_binds(problem, best, {}, interrupted).empty());
  }
}

TEST_CASE("a layout that violates a row has no binding demands", "[design][binding]") {
  LayoutProblem problem = with_options(2);
  ask(problem, {{0, 1}, {1, 1}}, 2, "a");
  LayoutAnswer answer = best_of(problem);
  answer.layout[0] = 0;
  CHECK(what_binds(problem, answer, {}, test::nobody).empty());
}

TEST_CASE("a search that starts from a layout returns none that is worse", "[design][binding]") {
  LayoutProblem problem = with_options(4);
  ask(problem, {{0, 1}, {1, 1}, {2, 1}, {3, 1}}, 2, "a");
  SolveSettings settings;
  settings.seconds = 0;
  settings.start = {1, 1, 1, 0};
  const LayoutAnswer answer = solve_layout(problem, settings, test::nobody, test::silent);
  REQUIRE_FALSE(answer.layout.empty());
  CHECK(answer.objective == Approx(2));
}

}  // namespace luxodus
