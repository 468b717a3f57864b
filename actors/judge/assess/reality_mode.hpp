// The reality mode: what people on the routes read of the signs, with all light and all smoke, from
// paths traced from their eyes. Rounds of paths go on where a verdict is undecided. Thread rule:
// one thread, which has batches traced by others.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Adds sights to `out`, in the scenario's smoke or another. Requires, where nodes
/// trace: the scenario is one of the scene's file. Errors: as judged_scene; irritation_is_said;
/// `interrupt`; more pairs of place and sign than a limit.
Result<void> assess_sights(const SceneDescription& scene, const Scenario& scenario,
                           const OtherSmoke& smoke, const AssessOptions& options,
                           const std::atomic<bool>& interrupt, const AssessProgress& progress,
                           Assessment& out);

}  // namespace luxodus
