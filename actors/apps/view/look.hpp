// Data of a live view besides geometry and light: faces of lamps, and gloss. Pure; any thread.
#pragma once

#include "actors/apps/view/gloss.hpp"
#include "actors/apps/view/lamps.hpp"

namespace luxodus {

struct LiveLook {
  LiveLamps lamps;
  std::vector<LiveGloss> gloss;
};

inline LiveLook look_of(const CompiledScene& scene) {
  return {lamps_of(scene), gloss_of(scene)};
}

}  // namespace luxodus
