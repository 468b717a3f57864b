// How long pictures are refined: options of `luxodus run` and `luxodus render`, and what is said of
// pictures on the way. One thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/cli/options.hpp"
#include "actors/cli/progress_line.hpp"
#include "actors/display/pictures.hpp"

namespace luxodus::cli {

struct PictureLimits {
  std::optional<uint64_t> paths;
  std::string time, error;
};

/// `paths_name`: of the option that counts paths. Requires: `limits` outlives them.
std::vector<Option> options_of(PictureLimits& limits, const char* paths_name);

/// Into `picture`. Without a number of paths, a time or an error alone ends pictures.
/// Errors: a time or a share that is none, or not above 0.
Result<void> read_limits(const PictureLimits& limits, PictureOptions& picture);

/// "34 %, 12 paths, error 18 %, about 40 s left".
void show_pictures(ProgressLine& line, const PictureProgress& progress);
/// Logs what pictures are there, and that they were interrupted.
void tell_rendered(const RenderedViews& rendered);

}  // namespace luxodus::cli
