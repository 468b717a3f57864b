// Finds the floors of a scene for `luxodus check`. One thread.
#pragma once

#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::cli {

/// Heights [m] of floors, ascending: horizontal surfaces that face up, of a square metre or more,
/// wide enough to stand on. Tops of walls and beams are excluded. If a pack's triangles cannot be
/// read, prints the error and returns none.
std::vector<double> floor_heights(const CompiledScene& scene);

}  // namespace luxodus::cli
