// A geometry cell as an immutable scene part: the bytes that are sent, stored on disk and named by
// their hash. Records are written as in memory, little endian. Bytes come from other machines:
// every count and index is checked against the scene before anything is built from them. Pure; any
// thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/intersect/embree_scene.hpp"

namespace luxodus {

std::vector<std::byte> encode_cell(const GeometryCell& cell);

/// Limits of a cell's indices.
struct CellLimits {
  uint32_t surfaces = 0;
  uint32_t patches = 0;
};

/// Errors: other bytes; truncated; a triangle of no surface or patch of the scene; coordinates that
/// are not finite.
Result<GeometryCell> decode_cell(std::span<const std::byte> bytes, const CellLimits& limits);

}  // namespace luxodus
