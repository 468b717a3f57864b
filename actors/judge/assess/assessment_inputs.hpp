// Inputs of an assessment for its record, in SI units: project, luminaires, signs, routes, areas,
// materials and media of the scene. Pictures of logos and backdrops are read from disk; everything
// else is pure. Any thread.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/record/assessment_record.hpp"

namespace luxodus {

/// Adds all inputs: emitters and signs in the order of the scene, the logo if its file can still be
/// read, floors with their walls and illuminance maps.
void add_inputs(const SceneDescription& scene, const Assessment& assessment,
                AssessmentRecord& record);

/// Drawings under plans: their longest lines, or their pixels as a PNG if the file can still be
/// read.
std::vector<BackdropRecord> backdrops_of(const SceneDescription& scene);

}  // namespace luxodus
