#include "actors/lab/study/scenes.hpp"

#include "scenes/light/transport/compile.hpp"
#include "scenes/light/world/measurements.hpp"

namespace luxodus {

StudyScenes::StudyScenes(const Study& study, const SceneDescription& description)
    : scenario_(study.scenario), description_(description) {
  // Geometry, media and light are unchanged, and so is every fetch of a particle.
  if (!study.whole_tally) count_by_object(description_);
}

Result<std::shared_ptr<const CompiledScene>> StudyScenes::get(int cells, int64_t batch_particles) {
  auto& made = made_[{cells, batch_particles}];
  if (made) return made;
  auto description = std::make_shared<SceneDescription>(description_);
  description->run.batch_particles = batch_particles;
  const auto scenario = find_scenario(*description, scenario_);
  if (!scenario) return scenario.problem();
  auto scene = compile_scene(std::move(description), scenario.value(), {cells});
  if (!scene) return scene.problem();
  made = std::move(scene).value();
  return made;
}

}  // namespace luxodus
