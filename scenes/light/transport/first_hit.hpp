// What is known without chance of a ray of a picture: features for filters, and the light that
// emitters send straight to the eye. Plain values.
#pragma once

#include <vector>

#include "scenes/light/geometry/real.hpp"

namespace luxodus {

struct FirstHit {
  Vec3 normal{0};                   // of the surface met, towards the eye; 0: none was met
  double nearness = 0;              // one over the distance [1/m]
  double transmittance = 0;         // of the media before it, at the most luminous wavelengths
  std::vector<double> reflectance;  // Lambertian, by band
  std::vector<double> emitted;      // [W/(m2 sr)] by band: at the eye, through panes and media
};

}  // namespace luxodus
