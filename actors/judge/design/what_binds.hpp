// How much of a layout is there because of one demand: the layout is solved again without it. Said
// as a difference of two layouts that exist, so that it holds as it is said. Numbers alone. Thread
// rule: as solve_layout.hpp.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "actors/judge/design/solve_layout.hpp"

namespace luxodus {

/// Exactly one of the three: a group, an option that is chosen and fails no more, or all failures.
struct Relaxation {
  std::optional<uint32_t> group, never_fails;
  bool all_failures = false;
};

/// Without a demand less is enough.
struct Relaxed {
  Relaxation without;
  double objective = 0;  // of a layout that holds all other demands
  double saved = 0;      // by it, of the objective: above 0
  int64_t fewer = 0;     // luminaires; may be below 0 where the objective is another
  bool exact = false;    // no layout saves more
};

struct WhatBindsSettings {
  double seconds = 30;
  uint64_t seed = 1;
  size_t demands = 5, luminaires = 3;  // that are tried
};

/// Those that save anything, the most first. What is tried: all failures together, the demands
/// that add most to the bound, and the luminaires whose failure leaves least. A layout that was not
/// proven optimal may itself be improved by the search: then `exact` is false. When the time is
/// out, fewer are tried, and what was begun is not `exact`. Nothing where the layout of `answer`
/// breaks a row.
std::vector<Relaxed> what_binds(const LayoutProblem& problem, const LayoutAnswer& answer,
                                const WhatBindsSettings& settings,
                                const std::atomic<bool>& interrupt);

/// One demand, whether it saves anything or not. The parts of the problem that it has to do with
/// are solved again within the time of the settings; after an interrupt, or when that is out, the
/// others stay as they are. Requires: the layout of `answer` breaks no row.
Relaxed solved_without(const LayoutProblem& problem, const LayoutAnswer& answer,
                       const Relaxation& demand, const WhatBindsSettings& settings,
                       const std::atomic<bool>& interrupt);

}  // namespace luxodus
