// How often a thread asked for memory. Linking this replaces malloc and its kin in the whole
// program, so that nothing escapes the count: operator new, the C library, libraries we link.
#pragma once

#include <cstdint>

namespace luxodus::test {

/// False under sanitizers, which have an allocator of their own.
bool allocations_are_counted();

/// Calls of malloc, calloc, realloc and the aligned ones on this thread so far.
uint64_t allocations_of_this_thread();

/// Those of them that libzmq made: it takes memory for each message longer than 33 bytes.
uint64_t allocations_by_zmq();

}  // namespace luxodus::test
