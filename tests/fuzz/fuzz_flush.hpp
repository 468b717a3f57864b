// One try of the payload of flushes, of their parts and of totals that are told, with bytes that
// nobody vouches for: read and added to totals, or refused with nothing added. Aborts otherwise.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace luxodus::test {

/// A flush for what fuzz_flush() reads: what mutations start from. Not packed.
std::vector<std::byte> sample_flush();

/// `raw`: what zstd would unpack; else the bytes as they come. True: it was a flush.
bool fuzz_flush(std::span<const std::byte> bytes, bool raw);

}  // namespace luxodus::test
