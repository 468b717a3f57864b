// One try of the codec with untrusted bytes: they are decoded or rejected without side effects, and
// a decoded message encodes to the same meaning. Aborts otherwise. One thread.
#pragma once

#include <cstddef>
#include <span>

namespace luxodus::test {

/// True: the bytes were a frame and a message.
bool fuzz_one(std::span<const std::byte> bytes);

}  // namespace luxodus::test
