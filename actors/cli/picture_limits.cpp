#include "actors/cli/picture_limits.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/cli/quantities.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

/// A number that was refused, with the option's name before the reason.
Problem of_option(const char* option, const Problem& refused) {
  return problem(std::string(option) + ": " + refused.text());
}

std::string error_text(double relative_error) {
  return std::isfinite(relative_error) ? fmt::format(", error {:.2g} %", 100 * relative_error) : "";
}

std::string paths_text(int paths) {
  return fmt::format("{} path{} a pixel", paths, paths == 1 ? "" : "s");
}

}  // namespace

std::vector<Option> options_of(PictureLimits& limits, const char* paths_name) {
  return {{paths_name,
           &limits.paths,
           "Number of paths per pixel at most",
           {.otherwise = "32; with --picture-time or --picture-error 65536",
            .range = Range{1, luxodus::limits::max_paths_per_pixel}}},
          {"--picture-time",
           &limits.time,
           "Time for all pictures together, after which no more paths are added, e.g. 60s",
           {.form = Form::duration, .otherwise = "none"}},
          {"--picture-error",
           &limits.error,
           "Error at which pictures end: the root mean square over pixels of the relative standard "
           "error of luminance, of the worst picture as PNG files show it, e.g. 10%",
           {.form = Form::share, .otherwise = "none"}}};
}

Result<void> read_limits(const PictureLimits& limits, PictureOptions& picture) {
  if (!limits.time.empty()) {
    const auto time = parse_seconds(limits.time);
    if (!time) return of_option("--picture-time", time.problem());
    picture.max_seconds = time.value();
  }
  if (!limits.error.empty()) {
    const auto error = parse_share(limits.error);
    if (!error) return of_option("--picture-error", error.problem());
    picture.target_error = error.value();
  }
  if (limits.paths)
    picture.paths_per_pixel = static_cast<int>(*limits.paths);
  else if (picture.max_seconds > 0 || picture.target_error > 0)
    picture.paths_per_pixel = luxodus::limits::max_paths_per_pixel;
  return {};
}

void show_pictures(ProgressLine& line, const PictureProgress& progress) {
  std::string what;
  if (progress.paths > 0) what = ", " + paths_text(progress.paths);
  line.show_share(progress.share, what + error_text(progress.relative_error));
}

void tell_rendered(const RenderedViews& rendered) {
  if (rendered.interrupted && rendered.paths == 0) {
    log_warning("interrupted before the pictures had one whole pass");
  } else if (rendered.interrupted) {
    log_warning("interrupted; the pictures of {}{} are there", paths_text(rendered.paths),
                error_text(rendered.relative_error));
  } else if (rendered.paths > 0) {
    log_info("pictures: {}{}", paths_text(rendered.paths), error_text(rendered.relative_error));
  }
}

}  // namespace luxodus::cli
