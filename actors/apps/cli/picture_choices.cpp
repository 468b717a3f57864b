#include "actors/apps/cli/picture_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "actors/apps/cli/quantities.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "runtime/core/log.hpp"
#include "scenes/light/transport/flame_moment.hpp"

namespace luxodus {

namespace limits {
/// Range of the luminances that a picture can be exposed for.
constexpr double min_exposure_cd_m2 = 1e-6, max_exposure_cd_m2 = 1e9;
}  // namespace limits

namespace cli {

namespace {

/// A problem with a number, with the option's name before the reason.
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

std::vector<Option> options_of(PictureChoices& choices, const char* paths_name) {
  return {
      {paths_name,
       &choices.paths,
       "Number of paths per pixel, on average, at most",
       {.otherwise = "28; with --picture-time or --picture-error 65536",
        .range = Range{1, limits::max_paths_per_pixel}}},
      {"--picture-time",
       &choices.time,
       "Time for all pictures together, after which no more paths are added, e.g. 60s",
       {.form = Form::duration, .otherwise = "none"}},
      {"--picture-error",
       &choices.error,
       "Error at which pictures end: the root mean square over pixels, but for the worst "
       "hundredth, "
       "of the relative standard error of luminance; of the worst picture, as PNG files show it; "
       "e.g. 10%",
       {.form = Form::share, .otherwise = "none"}},
      {"--exposure",
       &choices.exposure,
       "Exposure of NAME.png: its own (each); one for all pictures of the call, which can then be "
       "compared (shared); or luminances of middle grey, of white, and of the brightest sign or "
       "steady flame, 0 for none [cd/m2], e.g. 0.84,12,75, as the text \"Exposure\" of a PNG file "
       "says them",
       {.otherwise = "each; for films shared"}},
      {"--white",
       &choices.white,
       "What PNG files show as white: the light of all sources together (lamps); the light on the "
       "surfaces in view, as far as an eye adapts to it: less where it is dim or warm (adapted); "
       "or D65, so that colours stay as they are (d65)",
       {.choices = {"lamps", "adapted", "d65"}}},
      {"--tone",
       &choices.tone,
       "Contrast of NAME.png: neutral, as luminances are; or that of film, with deeper shadows",
       {.choices = {"neutral", "film"}}},
      {"--flames",
       &choices.flames,
       "Shape of steady flames in pictures: turbulent, as at one moment, or their mean. Light and "
       "verdicts are always of the mean; flames of fire simulations stay as they are",
       {.choices = {"moment", "mean"}}},
      {"--display-white",
       &choices.monitor.white_cd_m2,
       "Luminance of white on the monitor that NAME_human.png is made for [cd/m2]",
       {.range = Range{1, 1e5}}},
      {"--display-black",
       &choices.monitor.black_cd_m2,
       "Luminance of its black, with the light of the room that it reflects [cd/m2]",
       {.range = Range{1e-4, 1e3}}},
      {"--human-limits",
       &choices.sight,
       "Limits of sight that NAME_human.png heeds beside that of contrast",
       {.otherwise = "glare,acuity,colour",
        .choices = {"glare", "acuity", "colour", "none"},
        .comma_separated = true}}};
}

namespace {

/// "GREY,WHITE,SIGN". Errors: other text; a grey that is not above 0; a white below grey.
Result<Exposure> parse_exposure(const std::string& text) {
  std::array<double, 3> numbers{};
  size_t count = 0;
  for (size_t begin = 0; begin <= text.size() && count <= numbers.size(); ++count) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const auto [rest, failed] = std::from_chars(text.data() + begin, text.data() + end,
                                                numbers[std::min<size_t>(count, 2)]);
    if (failed != std::errc() || rest != text.data() + end) break;
    begin = end + 1;
  }
  const Exposure out{numbers[0], numbers[1], numbers[2]};
  const auto in_range = [](double v) { return v >= 0 && v <= limits::max_exposure_cd_m2; };
  if (count != numbers.size() || !std::all_of(numbers.begin(), numbers.end(), in_range) ||
      !(out.grey_cd_m2 >= limits::min_exposure_cd_m2) || !(out.white_cd_m2 >= out.grey_cd_m2))
    return problem(
        "--exposure takes each, shared, or GREY,WHITE,SIGN in cd/m2, as in 0.84,12,75, with grey "
        "above 0 and white not below it, not \"" +
        text + "\"");
  return out;
}

Result<void> read_sight(const std::vector<std::string>& sight, HumanTone& human) {
  if (sight.empty()) return {};
  const auto heeds = [&](const char* limit) {
    return std::find(sight.begin(), sight.end(), limit) != sight.end();
  };
  if (heeds("none") && sight.size() > 1)
    return problem("--human-limits: \"none\" excludes all other limits");
  human.glare = heeds("glare");
  human.lose_acuity = heeds("acuity");
  human.lose_colour = heeds("colour");
  return {};
}

}  // namespace

Result<void> read_choices(const PictureChoices& choices, PictureOptions& picture) {
  if (!choices.time.empty()) {
    const auto time = parse_seconds(choices.time);
    if (!time) return of_option("--picture-time", time.problem());
    picture.max_seconds = time.value();
  }
  if (!choices.error.empty()) {
    const auto error = parse_share(choices.error);
    if (!error) return of_option("--picture-error", error.problem());
    picture.target_error = error.value();
  }
  picture.share_exposure = choices.exposure == "shared";
  if (!choices.exposure.empty() && choices.exposure != "each" && !picture.share_exposure) {
    const auto exposure = parse_exposure(choices.exposure);
    if (!exposure) return exposure.problem();
    picture.exposure = exposure.value();
  }
  picture.white = choices.white == "adapted" ? PictureWhite::adapted
                  : choices.white == "d65"   ? PictureWhite::d65
                                             : PictureWhite::lamps;
  picture.tone = choices.tone == "film" ? ToneStyle::film : ToneStyle::neutral;
  if (choices.flames == "moment") picture.flames_at_s = 0;
  picture.human.monitor = choices.monitor;
  if (auto read = read_sight(choices.sight, picture.human); !read) return read.problem();
  if (!(choices.monitor.white_cd_m2 > choices.monitor.black_cd_m2))
    return problem(fmt::format("--display-white {:g} must be above --display-black {:g}",
                               choices.monitor.white_cd_m2, choices.monitor.black_cd_m2));
  limit_paths(choices.paths, picture);
  return {};
}

void limit_paths(const std::optional<uint64_t>& paths, PictureOptions& picture) {
  if (paths)
    picture.paths_per_pixel = static_cast<int>(*paths);
  else if (picture.max_seconds > 0 || picture.target_error > 0)
    picture.paths_per_pixel = limits::max_paths_per_pixel;
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
  for (const auto& [name, exposure] : rendered.exposures)
    log_info("exposure of \"{}\": {}", name, text_of(exposure));
}

void tell_flames(const CompiledScene& scene, const PictureOptions& picture) {
  if (picture.flames_at_s && !steady_flames(scene).empty())
    log_info("pictures show a moment of the flames; --flames mean shows their mean");
}

OutputPlan plan_of_views(const SceneDescription& scene) {
  OutputPlan plan{{}, {"views"}};
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    for (std::string& file : files_of_view(scene, i)) plan.files.push_back(std::move(file));
  return plan;
}

Result<ExitCode> render_aloud(const std::filesystem::path& folder, const LocalRun& run,
                              const std::string& only_view, const PictureOptions& picture) {
  std::optional<ProgressLine> line("pictures");
  const auto rendered =
      render_views(folder, run, only_view, picture,
                   [&](const PictureProgress& progress) { show_pictures(*line, progress); });
  line.reset();
  if (!rendered) return rendered.problem();
  tell_flames(run.scene(), picture);
  tell_rendered(rendered.value());
  return rendered->interrupted ? ExitCode::interrupted : ExitCode::success;
}

}  // namespace cli

}  // namespace luxodus
