// Inputs of an assessment as JSON in SI units: project, luminaires, signs, routes, areas, materials
// and media of the scene. A report is made of these alone, without the scene. project_json and
// backdrops_json read pictures from disk; everything else is pure. Any thread.
#pragma once

#include <filesystem>

#include "actors/judge/assess/assessment.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// Contains the logo as a PNG in base64 if its file can still be read.
Json project_json(const ProjectSettings& project);
/// All emitters in the order of the scene, with their fluxes and the factors that these contain.
Json luminaires_json(const SceneDescription& scene);
Json signs_json(const SceneDescription& scene);
/// {"routes", "areas", "emphasis"}.
Json places_json(const SceneDescription& scene);
Json materials_json(const SceneDescription& scene);
Json media_json(const SceneDescription& scene);
Json scenario_json(const SceneDescription& scene, const std::string& name);
/// Floor, walls and illuminance map of each level; points of calculation of the codes.
Json plan_json(const Assessment& assessment);
/// Drawings under plans: their longest lines, or their pixels as a PNG in base64 if the file can
/// still be read.
Json backdrops_json(const SceneDescription& scene);

}  // namespace luxodus
