#include "actors/apps/cli/load_scene.hpp"

#include <algorithm>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "runtime/core/reading_share.hpp"

namespace luxodus::cli {

LoadedScene load_scene(const std::string& file, ReadingWarnings warnings,
                       std::optional<double> at_s, FireFrames frames) {
  const OpenedScene opened = [&] {
    ReadingShare share;
    const WaitingLine waiting("reading " + file, &share);
    return open_scene(file, at_s, {}, frames, &share);
  }();
  for (const Problem& p : opened.problems.list()) tell(p);
  // A pack's warnings were printed when it was written.
  if (opened.scene && !opened.scene->packed && warnings == ReadingWarnings::told)
    for (const Problem& w : opened.scene->warnings) warn(w);
  if (!opened.scene) return {nullptr, opened.problems.kind()};
  return {opened.scene};
}

SceneAtTime reader_of_times(const std::string& file, const SceneDescription& scene,
                            FireFrames frames) {
  if (!scene.time || scene.packed) return {};
  return reader_at_times(scene, file, frames);
}

Option times_option(std::vector<std::string>& at) {
  return {"--at",
          &at,
          "Times of the states of a scene that changes in time, e.g. 60s or 0s,60s,120s; routes "
          "are followed over several",
          {.form = Form::duration,
           .otherwise = "all states of [time], else the scene's own",
           .comma_separated = true,
           .check = check_time}};
}

std::vector<double> times_asked(const std::vector<std::string>& at) {
  std::vector<double> out;
  for (const std::string& text : at) out.push_back(parse_time(text).value());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Option at_option(std::string& at) {
  return {"--at",
          &at,
          "Time of the state of a scene that changes in time, e.g. 60s, instead of its own",
          {.form = Form::duration, .check = check_time}};
}

std::optional<double> time_asked(const std::string& at) {
  if (at.empty()) return std::nullopt;
  return parse_time(at).value();
}

}  // namespace luxodus::cli
