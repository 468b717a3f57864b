// A brick of smoke data as an immutable scene part: the bytes that are sent, stored on disk and
// named by their hash. Arrays are written as in memory, little endian; derived values are
// recomputed. Bytes come from other machines and are checked against the data set's table before
// use. Pure; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/optics/smoke_grid.hpp"

namespace luxodus {

std::vector<std::byte> encode_brick(const Brick& brick);

/// Requires: `brick` is an index of the table.
/// Errors: other bytes; truncated; quantities or sums that differ from the table; values that are
/// negative or not finite, an albedo above 1.
Result<Brick> decode_brick(std::span<const std::byte> bytes, const BrickTable& table, size_t brick);

}  // namespace luxodus
