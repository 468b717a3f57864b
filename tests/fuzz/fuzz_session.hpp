// One try of a whole node with a neighbour that nobody vouches for: handshakes, beats, and messages
// of every type in every state of the link, harmed or made by who knows how to. The node's memory
// stays what it was, its other neighbour is served, and the link heals when the neighbour is itself
// again. Aborts otherwise.
//
// The input is a row of frames: which sample message (1 byte); flags (1 byte): bulk lane, an
// envelope of this session, a check that holds, a turn afterwards, a payload, sent to the node's
// next life; how many harms (1 byte, the lower 3 bits); for each harm where (2 bytes) and what to
// add there (1 byte).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace luxodus::test {

namespace session {
inline constexpr uint8_t bulk = 1, addressed = 2, sealed = 4, turn = 8, payload = 16, later = 32;
}

/// How many of the frames the node did not find malformed.
uint64_t fuzz_session(std::span<const std::byte> input);

}  // namespace luxodus::test
