// How much tests do. Statistical tests judge by standard errors, so that fewer particles keep their
// promise and see smaller mistakes less well; swarms run fewer seeds. What takes minutes and has a
// smaller test beside it is tagged [.long] and runs only in full.
#pragma once

#include <cstdlib>

namespace luxodus::test {

/// Whether tests do all they can: in ./test.sh --long, which sets LUXODUS_LONG.
inline bool in_full() {
  return std::getenv("LUXODUS_LONG") != nullptr;
}

}  // namespace luxodus::test
