#include "scenes/light/signs/surface_pixels.hpp"

#include <algorithm>
#include <cstddef>

namespace luxodus {

Pixels pixels_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  Pixels out;
  out.width = cairo_image_surface_get_width(surface);
  out.height = cairo_image_surface_get_height(surface);
  out.rgba.reserve(static_cast<size_t>(out.width) * static_cast<size_t>(out.height));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < out.height; ++y) {
    const auto* row = reinterpret_cast<const uint32_t*>(data + static_cast<ptrdiff_t>(y) * stride);
    for (int x = 0; x < out.width; ++x) {
      const uint32_t argb = row[x];
      const uint32_t alpha = argb >> 24;
      const auto straight = [&](uint32_t channel) {
        return alpha == 0
                   ? uint8_t{0}
                   : static_cast<uint8_t>(std::min(255u, (channel * 255 + alpha / 2) / alpha));
      };
      out.rgba.push_back({straight((argb >> 16) & 255), straight((argb >> 8) & 255),
                          straight(argb & 255), static_cast<uint8_t>(alpha)});
    }
  }
  return out;
}

}  // namespace luxodus
