// Writes pictures: OpenEXR for luminance (floats with a unit), PNG for pixels. Files are written
// atomically; equal content gives equal bytes (no dates are written). Pictures are rows from the
// top. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
inline constexpr int max_image_edge = 32768;                     // pixels; also libpng's default
                                                                 // limit
inline constexpr uint64_t max_image_pixels = uint64_t{1} << 28;  // 1 GiB per float channel
inline constexpr size_t max_exr_channels = 128;
inline constexpr uint64_t max_exr_bytes = uint64_t{8} << 30;
}  // namespace limits

/// A key and a text: who made the picture, from what.
using ImageText = std::pair<std::string, std::string>;

struct ExrChannel {
  std::string name;           // "R", "G", "B", "XYZ.Y", "standard_error.Y", ...; unique
  std::vector<float> values;  // width * height, top row first
};

/// CIE 1931 x, y of the primaries and of white.
struct Chromaticities {
  std::array<float, 2> red{0.64f, 0.33f};
  std::array<float, 2> green{0.30f, 0.60f};
  std::array<float, 2> blue{0.15f, 0.06f};
  std::array<float, 2> white{0.3127f, 0.3290f};  // D65
};

struct ExrImage {
  int width = 0;
  int height = 0;
  std::vector<ExrChannel> channels;
  bool half = false;           // 16-bit floats in the file; the values stay float in memory
  std::string unit = "cd/m2";  // attribute "unit"; empty: none
  std::optional<Chromaticities> chromaticities;  // of R, G, B; also "whitePoint" (v2f, white)
  std::optional<float> white_luminance_cd_m2;    // luminance of R = G = B = 1
  std::vector<ImageText> text;  // attributes of type string; "comments" is the usual key
  std::vector<std::pair<std::string, double>> numbers;  // attributes of type double

  /// The channel of that name, or nullptr.
  const ExrChannel* find(const std::string& name) const;
};

struct PngImage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;  // sRGB encoded, 3 bytes a pixel, top row first
  std::vector<ImageText>
      text;  // keys of 1..79 printable ASCII characters, e.g. "Title", "Description"
};

/// Errors: sizes that do not match, a name used twice, a value beyond the range of half floats
/// (65504; write full floats then); those of write_file_atomically. NaN is allowed: "no value".
Result<void> write_exr(const std::filesystem::path& path, const ExrImage& image);

/// Errors: sizes that do not match, a text key that PNG does not allow.
Result<std::vector<std::byte>> encode_png(const PngImage& image, const SourcePlace& place);
/// Errors: as encode_png and write_file_atomically.
Result<void> write_png(const std::filesystem::path& path, const PngImage& image);

}  // namespace luxodus
