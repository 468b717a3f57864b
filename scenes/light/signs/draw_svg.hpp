// Rasterises drawings with librsvg, which appears in draw_svg.cpp only and runs in a process of its
// own: a drawing that makes it crash, or takes too much memory or time, is reported like any other
// problem. A drawing can load no other file. Internal to sign_face. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Elements of a drawing: a hundred times those of a pictogram with its arrow.
inline constexpr int64_t max_drawing_elements = 20'000;
}  // namespace limits

using Rgba = std::array<uint8_t, 4>;

/// Straight (not premultiplied) 8 bit sRGB, top row first.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<Rgba> rgba;
};

struct DrawnSvg {
  double width = 0, height = 0;  // size that the drawing states, in its own units
  Pixels pixels;                 // stretched to the requested size
};

/// Rasterises the bytes of an SVG file to `across` by `down` pixels.
/// Errors (without a file): not SVG, compressed, with filters, more elements than the limit, no
/// size of its own, more memory or time than drawing a sign takes.
Result<DrawnSvg> draw_svg(const std::string& bytes, int across, int down);

}  // namespace luxodus
