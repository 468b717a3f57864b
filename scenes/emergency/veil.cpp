#include "scenes/emergency/veil.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

/// Iris pigmentation of CIE 146: 0 black, 0.5 brown, 1.0 blue-green, 1.2 light blue.
constexpr double brown = 0.5;

}  // namespace

double veil_per_lux(double angle_deg, double age_years) {
  const double angle = std::clamp(angle_deg, 0.1, 100.0);
  const double ageing = 1 + std::pow(age_years / 62.5, 4);
  return 10 / std::pow(angle, 3) + (5 / (angle * angle) + 0.1 * brown / angle) * ageing +
         0.0025 * brown;
}

}  // namespace luxodus
