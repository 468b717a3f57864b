// How many luminaires one demand costs: the layout is solved again without it. The saving is the
// difference of two layouts that exist, so it is a fact, not an estimate. It uses numbers only, no
// geometry. Thread rule: as solve_layout.hpp.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "actors/judge/design/solve_layout.hpp"

namespace luxodus {

/// Removes exactly one of three demands: a group, the failure of one chosen option, or all
/// failures.
struct Relaxation {
  std::optional<uint32_t> group, never_fails;
  bool all_failures = false;
};

/// The saving when a demand is removed.
struct Relaxed {
  Relaxation without;
  double objective = 0;  // of a layout that satisfies all other demands
  double saved = 0;      // of the objective: above 0
  int64_t fewer =
      0;  // number of luminaires saved; may be negative if the objective is not their number
  bool exact = false;  // no layout saves more
};

struct WhatBindsSettings {
  double seconds = 30;
  uint64_t seed = 1;
  size_t demands = 5, luminaires = 3;  // numbers to try
};

/// Demands that save something, the largest saving first. Tried are all failures together, the
/// demands with the largest shares of the bound, and the luminaires whose failure is tightest. If
/// the layout was not proven optimal, the search may improve it as well; then `exact` is false.
/// When time is out, fewer are tried, and an unfinished one is not `exact`. Empty if the layout of
/// `answer` violates a row.
std::vector<Relaxed> what_binds(const LayoutProblem& problem, const LayoutAnswer& answer,
                                const WhatBindsSettings& settings,
                                const std::atomic<bool>& interrupt);

/// The result for one demand, even if it saves nothing. The parts of the problem that contain the
/// demand are solved again within the time of the settings. After an interrupt or when time is out,
/// the remaining parts keep their layout. Requires: the layout of `answer` violates no row.
Relaxed solved_without(const LayoutProblem& problem, const LayoutAnswer& answer,
                       const Relaxation& demand, const WhatBindsSettings& settings,
                       const std::atomic<bool>& interrupt);

}  // namespace luxodus
