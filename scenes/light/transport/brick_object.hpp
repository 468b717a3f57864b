// A brick of smoke data as an immutable scene part: the bytes that travel, lie on disk and are
// named by their hash. Arrays are written as they stand in memory, little endian; what follows from
// them is computed anew. Bytes come from other machines and are held against the data set's table
// before they are used. Pure; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/smoke_grid.hpp"

namespace luxodus {

std::vector<std::byte> encode_brick(const Brick& brick);

/// Requires: `brick` is one of the table's.
/// Errors: not such bytes; cut short; other quantities, or more or less in them, than the table
/// says; values that are negative or not finite, an albedo above 1.
Result<Brick> decode_brick(std::span<const std::byte> bytes, const BrickTable& table, size_t brick);

}  // namespace luxodus
