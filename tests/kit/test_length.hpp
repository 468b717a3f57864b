// Length of tests. Statistical tests judge by standard errors, so that with fewer particles they
// stay correct and detect smaller mistakes less well; swarms run fewer seeds. Tests that take
// minutes and have a smaller variant are tagged [.long] and run only in full. Any thread.
#pragma once

#include <cstdlib>

namespace luxodus::test {

/// Whether tests run in full: with ./test.sh --long, which sets LUXODUS_LONG.
inline bool in_full() {
  return std::getenv("LUXODUS_LONG") != nullptr;
}

}  // namespace luxodus::test
