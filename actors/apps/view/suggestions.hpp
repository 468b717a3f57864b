// Suggests luminaires to a live view, for the building in its present state, including additions.
// Takes seconds; any thread, one at a time in a process.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "actors/apps/view/live_trace.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// A message of type "suggested", or "refused" with the reason. `free`: names of luminaires added
/// in this view that may be removed; all others stay as they are.
Json suggestion(const SceneDescription& scene, const SceneEdits& edits,
                const std::vector<std::string>& free, const LiveOptions& options,
                const std::atomic<bool>& interrupt);

}  // namespace luxodus
