// One try of the payloads of flushes, of their parts and of sent totals, with untrusted bytes:
// decoded and added to totals, or rejected with nothing added. Aborts otherwise. One thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace luxodus::test {

/// A valid input for fuzz_flush(), from which mutations start. Not packed.
std::vector<std::byte> sample_flush();

/// `raw`: as unpacked by zstd; otherwise packed bytes. True: it was a flush.
bool fuzz_flush(std::span<const std::byte> bytes, bool raw);

}  // namespace luxodus::test
