// Cells of planes that lie inside bodies: no light comes there and nobody is, so they are no part
// of a plane's mean, minimum or map. Called from one thread; works on several.
#pragma once

#include <vector>

#include "actors/results/run/parallel_for.hpp"

namespace luxodus {

/// A plane that lies in a floor or a table's top is looked at from above it [m].
inline constexpr double above_plane_m = 1e-3;

/// Whether the middle of each cell of a plane lies in a body, index v * cells_u + u. A pure
/// function of the scene, whatever the rows are run by.
std::vector<char> cells_in_bodies(const CompiledScene& scene, const ParallelFor& rows,
                                  size_t plane);

}  // namespace luxodus
