// The code mode: every rule of the chosen codes, by direct light of the emergency luminaires in
// clear air, with and without furniture. Thread rule: one thread, which has rows computed by
// others.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/inspect/building.hpp"
#include "runtime/core/atomic_file.hpp"

namespace luxodus {

/// Adds checks and the plan to `out`. The doors are those of `scenario`. Errors: a scene that
/// cannot be compiled.
Result<void> assess_by_codes(const SceneDescription& scene, const Scenario& scenario,
                             const AssessOptions& options, const AssessProgress& progress,
                             Assessment& out);

/// The checks alone, without a plan. Errors: as assess_by_codes.
Result<std::vector<Check>> checks_by_codes(const SceneDescription& scene, const Scenario& scenario,
                                           const std::vector<CodeChoice>& codes, int threads);

}  // namespace luxodus
