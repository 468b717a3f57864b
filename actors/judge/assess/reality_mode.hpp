// The reality mode in one light: what people on the routes read of the signs with all light and all
// smoke, from paths traced from their eyes. Rounds of paths go on for undecided views. Thread rule:
// one thread, which has batches traced by others.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Adds views to `out`, in the scenario's smoke or in `smoke`. Requires, if nodes trace: the
/// scenario is in the scene's file. Errors: as judged_scene and irritation_is_said; `interrupt`;
/// more pairs of place and sign than limits::sights.
Result<void> assess_sights(const SceneDescription& scene, const Scenario& scenario,
                           const OtherSmoke& smoke, const AssessOptions& options,
                           const std::atomic<bool>& interrupt, const AssessProgress& progress,
                           Assessment& out);

}  // namespace luxodus
