// Chromaticity of the light of signs, for the estimate of colours at an eye: of the light that each
// colour of a face emits, of the room's light that it reflects, and of the room's light itself. The
// room's light is taken as that of all sources of the scenario together, so colours that walls and
// smoke give to it are left out. Immutable once made; any thread.
#pragma once

#include <vector>

#include "scenes/emergency/legibility.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// Luminances at one part of a face [cd/m2]: its own light and reflected light, both as they arrive
/// at the eye, and the light that smoke scatters into the line of sight.
struct ArrivedLight {
  double own = 0, reflected = 0, path = 0;
};

class SignChromaticity {
 public:
  explicit SignChromaticity(const CompiledScene& scene);

  /// Colours at the eye of legend, ground and face. `sign`: number in the description.
  ColoursAtEye at_eye(uint32_t sign, const ArrivedLight& legend, const ArrivedLight& ground) const;

 private:
  struct FaceColourLight {
    Tristimulus own{}, reflected{};  // Y = 1
  };
  /// Of one sign.
  struct FaceLight {
    std::vector<FaceColourLight> colours;
    ColourIndex legend = 0, ground = 0;
    double legend_share = 0, ground_share = 0;  // of the face's area
  };
  std::vector<FaceLight> faces_;  // by sign
  Tristimulus room_{};
};

}  // namespace luxodus
