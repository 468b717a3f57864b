#include "actors/study/scenes.hpp"

#include "scenes/transport/compile.hpp"

namespace luxodus {

namespace {

/// Leaves one bin for each side of an object, and no paths from eyes: geometry, media and light,
/// and so every fetch of a particle, stay what they are.
void count_by_object(SceneDescription& scene) {
  scene.planes.clear();
  scene.probes.clear();
  scene.surface_groups.clear();
  scene.volume_groups.clear();
  scene.counting_planes.clear();
  scene.observers.clear();
  scene.cameras.clear();
  scene.run.voxels = false;
  for (Object& object : scene.objects) object.one_patch = true;
}

}  // namespace

StudyScenes::StudyScenes(const Study& study, const SceneDescription& description)
    : scenario_(study.scenario), description_(description) {
  if (!study.whole_tally) count_by_object(description_);
}

Result<std::shared_ptr<const CompiledScene>> StudyScenes::get(int cells, int64_t batch_particles) {
  auto& made = made_[{cells, batch_particles}];
  if (made) return made;
  auto description = std::make_shared<SceneDescription>(description_);
  description->run.batch_particles = batch_particles;
  const auto scenario = find_scenario(*description, scenario_);
  if (!scenario.ok()) return scenario.problem();
  auto scene = compile_scene(std::move(description), scenario.value(), {cells});
  if (!scene.ok()) return scene.problem();
  made = std::move(scene).value();
  return made;
}

}  // namespace luxodus
