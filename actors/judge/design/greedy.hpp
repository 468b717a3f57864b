// Layouts without a proof: the luminaire that helps most per weight is taken until everything
// holds, those that are not needed are taken out again, and neighbourhoods are emptied and filled
// anew. A warm start for the integer program, what is left when time is short, and the choice among
// equals. Pure: the same seed gives the same layout. Thread rule: one thread.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "actors/judge/design/layout_problem.hpp"
#include "runtime/core/random.hpp"

namespace luxodus {

/// Completes a layout until all holds, taking from each place one option at most; none where it
/// finds no way. `noise`: of scores, 0 is the greedy choice itself.
std::optional<Layout> completed(const LayoutIndex& index, const Layout& begun, double noise,
                                Random& random);

/// Takes out what is not needed, the dearest first. Requires: all holds.
Layout pruned(const LayoutIndex& index, const Layout& layout);

/// Empties neighbourhoods and fills them anew, `rounds` times: never a larger objective, and among
/// equals a larger preference. Ends early at `interrupt` or when `out_of_time` says so.
/// Requires: all holds.
Layout improved(const LayoutIndex& index, Layout layout, int rounds, uint64_t seed,
                const std::atomic<bool>& interrupt, const std::function<bool()>& out_of_time);

}  // namespace luxodus
