// Reads pictures as linear values, for reflectance images and sign faces. Only image_file.cpp
// includes libpng. Pure functions of the file; any thread.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/core/result.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
inline constexpr uint64_t image_file_bytes = 256ull << 20;
inline constexpr uint32_t image_side = 16384;
/// 64 megapixels: a gigabyte as float RGBA.
inline constexpr uint64_t image_pixels = 64ull << 20;
}  // namespace limits

/// Reads grey, RGB, RGBA and palette PNG of 1 to 16 bits per sample, interlaced or not. Colour
/// becomes linear by the sRGB curve (IEC 61966-2-1), or by the file's gAMA where that differs;
/// alpha is linear already and is not multiplied in. Channels: 1 grey, 3 RGB, 4 where there is
/// alpha. Errors: a missing, oversized, damaged or cut file, or one that is not a PNG.
Result<Image> read_png(const std::string& path);

/// Linear value of an sRGB-encoded one, both in [0, 1].
double linear_from_srgb(double encoded);

}  // namespace luxodus
