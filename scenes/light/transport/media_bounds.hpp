// Where in a scene its media are. Pure.
#pragma once

#include <span>

#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/optics/medium.hpp"

namespace luxodus {

/// A box [scene coordinates] that holds the media, as far as they lie within `scene`; the whole of
/// `scene` where one of them is everywhere, empty where none is in it.
Bounds media_bounds(std::span<const Medium* const> media, const Bounds& scene);

}  // namespace luxodus
