// &GEOM: bodies of triangles, as they are given or as simple solids. Any thread.
#pragma once

#include <string>
#include <vector>

#include "scenes/formats/fds_input/group_keys.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus::fds_input {

struct Body {
  std::vector<Mesh> meshes;  // by the surface that its faces name, in the order of its surfaces
};

/// Solids of curved faces are as fine as FDS would make them, or finer. A fault is in `keys`.
/// `most`: triangles.
Body body_of(GroupKeys& keys, size_t surfaces, size_t most);

}  // namespace luxodus::fds_input
