// Layouts that differ from the best one: for people to choose from, and for criteria that the
// integer program does not contain, such as smoke. It knows options and rows only, no geometry.
// Pure: the same seed gives the same layouts. Thread rule: one thread.
#pragma once

#include <atomic>
#include <vector>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

struct AlternativesWish {
  size_t count = 8;
  /// Largest share by which the objective may exceed that of the best layout: the cheapest layouts
  /// alone do not show what more luminaires would bring.
  double dearer = 0.3;
  uint64_t seed = 1;
};

/// Number of places at which two layouts have different options, or only one of them has an option.
size_t places_that_differ(const LayoutProblem& problem, const Layout& a, const Layout& b);

/// As many layouts as wished, or fewer if no more are found. All demands hold in each; each differs
/// from the best layout and from the earlier ones at as many places as possible. Ends early at
/// `interrupt`.
/// Requires: all demands hold in `best`.
std::vector<Layout> alternatives_to(const LayoutProblem& problem, const Layout& best,
                                    const AlternativesWish& wish,
                                    const std::atomic<bool>& interrupt);

}  // namespace luxodus
