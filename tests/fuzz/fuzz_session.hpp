// One try of a whole node with an untrusted neighbour: handshakes, beats, and messages of every
// type in every state of the link, corrupted or forged. The node's memory does not grow, its other
// neighbour is served, and the link recovers when the neighbour behaves again. Aborts otherwise.
// One thread.
//
// The input is a sequence of frames: number of the sample message (1 byte); flags (1 byte): bulk
// lane, an envelope of this session, a valid check, a turn afterwards, a payload, sent to the
// node's next life; number of corruptions (1 byte, the lower 3 bits); for each its position (2
// bytes) and what to add there (1 byte).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace luxodus::test {

namespace session {
inline constexpr uint8_t bulk = 1, addressed = 2, sealed = 4, turn = 8, payload = 16, later = 32;
}

/// Number of frames that the node did not find malformed.
uint64_t fuzz_session(std::span<const std::byte> input);

}  // namespace luxodus::test
