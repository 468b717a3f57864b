// A scene without what its file asks to be measured, for those who ask other things of it. Pure;
// any thread.
#pragma once

#include "scenes/light/world/description.hpp"

namespace luxodus {

inline void clear_measurements(SceneDescription& scene) {
  scene.planes.clear();
  scene.probes.clear();
  scene.surface_groups.clear();
  scene.volume_groups.clear();
  scene.counting_planes.clear();
  scene.observers.clear();
  scene.cameras.clear();
}

/// One bin for each side of an object, none in smoke: as little to tally as can be.
inline void count_by_object(SceneDescription& scene) {
  clear_measurements(scene);
  scene.run.voxels = false;
  for (Object& object : scene.objects) object.one_patch = true;
}

}  // namespace luxodus
