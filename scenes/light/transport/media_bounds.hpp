// Bounds of a scene's media. Pure; any thread.
#pragma once

#include <span>

#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/optics/medium.hpp"

namespace luxodus {

/// A box [scene coordinates] that holds the media within `scene`: all of `scene` if one of them is
/// unbounded, empty if none is in it.
Bounds media_bounds(std::span<const Medium* const> media, const Bounds& scene);

}  // namespace luxodus
