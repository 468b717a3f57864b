// What an assessment was made of, as JSON: the project, luminaires, signs, routes, areas, materials
// and media of the scene, in SI units. A report is made of these alone, without the scene. Reads
// the project's logo again, else pure; any thread.
#pragma once

#include <filesystem>

#include "actors/judge/assess/assessment.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// Base64 of the logo as a PNG is in it, where there is one that can still be read.
Json project_json(const ProjectSettings& project);
/// Every emitter of the scene, in its order, with its fluxes and the factors that they contain.
Json luminaires_json(const SceneDescription& scene);
Json signs_json(const SceneDescription& scene);
/// {"routes", "areas", "emphasis"}.
Json places_json(const SceneDescription& scene);
Json materials_json(const SceneDescription& scene);
Json media_json(const SceneDescription& scene);
Json scenario_json(const SceneDescription& scene, const std::string& name);
/// Of each level its floor, its walls and its map of light; the codes' points of calculation.
Json plan_json(const Assessment& assessment);
/// Drawings under plans: their longest lines, or the base64 of their pixels as a PNG, if the file
/// can still be read.
Json backdrops_json(const SceneDescription& scene);

}  // namespace luxodus
