// Greedy heuristics without a bound. A layout is completed with the luminaire of the largest gain
// per weight, pruned of luminaires that are not needed, and improved by emptying and refilling
// neighbourhoods. Used as a warm start for the integer program, as the result when time is short,
// and for the choice among layouts of equal objective. Pure: the same seed gives the same layout.
// Thread rule: one thread.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "actors/judge/design/layout_problem.hpp"
#include "runtime/core/random.hpp"

namespace luxodus {

/// Completes a layout until all demands hold, with at most one option at each place; none if the
/// heuristic fails. `noise`: of scores; 0 is the plain greedy choice.
std::optional<Layout> completed(const LayoutIndex& index, const Layout& begun, double noise,
                                Random& random);

/// Removes luminaires that are not needed, the heaviest first. Requires: all demands hold.
Layout pruned(const LayoutIndex& index, const Layout& layout);

/// Empties and refills neighbourhoods `rounds` times. The objective never grows; among equal
/// objectives the larger preference is taken. Ends early at `interrupt` or when `out_of_time`
/// returns true.
/// Requires: all demands hold.
Layout improved(const LayoutIndex& index, Layout layout, int rounds, uint64_t seed,
                const std::atomic<bool>& interrupt, const std::function<bool()>& out_of_time);

}  // namespace luxodus
