// A geometry cell as an immutable scene part: the bytes that travel, lie on disk and are named by
// their hash. Records are written as they stand in memory, little endian. Bytes come from other
// machines: every count and index is held against the scene before anything is built of them.
// Pure; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/intersect/embree_scene.hpp"

namespace luxodus {

std::vector<std::byte> encode_cell(const GeometryCell& cell);

/// What indices of a cell refer to.
struct CellLimits {
  uint32_t surfaces = 0;
  uint32_t patches = 0;
};

/// Errors: not such bytes; cut short; a triangle of no surface or patch of the scene; coordinates
/// that are not finite.
Result<GeometryCell> decode_cell(std::span<const std::byte> bytes, const CellLimits& limits);

}  // namespace luxodus
