// Sheets of the products that a scene has, and which luminaire is of which: facts for schedules,
// intensities in two planes, and spacing tables. Pure function; any thread.
#pragma once

#include "actors/judge/record/assessment_record.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Adds the sheets of all luminaires and gives each the number of its own.
/// Requires: the record has the luminaires of the scene, in their order.
void add_sheets(const SceneDescription& scene, AssessmentRecord& record);

}  // namespace luxodus
