// Layouts that differ from the best one: for people to choose from, and for what the program of the
// search does not know, such as smoke. Numbers alone. Pure: the same seed gives the same layouts.
// Thread rule: one thread.
#pragma once

#include <atomic>
#include <vector>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

struct AlternativesWish {
  size_t count = 8;
  /// Their objective may be larger than that of the best by this share: the cheapest alone say
  /// nothing of what more luminaires would bring.
  double dearer = 0.3;
  uint64_t seed = 1;
};

/// In how many places one has a luminaire, or another one, and the other has not.
size_t places_that_differ(const LayoutProblem& problem, const Layout& a, const Layout& b);

/// As many as are wished, or fewer where there are no more: all demands hold in each; each differs
/// from the best and from those before it in as many places as can be. Ends early at `interrupt`.
/// Requires: all holds in `best`.
std::vector<Layout> alternatives_to(const LayoutProblem& problem, const Layout& best,
                                    const AlternativesWish& wish,
                                    const std::atomic<bool>& interrupt);

}  // namespace luxodus
