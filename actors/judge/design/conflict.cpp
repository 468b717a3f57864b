// Finds why a problem has no layout: rows that no place can satisfy, or else an infeasible subset
// of groups.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "actors/judge/design/greedy.hpp"
#include "actors/judge/design/growing_program.hpp"
#include "actors/judge/design/solve_layout.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// The problem with some of its groups only.
LayoutProblem only(const LayoutProblem& problem, const std::set<uint32_t>& groups) {
  LayoutProblem out = problem;
  const auto other = [&](const auto& rows) { return !groups.contains(rows.group); };
  std::erase_if(out.covers, other);
  std::erase_if(out.failures, other);
  std::erase_if(out.spreads, other);
  return out;
}

enum class Exists { yes, no, not_known };

Exists layout_exists(const LayoutProblem& problem, double seconds,
                     const std::atomic<bool>& interrupt) {
  const LayoutIndex index(problem);
  Random random(1, RandomStream::layout);
  random.start(0);
  if (completed(index, {}, 0, random)) return Exists::yes;
  GrowingProgram growing(problem, true);
  for (const Violation& v : first_rows(problem)) growing.add(v);
  LayoutSums sums(index);
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  for (int round = 0; round < limits::row_rounds; ++round) {
    const double left = seconds - 1e-9 * static_cast<double>(clock.now() - began);
    if (left <= 0 || interrupt) return Exists::not_known;
    const ProgramAnswer found =
        solve_program(growing.program(), {.seconds = left, .any_solution = true}, interrupt, {});
    if (found.end == ProgramEnd::infeasible) return Exists::no;
    if (found.values.empty()) return Exists::not_known;
    sums.set(growing.layout_of(found.values));
    const auto broken = sums.violations();
    if (broken.empty()) return Exists::yes;
    for (const Violation& v : spread_out(problem, broken, limits::rows_per_round)) growing.add(v);
  }
  return Exists::not_known;
}

/// Sum over places of the best option.
double max_of(const LayoutProblem& problem, const std::vector<Term>& terms,
              std::vector<double>& of_place) {
  std::fill(of_place.begin(), of_place.end(), 0);
  for (const Term& term : terms) {
    double& best = of_place[problem.options[term.option].place];
    best = std::max(best, static_cast<double>(term.value));
  }
  return std::accumulate(of_place.begin(), of_place.end(), 0.0);
}

std::vector<Shortage> shortages_of(const LayoutProblem& problem) {
  std::map<uint32_t, Shortage> worst;
  const auto offer = [&](uint32_t group, const glm::dvec3& place, double share) {
    if (share >= 1 - sum_tolerance) return;
    const auto [at, fresh] = worst.try_emplace(group, Shortage{group, place, share});
    if (!fresh && share < at->second.share) at->second = {group, place, share};
  };
  std::vector<double> of_place(problem.places(), 0);
  for (const CoverRow& row : problem.covers)
    offer(row.group, row.place, max_of(problem, *row.terms, of_place) / row.least);
  for (const FailureRows& rows : problem.failures)
    for (const uint32_t p : rows.points) {
      const double all = max_of(problem, *problem.points[p].light, of_place);
      const double one = of_place.empty() ? 0 : *std::max_element(of_place.begin(), of_place.end());
      offer(rows.group, problem.points[p].place, (all - one) / rows.least);
    }
  std::vector<Shortage> out;
  for (const auto& [group, shortage] : worst) out.push_back(shortage);
  return out;
}

}  // namespace

Conflict conflict_of(const LayoutProblem& problem, double seconds,
                     const std::atomic<bool>& interrupt) {
  Conflict out;
  out.shortages = shortages_of(problem);
  if (!out.shortages.empty()) return out;
  std::set<uint32_t> left;
  for (const auto& rows : problem.covers) left.insert(rows.group);
  for (const auto& rows : problem.failures) left.insert(rows.group);
  for (const auto& rows : problem.spreads) left.insert(rows.group);
  // Deletion filter: a group without which the problem is still infeasible is dropped from the
  // subset (Chinneck and Dravnieks, ORSA Journal on Computing 3, 1991).
  const double each = seconds / static_cast<double>(std::max<size_t>(left.size(), 1));
  for (const uint32_t group : std::set<uint32_t>(left)) {
    std::set<uint32_t> without = left;
    without.erase(group);
    const Exists exists = layout_exists(only(problem, without), each, interrupt);
    if (exists == Exists::no) left = without;
    if (exists == Exists::not_known) out.proven = false;
  }
  out.groups.assign(left.begin(), left.end());
  return out;
}

}  // namespace luxodus
