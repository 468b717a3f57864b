// A flush on its way: what a node's batches have added to its totals, as bytes. Numbers are LEB128
// (signed ones zigzag), indices as differences, the whole packed by zstd. Bytes come from other
// machines: they are read into a value first, and taken or refused whole. Pure; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/tally/totals.hpp"

namespace luxodus {

std::vector<std::byte> encode_gain(const TotalsGain& gain);

/// Errors: not such bytes; more groups than `groups` or an index beyond `totals`; indices that do
/// not ascend; more bytes than such totals can have.
Result<TotalsGain> decode_gain(std::span<const std::byte> bytes, int groups, int64_t totals);

}  // namespace luxodus
