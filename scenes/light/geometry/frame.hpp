// Position and orientation of a thing in the scene. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>

namespace luxodus {

/// Position and axes. Columns of `axes` are orthonormal: local x, y, z in scene coordinates.
struct Frame {
  glm::dvec3 origin{0};
  glm::dmat3 axes{1.0};
};

}  // namespace luxodus
