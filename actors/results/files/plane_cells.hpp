// Finds cells of planes inside bodies: no light reaches them, so they are excluded from a plane's
// mean, minimum and map. Called from one thread; works on several.
#pragma once

#include <vector>

#include "actors/results/run/parallel_for.hpp"

namespace luxodus {

/// A plane in a floor or a table top is tested from this far above it [m].
inline constexpr double above_plane_m = 1e-3;

/// Whether the middle of each cell of a plane lies in a body, index v * cells_u + u. A pure
/// function of the scene; `rows` only distributes the work.
std::vector<char> cells_in_bodies(const CompiledScene& scene, const ParallelFor& rows,
                                  size_t plane);

}  // namespace luxodus
