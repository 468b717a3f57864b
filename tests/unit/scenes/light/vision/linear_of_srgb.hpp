// Decodes the bytes of a picture, for the tests of this folder. Pure; any thread.
#pragma once

#include <cmath>
#include <cstdint>

namespace luxodus::test {

/// The linear value of an sRGB byte (IEC 61966-2-1).
inline double linear_of_srgb_byte(uint8_t byte) {
  const double v = byte / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace luxodus::test
