// Verdicts on one sign for a live view, from its observers and routes, in the present state: moved,
// dimmed, in denser smoke. Takes seconds; any thread.
#pragma once

#include <atomic>

#include "actors/apps/view/live_trace.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// How well verdicts are known: provisional ones come in a third of the time, and more of them are
/// undecided.
enum class VerdictCare { provisional, sure };

/// A message of type "sign", or "refused" with the reason.
Json sign_verdicts(const SceneDescription& scene, const SceneEdits& edits,
                   const std::map<std::string, double>& factors, const std::string& sign,
                   VerdictCare care, const LiveOptions& options,
                   const std::atomic<bool>& interrupt);

}  // namespace luxodus
