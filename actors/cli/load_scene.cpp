#include "actors/cli/load_scene.hpp"

#include <algorithm>

#include "actors/cli/command.hpp"
#include "actors/cli/quantities.hpp"
#include "scenes/pack/scene_pack.hpp"
#include "scenes/scene_file/scene_file.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

std::shared_ptr<const SceneDescription> load_scene(const std::string& file,
                                                   ReadingWarnings warnings,
                                                   std::optional<double> at_s) {
  if (is_pack(file)) {
    if (at_s) {
      tell(problem_in(file, "a pack is of one time: pack the scene again with --at"));
      return nullptr;
    }
    auto packed = read_pack(file);
    if (packed) return packed.value();
    tell(packed.problem());
    return nullptr;
  }
  ReadScene read = read_scene(file, at_s);
  for (const Problem& p : read.problems.list()) tell(p);
  if (!read.scene) return nullptr;
  if (warnings == ReadingWarnings::told)
    for (const Problem& w : read.scene->warnings) warn(w);
  return std::make_shared<const SceneDescription>(std::move(*read.scene));
}

SceneAtTime reader_of_times(const std::string& file, const SceneDescription& scene) {
  if (!scene.time || scene.packed) return {};
  return reader_at_times(file);
}

SceneAtTime reader_at_times(const std::string& file) {
  return [file](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    ReadScene read = read_scene(file, at_s);
    if (!read.scene) return read.problems.list().front();
    return std::make_shared<const SceneDescription>(std::move(*read.scene));
  };
}

namespace {

std::string fault_of_time(const std::string& text) {
  const auto seconds = parse_time(text);
  return seconds ? std::string() : seconds.problem().what;
}

}  // namespace

Option times_option(std::vector<std::string>& at) {
  return {"--at",
          &at,
          "Times of the states of a scene that changes in time, e.g. 60s or 0s,60s,120s; routes "
          "are followed over several",
          {.form = Form::duration,
           .otherwise = "all states of [time], else the scene's own",
           .comma_separated = true,
           .fault = fault_of_time}};
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
          {.form = Form::duration, .fault = fault_of_time}};
}

std::optional<double> time_asked(const std::string& at) {
  if (at.empty()) return std::nullopt;
  return parse_time(at).value();
}

Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name) {
  if (name == "all" && !scene.scenarios.empty()) return scene.scenarios;
  auto one = find_scenario(scene, name == "all" ? "" : name);
  if (!one) return one.problem();
  return std::vector<Scenario>{one.value()};
}

}  // namespace luxodus::cli
