// Which features of the tracer a scene uses and which are left out, each with the reason, for
// people. Pure; any thread.
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

/// In the order in which a particle encounters them.
std::vector<SceneFeature> features_of(const CompiledScene& scene);

}  // namespace luxodus
