// The checks of the codes for a live view, in its present state, by direct light in clear air: they
// take a moment, and follow every edit. What people read through smoke is asked of each sign
// (sign_verdicts.hpp). Any thread.
#pragma once

#include "actors/apps/view/live_json.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// A message of type "checks", without its id: with the viewers' factors, at their time after the
/// failure of the mains or else at that of the scenario. Errors: as checks_by_codes; a pack; a
/// scene without anything to check.
Result<Json> code_checks(const SceneDescription& scene, const SceneEdits& edits,
                         const LiveDimming& dimming, const LiveOptions& options);

}  // namespace luxodus
