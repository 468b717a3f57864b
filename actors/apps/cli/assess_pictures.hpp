// Pictures of the judged state for the report of an assessment: what an eye sees from the scene's
// cameras, or from the starts of its routes. One thread, which has the work done by others.
#pragma once

#include <filesystem>

#include "actors/apps/cli/assess_command.hpp"

namespace luxodus::cli {

/// Writes pictures into folder/views. They show the state, and decide nothing: the paths are few,
/// and the same in every call. Without a place to look from there are none.
/// Errors: as judged_scenario, compile_scene and render_views.
Result<void> picture_state(const AssessmentJob& job, const std::filesystem::path& folder);

}  // namespace luxodus::cli
