#include "scenes/emergency/eyes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

double protan_luminance(const Tristimulus& light) {
  constexpr double x = -0.15516, y = 0.45692, z = 0.03287;
  return (x * light[0] + y * light[1] + z * light[2]) / (x + y + z);
}

double chromatic_difference(const Tristimulus& a, const Tristimulus& b) {
  const auto sum = [](const Tristimulus& t) { return t[0] + 15 * t[1] + 3 * t[2]; };
  if (!(sum(a) > 0) || !(sum(b) > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double u = 4 * (a[0] / sum(a) - b[0] / sum(b));
  const double v = 9 * (a[1] / sum(a) - b[1] / sum(b));
  return std::hypot(u, v);
}

}  // namespace luxodus
