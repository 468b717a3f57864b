// The best layout of a problem, with a proof of how good it is: a greedy layout, then an integer
// program that is given the rows that matter one after another, until its solution breaks none.
// Its bound holds for the whole problem, since rows that are left out only make it easier.
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
  double gap = 0;  // ends within this share of the best possible
  uint64_t seed = 1;
  int greedy_rounds = 200;  // of neighbourhoods that are filled anew, before and after the program
  Layout start = {};        // any that is known: it is made to hold and improved first
  /// Of the same problem, or of one that asks for less.
  std::vector<RegionBound> known_regions = {};
};

/// How the search ended.
enum class LayoutEnd {
  optimal,
  within_gap,
  out_of_time,
  interrupted,
  infeasible,  // no layout exists
  unknown,     // time was out before any layout was found, or it was known that there is none
};

struct LayoutAnswer {
  LayoutEnd end = LayoutEnd::unknown;
  Layout layout;                // empty where none was found
  double objective = 0;         // of it
  double bound = 0;             // of every layout
  bool greedy = false;          // the greedy choice found a layout
  double greedy_objective = 0;  // of it, pruned
  double first_seconds = 0;     // until the first layout
  double seconds = 0;
  size_t rows = 0;  // of the last program
  int rounds = 0;
  std::vector<RegionBound> regions;    // what they weigh at least
  std::vector<double> share_of_group;  // of the bound of the program without whole numbers

  /// Of the objective that the bound leaves open; 0 of an optimal one.
  double gap() const;
};

/// What is going on; best and bound so far (infinite, and 0, where there is none).
using SolveProgress = std::function<void(const std::string& what, double best, double bound)>;

LayoutAnswer solve_layout(const LayoutProblem& problem, const SolveSettings& settings,
                          const std::atomic<bool>& interrupt, const SolveProgress& progress);

/// A row that no layout can give enough to: with the best option of every place.
struct Shortage {
  uint32_t group = 0;
  glm::dvec3 place{0};
  double share = 0;  // of what is asked for that all places together give
};

/// Why a problem has no solution.
struct Conflict {
  std::vector<Shortage> shortages;  // of each group that cannot hold by itself, the worst
  /// Else groups that cannot hold together, while they can without any one of them. Where a limit
  /// of time kept a group in, it is not known that it is needed.
  std::vector<uint32_t> groups;
  bool proven = true;
};
Conflict conflict_of(const LayoutProblem& problem, double seconds,
                     const std::atomic<bool>& interrupt);

}  // namespace luxodus
