// Removes the measurements that a scene file asks for, for code with other questions. Pure; any
// thread.
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

/// The smallest tally: one bin for each side of an object, none in smoke.
inline void count_by_object(SceneDescription& scene) {
  clear_measurements(scene);
  scene.run.voxels = false;
  for (Object& object : scene.objects) object.one_patch = true;
}

}  // namespace luxodus
