#include "scenes/emergency/smoke_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

double jin_constant(SignLighting lighting) {
  return lighting == SignLighting::external ? 3 : 8;
}

double jin_distance_m(double constant, double extinction) {
  return extinction > 0 ? constant / extinction : std::numeric_limits<double>::infinity();
}

double irritant_distance_m(double constant, double extinction) {
  const double dry = jin_distance_m(constant, extinction);
  if (extinction < irritant_from) return dry;
  return dry * std::clamp(0.133 - 1.47 * std::log10(extinction), 0.0, 1.0);
}

double line_of_sight_distance_m(double constant, double extinction, double cosine) {
  return std::min(jin_distance_m(constant, extinction), farthest_visibility_m) * cosine;
}

}  // namespace luxodus
