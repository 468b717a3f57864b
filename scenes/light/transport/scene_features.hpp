// What of the program a scene needs, and what is left out because nothing asks for it: each with
// its reason, for people. Pure.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct SceneFeature {
  std::string name;  // "media"
  bool on = false;
  std::string why;  // "no medium is active"
};

/// In the order in which a particle meets them.
std::vector<SceneFeature> features_of(const CompiledScene& scene);

}  // namespace luxodus
