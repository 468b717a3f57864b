#include "actors/cli/load_scene.hpp"

#include "actors/cli/command.hpp"
#include "scenes/pack/scene_pack.hpp"
#include "scenes/scene_file/scene_file.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

std::shared_ptr<const SceneDescription> load_scene(const std::string& file,
                                                   ReadingWarnings warnings) {
  if (is_pack(file)) {
    auto packed = read_pack(file);
    if (packed) return packed.value();
    tell(packed.problem());
    return nullptr;
  }
  ReadScene read = read_scene(file);
  for (const Problem& p : read.problems.list()) tell(p);
  if (!read.scene) return nullptr;
  if (warnings == ReadingWarnings::told)
    for (const Problem& w : read.scene->warnings) warn(w);
  return std::make_shared<const SceneDescription>(std::move(*read.scene));
}

Result<std::vector<Scenario>> chosen_scenarios(const SceneDescription& scene,
                                               const std::string& name) {
  if (name == "all" && !scene.scenarios.empty()) return scene.scenarios;
  auto one = find_scenario(scene, name == "all" ? "" : name);
  if (!one) return one.problem();
  return std::vector<Scenario>{one.value()};
}

}  // namespace luxodus::cli
