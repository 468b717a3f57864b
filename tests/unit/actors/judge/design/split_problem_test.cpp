// Tests problems that are split: dependent options stay together, and no constraint is lost.
#include "actors/judge/design/split_problem.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/design/solve_layout.hpp"
#include "runtime/core/random.hpp"
#include "tests/unit/actors/judge/design/ctrl_c.hpp"
#include "tests/unit/actors/judge/design/problems.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"

namespace luxodus {
namespace {

using test::sum_of;

/// Storeys, each with a line of places and points, with failures and a ratio. All storeys are equal
/// unless `varied`.
LayoutProblem storeys(uint32_t count, bool varied) {
  constexpr uint32_t places = 9, points = 14;
  Random random(3, RandomStream::test, 9);
  random.start(0);
  LayoutProblem out;
  out.groups = {{DemandKind::minimum, RuleId::E1, {SubjectKind::route, "way"}, 1, no_region},
                {DemandKind::failed, RuleId::none, {SubjectKind::route, "way"}, 1, no_region},
                {DemandKind::spread, RuleId::E4, {SubjectKind::route, "way"}, 1, no_region}};
  for (uint32_t storey = 0; storey < count; ++storey) {
    const double shift = varied ? 0.4 * random.uniform_double() : 0;
    for (uint32_t i = 0; i < places; ++i)
      out.options.push_back(
          {storey * places + i, 1, false, no_region, {static_cast<double>(i) + shift, 0}});
    FailureRows failures{1, 0.15, {}};
    SpreadRows spread{2, 12, {}, {}};
    for (uint32_t p = 0; p < points; ++p) {
      const double x = 0.65 * p;
      std::vector<Term> light;
      for (uint32_t i = 0; i < places; ++i) {
        const double away = x - out.options[storey * places + i].position.x;
        const double square = away * away + 4;
        light.push_back({storey * places + i, static_cast<float>(24 / (square * square))});
      }
      out.points.push_back({sum_of(light), {x, 0, 3.0 * storey}});
      const auto number = static_cast<uint32_t>(out.points.size() - 1);
      out.covers.push_back({0, out.points.back().light, 1, {x, 0, 3.0 * storey}});
      failures.points.push_back(number);
      spread.low.push_back(number);
      spread.high.push_back(number);
    }
    out.failures.push_back(failures);
    out.spreads.push_back(spread);
  }
  return out;
}

/// Adds a storey with options, points and groups of its own.
void add_storey(LayoutProblem& tower, const LayoutProblem& storey) {
  const auto options = static_cast<uint32_t>(tower.options.size());
  const auto points = static_cast<uint32_t>(tower.points.size());
  const auto groups = static_cast<uint32_t>(tower.groups.size());
  const auto places = static_cast<uint32_t>(tower.places());
  const auto moved = [&](const Terms& terms) {
    std::vector<Term> out = *terms;
    for (Term& term : out) term.option += options;
    return sum_of(out);
  };
  for (LayoutOption option : storey.options) {
    option.place += places;
    tower.options.push_back(option);
  }
  tower.groups.insert(tower.groups.end(), storey.groups.begin(), storey.groups.end());
  for (auto point : storey.points) {
    point.light = moved(point.light);
    tower.points.push_back(point);
  }
  for (auto cover : storey.covers) {
    cover.group += groups;
    cover.terms = moved(cover.terms);
    tower.covers.push_back(cover);
  }
  for (FailureRows failures : storey.failures) {
    failures.group += groups;
    for (uint32_t& point : failures.points) point += points;
    tower.failures.push_back(failures);
  }
  for (SpreadRows spread : storey.spreads) {
    spread.group += groups;
    for (uint32_t& point : spread.low) point += points;
    for (uint32_t& point : spread.high) point += points;
    tower.spreads.push_back(spread);
  }
}

LayoutAnswer answer_to(const LayoutProblem& problem) {
  SolveSettings settings;
  settings.greedy_rounds = 20;
  return solve_layout(problem, settings, test::nobody, test::silent);
}

}  // namespace

TEST_CASE("storeys are separate parts, and each row is in one of them", "[design][parts]") {
  const LayoutProblem problem = storeys(5, true);
  const auto parts = parts_of(problem);
  REQUIRE(parts.size() == 5);
  size_t covers = 0, failures = 0, spreads = 0;
  std::vector<int> seen(problem.options.size(), 0);
  for (const ProblemPart& part : parts) {
    CHECK(part.problem.options.size() == 9);
    CHECK(part.problem.places() == 9);
    covers += part.problem.covers.size();
    for (const FailureRows& rows : part.problem.failures) failures += rows.points.size();
    spreads += part.problem.spreads.size();
    for (const uint32_t option : part.options) ++seen[option];
  }
  CHECK(covers == problem.covers.size());
  CHECK(failures == problem.points.size());
  CHECK(spreads == 5);
  CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

TEST_CASE("one row across two storeys joins them in one part", "[design][parts]") {
  LayoutProblem problem = storeys(3, false);
  problem.covers.push_back({0, sum_of({{0, 1}, {9, 1}}), 1, {}});
  CHECK(parts_of(problem).size() == 2);
  problem.covers.push_back({0, sum_of({}), 1, {}});
  CHECK(parts_of(problem).size() == 1);
}

TEST_CASE("a tower needs as many luminaires as its storeys do, and its layout is feasible",
          "[design][parts]") {
  const LayoutAnswer one = answer_to(storeys(1, false));
  REQUIRE(one.end == LayoutEnd::optimal);
  const LayoutProblem tower = storeys(40, false);
  const LayoutAnswer all = answer_to(tower);
  REQUIRE(all.end == LayoutEnd::optimal);
  CHECK(all.objective == Approx(40 * one.objective));
  CHECK(all.bound == Approx(all.objective));
  const LayoutIndex index(tower);
  LayoutSums sums(index);
  sums.set(all.layout);
  CHECK(sums.holds());
  CHECK(objective_of(tower, all.layout) == Approx(all.objective));
}

TEST_CASE("without a row there is one part, and no luminaire is placed", "[design][parts]") {
  const LayoutProblem nothing_asked = test::with_options(5);
  REQUIRE(parts_of(nothing_asked).size() == 1);
  CHECK(parts_of(nothing_asked).front().options.size() == 5);
  const LayoutAnswer answer = answer_to(nothing_asked);
  CHECK(answer.end == LayoutEnd::optimal);
  CHECK(answer.objective == 0);
}

TEST_CASE("a layout of all storeys is found before any storey is searched", "[design][parts]") {
  SolveSettings no_time;
  no_time.seconds = 0;
  const LayoutProblem tower = storeys(10, true);
  const LayoutAnswer answer = solve_layout(tower, no_time, test::nobody, test::silent);
  REQUIRE_FALSE(answer.layout.empty());
  const LayoutIndex index(tower);
  LayoutSums sums(index);
  sums.set(answer.layout);
  CHECK(sums.holds());
  CHECK(answer.first_seconds <= answer.seconds);
  CHECK(answer.bound <= answer.objective + 1e-6);
}

TEST_CASE("Ctrl-C ends the search of all storeys, and the best layout of each is kept",
          "[design][parts]") {
  constexpr uint32_t count = 4;
  LayoutProblem tower;
  for (uint32_t storey = 0; storey < count; ++storey)
    add_storey(tower, test::random_problem(40 + storey, 60, 80));
  REQUIRE(parts_of(tower).size() == count);
  test::CtrlC ctrl_c;
  SolveSettings settings;
  settings.seconds = 20;
  settings.greedy_rounds = 5;
  // Progress of the second storey reports its first layout, its search, and the result of the
  // search. At the third message the first storey is solved, and the others have not begun.
  const LayoutAnswer answer =
      solve_layout(tower, settings, ctrl_c.interrupt(), ctrl_c.pressed_at("part 2 of 4", 3));
  REQUIRE(ctrl_c.interrupt());
  CHECK(answer.end == LayoutEnd::interrupted);
  const LayoutIndex index(tower);
  LayoutSums sums(index);
  sums.set(answer.layout);
  CHECK(sums.holds());
  CHECK(answer.objective == Approx(objective_of(tower, answer.layout)));
  CHECK(answer.objective <= answer.greedy_objective);
  CHECK(answer.bound > 0);
  CHECK(answer.bound < answer.objective);
}

TEST_CASE("a program keeps its handler of Ctrl-C while a layout is searched", "[design][parts]") {
  const test::CtrlC ctrl_c;
  SolveSettings settings;
  settings.seconds = 2;
  settings.greedy_rounds = 5;
  constexpr int enough_looks = 50;
  for (uint64_t seed = 40; seed < 80 && ctrl_c.times_looked() < enough_looks; ++seed) {
    const LayoutAnswer answer = solve_layout(test::random_problem(seed, 120, 160), settings,
                                             ctrl_c.interrupt(), test::silent);
    CHECK_FALSE(answer.layout.empty());
  }
  CHECK(ctrl_c.times_looked() > 0);
  CHECK(ctrl_c.times_taken() == 0);
}

TEST_CASE("a tower with one storey that cannot be lit has no layout", "[design][parts]") {
  LayoutProblem tower = storeys(4, false);
  tower.covers.push_back({0, sum_of({{0, 1}}), 2, {}});
  const LayoutAnswer answer = answer_to(tower);
  CHECK(answer.end == LayoutEnd::infeasible);
  CHECK(answer.layout.empty());
}

}  // namespace luxodus
