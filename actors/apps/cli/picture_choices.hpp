// How long pictures are refined and on what monitor they are shown: options of `luxodus run` and
// `luxodus render`, and messages about pictures. One thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/options.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "actors/results/pictures/pictures.hpp"

namespace luxodus::cli {

struct PictureChoices {
  std::optional<uint64_t> paths;
  std::string time, error;
  std::string exposure;
  std::string white = "lamps";
  std::string flames = "moment", tone = "neutral";
  MonitorModel monitor;
  std::vector<std::string> sight;  // limits to apply; empty: all
};

/// `paths_name`: the option that counts paths. Requires: `choices` outlives them.
std::vector<Option> options_of(PictureChoices& choices, const char* paths_name);

/// Without a number of paths, only the time or the error in `picture` ends it.
void limit_paths(const std::optional<uint64_t>& paths, PictureOptions& picture);
/// Reads the choices into `picture`, with limit_paths.
/// Errors: an invalid time, share or exposure, or one that is not above 0; a monitor whose white is
/// not above its black; limits of sight that exclude each other.
Result<void> read_choices(const PictureChoices& choices, PictureOptions& picture);

/// "34 %, 12 paths, error 18 %, about 40 s left".
void show_pictures(ProgressLine& line, const PictureProgress& progress);
/// Logs which pictures were written, and whether they were interrupted.
void tell_rendered(const RenderedViews& rendered);
/// Logs that pictures show a moment, if they do.
void tell_flames(const CompiledScene& scene, const PictureOptions& picture);
/// The files of pictures in the folder of their run.
OutputPlan plan_of_views(const SceneDescription& scene);
/// render_views with progress on the terminal, and a list of the pictures at the end.
Result<ExitCode> render_aloud(const std::filesystem::path& folder, const LocalRun& run,
                              const std::string& only_view, const PictureOptions& picture);

}  // namespace luxodus::cli
