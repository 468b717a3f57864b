// A random scene of any kind from a number: everything that a scene file can describe, with values
// that a scene file accepts, ordinary and extreme ones mixed. A pure function of the number; any
// thread. README.md says what it reaches.
#pragma once

#include <cstdint>

#include "scenes/light/world/description.hpp"

namespace luxodus::test {

struct RandomScene {
  SceneDescription description;
  Scenario scenario;
  int cells = 1;
  /// Whether opaque walls enclose all emitters and all media with a margin: no light may leave.
  bool closed = false;
};

RandomScene random_scene(uint64_t number);

}  // namespace luxodus::test
