// Conversion of cairo's pixels to ours, and owning pointers to its objects. Internal to draw_svg
// and sign_face. Pure; any thread.
#pragma once

#include <cairo.h>

#include <memory>

#include "scenes/light/signs/draw_svg.hpp"

namespace luxodus {

/// Releases an object of cairo or librsvg with the library's own function.
template <auto release>
struct Release {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>>;
using Pen = std::unique_ptr<cairo_t, Release<cairo_destroy>>;

/// Cairo's native-endian premultiplied ARGB as straight RGBA.
/// Requires: an image surface of format ARGB32.
Pixels pixels_of(cairo_surface_t* surface);

}  // namespace luxodus
