// Which part of a voxel is gas that light passes. A voxel counts all light in its cube, so its mean
// needs the volume that the light fills, and no wall may part two rooms in it. Threads of its own;
// what it asks of the run it asks on the caller's.
#pragma once

#include <functional>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// What a run knows of where light has been.
struct LitPlaces {
  std::function<bool(uint32_t voxel)> voxel;  // whether it has passed a voxel
  /// What a side of a triangle gets, or lets through.
  std::function<double(const TriangleRecord& triangle, bool front)> side_lm_m2;
};

/// Of each voxel; empty without voxels.
struct LitGas {
  /// The share of its volume that lit gas fills, known to 1 %; 0 where a wall parts two lit places
  /// in it, or where little is left or too many triangles meet: no light may be read there.
  std::vector<float> share;
  /// Bits: whether most of the face to the next voxel along x, y, z is open.
  std::vector<uint8_t> open;
};

/// Gas is followed from lit voxels that nothing solid touches through gaps as wide as a quarter of
/// an edge: what is narrower does not count. Errors: a packed scene that cannot be read.
Result<LitGas> find_lit_gas(const CompiledScene& scene, const LitPlaces& lit, int threads);

}  // namespace luxodus
