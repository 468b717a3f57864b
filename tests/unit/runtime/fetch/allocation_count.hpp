// How often this program called operator new. A source of its own replaces it, so that the compiler
// does not look into both ends of a pair. Any thread.
#pragma once

#include <cstddef>

namespace luxodus::test {

size_t allocations();

}  // namespace luxodus::test
