// A scene of any kind from a number: everything that a scene file can say, in numbers that a scene
// file accepts, plain ones and extreme ones mixed. A pure function of the number; any thread.
// README.md says what it reaches.
#pragma once

#include <cstdint>

#include "scenes/light/world/description.hpp"

namespace luxodus::test {

struct RandomScene {
  SceneDescription description;
  Scenario scenario;
  int cells = 1;
  /// Opaque walls stand around everything that shines and everything that light passes, with some
  /// room: none of it may leave.
  bool closed = false;
};

RandomScene random_scene(uint64_t number);

}  // namespace luxodus::test
