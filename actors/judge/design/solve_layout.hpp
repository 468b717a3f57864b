// Solves a layout problem with a lower bound: a greedy layout, then an integer program to which
// violated rows are added until its solution violates none. The program is a relaxation of the
// problem, so its bound holds for the whole problem.
// Thread rule: one call at a time in a process (see mixed_integer_program.hpp).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

struct SolveSettings {
  double seconds = 120;
  double gap = 0;  // stop when the objective is within this share of the bound
  uint64_t seed = 1;
  int greedy_rounds = 200;  // neighbourhoods refilled, before and after the program
  Layout start = {};        // a known layout, completed and improved first; may be empty
  /// Bounds of the same problem, or of a relaxation of it.
  std::vector<RegionBound> known_regions = {};
};

/// How the search ended.
enum class LayoutEnd {
  optimal,
  within_gap,
  out_of_time,
  interrupted,
  infeasible,  // no layout exists
  unknown,     // time was up before a layout was found or its absence proven
};

struct LayoutAnswer {
  LayoutEnd end = LayoutEnd::unknown;
  Layout layout;                // empty: none was found
  double objective = 0;         // of `layout`
  double bound = 0;             // lower bound on every layout
  bool greedy = false;          // the greedy heuristic found a layout
  double greedy_objective = 0;  // of the pruned greedy layout
  double first_seconds = 0;     // until the first layout
  double seconds = 0;
  size_t rows = 0;  // of the last program
  int rounds = 0;
  std::vector<RegionBound> regions;    // lower bounds of regions
  std::vector<double> share_of_group;  // share of each group in the bound of the linear relaxation

  /// Share of the objective above the bound; 0 if optimal.
  double gap() const;
};

/// Current step, with the best objective (infinite if none) and the bound (0 if none) so far.
using SolveProgress = std::function<void(const std::string& what, double best, double bound)>;

LayoutAnswer solve_layout(const LayoutProblem& problem, const SolveSettings& settings,
                          const std::atomic<bool>& interrupt, const SolveProgress& progress);

/// A row that cannot be satisfied even with the best option at every place.
struct Shortage {
  uint32_t group = 0;
  glm::dvec3 place{0};
  double share = 0;  // of the requirement, from all places together
};

/// Why a problem has no solution.
struct Conflict {
  std::vector<Shortage> shortages;  // the worst row of each group that cannot hold by itself
  /// Otherwise an infeasible subset of groups, feasible without any one of them. If a time limit
  /// kept a group in the subset, it may not be needed.
  std::vector<uint32_t> groups;
  bool proven = true;
};
Conflict conflict_of(const LayoutProblem& problem, double seconds,
                     const std::atomic<bool>& interrupt);

}  // namespace luxodus
