// Turns the values that FDS stores into one value per cell of a mesh: which cells hold gas at a
// time, means over nodes, and the loss of Smoke3D at walls. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_frames.hpp"

namespace luxodus::fds {

/// For each obstruction of a mesh: 1 if it exists at this time.
std::vector<uint8_t> obstructions_at(const Case& fire, size_t mesh, double time_s);

/// The index of the cell at a place [m], x fastest; -1 outside the mesh.
int64_t cell_at(const Mesh& mesh, const glm::dvec3& place);

/// 1 where a cell holds gas, x fastest; 0 in an obstruction that exists at this time.
std::vector<uint8_t> gas_cells(const Case& fire, size_t mesh, double time_s);

/// 1 where a cell may hold gas at some time: in no obstruction that always exists.
std::vector<uint8_t> gas_cells_ever(const Case& fire, size_t mesh);

/// Gas cells of all meshes at one time.
using GasMasks = std::vector<std::vector<uint8_t>>;

/// For each node of a mesh: how many of the eight cells around it have the smoke of the moment in
/// Smoke3D: those that hold gas, and those behind a face of the mesh if they are gas of another
/// mesh, or if the face is open. FDS 6.11 (SmokeFormat::density) fills those behind closed faces,
/// too, where the cell before them is gas: with the mass fractions of that cell at the temperature
/// of the wall, so that their density is 1 to 1.5 times that of the gas.
std::vector<uint8_t> filled_around_nodes(const Case& fire, const GasMasks& gas, size_t mesh,
                                         SmokeFormat format);

/// Recovers cells from node values, which are means over the gas cells around a node. Solved by the
/// iteration of van Cittert (1931), which starts from the means of nodes over cells; 0 in solids.
/// Integrals over a mesh are kept within 0.05 %, and no value becomes negative.
std::vector<float> cells_of_nodes(const Mesh& mesh, const std::vector<float>& nodes,
                                  const std::vector<uint8_t>& gas);

/// Values of a cell-centred slice without its ghost cells, the first plane on every axis; 0 in
/// solids.
std::vector<float> cells_of_slice(const Mesh& mesh, const std::vector<float>& values,
                                  const std::vector<uint8_t>& gas);

/// Extinction at nodes [1/m] of bytes of SmokeFormat::opacity: FDS writes 254 (1 - exp(-K d)),
/// where d is the first cell's length along x of that mesh.
std::vector<float> extinction_of_opacities(const Mesh& mesh, const std::vector<uint8_t>& bytes);

/// What a share of bytes stands for: `highest` for byte 254.
std::vector<float> values_of_shares(const std::vector<uint8_t>& bytes, double highest);

/// Whether cells in walls held the smoke of the gas beside them when the run began: nodes at walls
/// then have the values of their neighbours in the gas, and a fraction of them otherwise. `bytes`
/// and `nodes`: of the first frame, as stored and as values.
bool walls_hold_smoke(const Mesh& mesh, const std::vector<uint8_t>& bytes,
                      const std::vector<float>& nodes, const std::vector<uint8_t>& filled_around,
                      SmokeFormat format);

/// Corrects Smoke3D: a node's value there is the mean over its eight cells, of which those in walls
/// keep what they had when the run began. `at_start`: the nodes then; empty where walls held
/// nothing. Gives the mean of the filled cells; 0 where there are none.
void correct_at_walls(std::vector<float>& nodes, const std::vector<uint8_t>& filled_around,
                      const std::vector<float>& at_start);

}  // namespace luxodus::fds
