// Sheets of the products that a scene has, and which luminaire is of which: facts for schedules,
// intensities in two planes, and spacing tables. Pure functions; any thread.
#pragma once

#include "actors/judge/record/assessment_record.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Intensities [cd/klm, four digits] in the half planes `c_deg` and `c_deg` + 180 of a luminaire's
/// frame, every `step_deg` from -180 to 180, 0 straight down. Empty for spots and collimated beams,
/// whose curves would be lines, and for radiometric emitters.
std::vector<double> intensity_curve(const Emitter& e, double c_deg, double step_deg);

/// Adds the sheets of all luminaires and gives each the number of its own.
/// Requires: the record has the luminaires of the scene, in their order.
void add_sheets(const SceneDescription& scene, AssessmentRecord& record);

}  // namespace luxodus
