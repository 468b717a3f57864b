// From the values that FDS stores to one value per cell of a mesh: which cells hold gas at a time,
// means over nodes, and what Smoke3D loses at walls. Any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_frames.hpp"

namespace luxodus::fds {

/// By obstruction of a mesh: 1 where it is there at this time.
std::vector<uint8_t> obstructions_at(const Case& fire, size_t mesh, double time_s);

/// The cell of a place [m], x fastest; -1 outside of the mesh.
int64_t cell_at(const Mesh& mesh, const glm::dvec3& place);

/// 1 where a cell holds gas, x fastest; 0 in an obstruction that is there at this time.
std::vector<uint8_t> gas_cells(const Case& fire, size_t mesh, double time_s);

/// 1 where a cell may hold gas at some time: in no obstruction that stands always.
std::vector<uint8_t> gas_cells_ever(const Case& fire, size_t mesh);

/// Gas cells of all meshes at one time.
using GasMasks = std::vector<std::vector<uint8_t>>;

/// By node of a mesh: how many of the eight cells around it hold gas. Cells behind a face of the
/// mesh count if they are gas of another mesh, or if the face is open.
std::vector<uint8_t> gas_around_nodes(const Case& fire, const GasMasks& gas, size_t mesh);

/// Cells whose means about nodes are these values: a node has the mean of the gas cells around it.
/// Solved by the iteration of van Cittert (1931), which starts from the means of nodes over cells;
/// 0 in solids. Integrals over a mesh are kept within 0.05 %, and negative values are not made.
std::vector<float> cells_of_nodes(const Mesh& mesh, const std::vector<float>& nodes,
                                  const std::vector<uint8_t>& gas);

/// Values of a cell-centred slice without its ghosts, the first plane on every axis; 0 in solids.
std::vector<float> cells_of_slice(const Mesh& mesh, const std::vector<float>& values,
                                  const std::vector<uint8_t>& gas);

/// Extinction at nodes [1/m] of bytes of soot: FDS writes 254 (1 - exp(-K d)), where d is the first
/// cell's length along x of that mesh.
std::vector<float> extinction_of_bytes(const Mesh& mesh, const std::vector<uint8_t>& bytes);

/// A node's value in Smoke3D is the mean over its eight cells, of which those in walls hold no
/// soot: times 8 / (gas cells), 0 where there are none.
void correct_at_walls(std::vector<float>& nodes, const std::vector<uint8_t>& gas_around);

}  // namespace luxodus::fds
