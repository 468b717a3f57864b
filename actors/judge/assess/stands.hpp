// Places of people who may read signs: on routes, in open areas, and at the observers of the scene.
// Pure function; any thread.
#pragma once

#include <vector>

#include "scenes/emergency/remark.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

/// A person at a place.
struct Stand {
  Subject from;  // a route, an open area or an observer
  double along_m = 0, stands_for = 0, height_m = 0;
  Observer observer;
  bool looks_ahead = true;  // false: in any direction
};

/// All places of a scene, with `observers`, which it names.
std::vector<Stand> stands_of(const SceneDescription& scene, const std::vector<Observer>& observers);

}  // namespace luxodus
