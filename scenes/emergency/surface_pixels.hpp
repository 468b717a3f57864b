// What cairo has drawn, as pixels of ours. Internal to draw_svg and sign_face. Any thread.
#pragma once

#include <cairo.h>

#include "scenes/emergency/draw_svg.hpp"

namespace luxodus {

/// Cairo's native-endian premultiplied ARGB as straight RGBA.
/// Requires: an image surface of format ARGB32.
Pixels pixels_of(cairo_surface_t* surface);

}  // namespace luxodus
