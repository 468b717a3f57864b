// Cells of planes that lie inside bodies: no light comes there and nobody is, so they are no part
// of a plane's mean, minimum or map. Called from one thread; works on several.
#pragma once

#include <vector>

#include "actors/run/parallel_for.hpp"

namespace luxodus {

/// Whether the middle of each cell of a plane lies in a body, index v * cells_u + u. A pure
/// function of the scene, whatever the rows are run by.
std::vector<char> cells_in_bodies(const CompiledScene& scene, const ParallelFor& rows,
                                  size_t plane);

}  // namespace luxodus
