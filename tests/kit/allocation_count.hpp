// Counts a thread's allocations. Linking this replaces malloc and its relatives in the whole
// program, so that nothing escapes the count: operator new, the C library, other libraries. Any
// thread.
#pragma once

#include <cstdint>

namespace luxodus::test {

/// False under sanitizers, which have an allocator of their own.
bool allocations_are_counted();

/// Calls of malloc, calloc, realloc and the aligned ones on this thread so far.
uint64_t allocations_of_this_thread();

/// Allocations by libzmq, which allocates for each message longer than 33 bytes.
uint64_t allocations_by_zmq();

}  // namespace luxodus::test
