// Pictures of the display: light per pixel (XYZ), and sRGB bytes. Plain values; any thread.
// scenes/formats/images and actors/results/files write them; tone.hpp converts one to the other.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace luxodus {

/// Row-major, top row first. XYZ per pixel with Y in cd/m2 (X and Z on the same scale).
struct XyzPicture {
  int width = 0;
  int height = 0;
  std::vector<float> xyz;       // 3 per pixel
  std::vector<float> scotopic;  // [scotopic cd/m2], 1 per pixel; if empty, estimated from XYZ

  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
};

/// Whether a pixel is valid light (0 included): finite and not negative.
inline bool is_light(const XyzPicture& picture, size_t i) {
  const float* xyz = &picture.xyz[3 * i];
  return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]) && xyz[1] >= 0;
}

/// Row-major, top row first, 3 bytes per pixel, sRGB (IEC 61966-2-1).
struct SrgbPicture {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;
};

}  // namespace luxodus
