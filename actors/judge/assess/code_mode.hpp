// The code mode: every rule of the chosen codes, by direct light of the emergency luminaires alone,
// in clear air, with furniture and without. Thread rule: one thread, which has rows run on others.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/inspect/building.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Adds checks and the plan to `out`. `scenario` gives the doors.
/// Errors: a scene that cannot be compiled.
Result<void> assess_by_codes(const SceneDescription& scene, const Scenario& scenario,
                             const AssessOptions& options, const AssessProgress& progress,
                             Assessment& out);

}  // namespace luxodus
