// Reads &GEOM: bodies of triangles, given as such or as simple solids. Any thread, but one at a
// time for a GroupKeys.
#pragma once

#include <string>
#include <vector>

#include "scenes/formats/fds_input/group_keys.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus::fds_input {

struct Body {
  std::vector<Mesh> meshes;  // one mesh for each surface that its faces name, in the order of its
                             // surfaces
};

/// Curved solids are tessellated as finely as by FDS, or finer. A fault is reported through `keys`.
/// `most`: limit on triangles.
Body body_of(GroupKeys& keys, size_t surfaces, size_t most);

}  // namespace luxodus::fds_input
