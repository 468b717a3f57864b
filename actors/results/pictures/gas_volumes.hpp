// Finds the part of each voxel that is gas reached by light. A voxel counts all light in its cube,
// so its mean needs the volume that the light fills, and no wall may divide it between two rooms.
// It uses threads of its own; callbacks run on the caller's thread.
#pragma once

#include <functional>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// What a run knows about where light has been.
struct LitPlaces {
  std::function<bool(uint32_t voxel)> voxel;  // whether light has passed a voxel
  /// Light that reaches a side of a triangle, or passes through it.
  std::function<double(const TriangleRecord& triangle, bool front)> side_lm_m2;
};

/// For each voxel; empty without voxels.
struct LitGas {
  /// The share of its volume that lit gas fills, known to 1 %; 0 if a wall divides two lit places
  /// in it, if little gas is left, or if too many triangles meet: its light may not be read then.
  std::vector<float> share;
  /// Bits: whether most of the face to the next voxel along x, y, z is open.
  std::vector<uint8_t> open;
};

/// Gas is followed from lit voxels without surfaces through gaps at least a quarter of an edge
/// wide; narrower ones do not count. Errors: a packed scene that cannot be read.
Result<LitGas> find_lit_gas(const CompiledScene& scene, const LitPlaces& lit, int threads);

}  // namespace luxodus
