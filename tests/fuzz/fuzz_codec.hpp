// One try of the codec with bytes that nobody vouches for: they are understood or refused, nothing
// else happens, and what is understood can be said again and means the same. Aborts otherwise.
#pragma once

#include <cstddef>
#include <span>

namespace luxodus::test {

/// True: the bytes were a frame and a message.
bool fuzz_one(std::span<const std::byte> bytes);

}  // namespace luxodus::test
