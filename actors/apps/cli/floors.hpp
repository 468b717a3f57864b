// Where the floors of a scene are, as `luxodus check` says it.
#pragma once

#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus::cli {

/// Heights [m] at which floors lie, ascending: horizontal surfaces that face up, of a square metre
/// or more, and wide enough to stand on. Tops of walls and beams are not. Errors: told on standard
/// error, of a pack whose triangles cannot be read; then there are none.
std::vector<double> floor_heights(const CompiledScene& scene);

}  // namespace luxodus::cli
