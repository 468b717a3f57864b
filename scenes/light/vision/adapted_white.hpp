// White as eyes take it: they adapt to the colour of the light on what they look at, completely
// only where it is bright and near to the colour of equal energy. Pure functions; any thread.
#pragma once

#include "scenes/light/optics/chromaticity.hpp"

namespace luxodus {

/// Colours of a scene as they look on a monitor whose white is D65. Law: Fairchild 1990,
/// "Formulation and testing of an incomplete-chromatic-adaptation model" (Color Research and
/// Application 16, 243, 1991): von Kries adaptation of each kind of cones, of a degree that falls
/// with the cube root of the luminance and with the distance of the light from equal energy.
class AdaptedWhite {
 public:
  /// `light`: a white surface in the scene, Y its luminance [cd/m2]. `monitor_cd_m2`: luminance of
  /// the monitor's white. Requires: both luminances > 0.
  AdaptedWhite(const Xyz& light, double monitor_cd_m2);

  /// The colour on the monitor; its luminance stays. The scene's light is D65 where adaptation is
  /// complete, and keeps a part of its colour where it is not.
  Xyz on_monitor(const Xyz& colour) const;

 private:
  std::array<double, 3> factor_;  // of each kind of cones
};

}  // namespace luxodus
