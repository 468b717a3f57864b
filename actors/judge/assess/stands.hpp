// Where somebody stands who may read signs: on the routes, in open areas, and where the scene has
// observers. Pure; any thread.
#pragma once

#include <vector>

#include "scenes/emergency/remark.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Somebody at a place.
struct Stand {
  Subject from;  // a route, an open area or an observer
  double along_m = 0, stands_for = 0, height_m = 0;
  Observer observer;
  bool looks_ahead = true;  // else anywhere
};

/// All of a scene, and `observers`: those that it names.
std::vector<Stand> stands_of(const SceneDescription& scene, const std::vector<Observer>& observers);

}  // namespace luxodus
