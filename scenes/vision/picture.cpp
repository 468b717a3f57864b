#include "scenes/vision/picture.hpp"

#include <cmath>

namespace luxodus {

// IEC 61966-2-1: a straight foot, then a power law.
uint8_t srgb_byte(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const double encoded =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(255 * encoded));
}

}  // namespace luxodus
