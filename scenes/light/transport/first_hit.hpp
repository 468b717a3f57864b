// Noise-free data of a picture's ray: features for the filter, and the light that emitters send
// straight to the eye. Plain values; any thread.
#pragma once

#include <vector>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

struct FirstHit {
  Vec3 normal{0};            // of the surface hit, towards the eye; 0: no hit
  double nearness = 0;       // one over the distance [1/m]
  double transmittance = 0;  // of the media before it, in the band with the most lumens per watt
  std::vector<double> reflectance;  // Lambertian, by band
  std::vector<double> emitted;      // [W/(m2 sr)] by band: at the eye, through panes and media
};

}  // namespace luxodus
