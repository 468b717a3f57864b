// Assertions of the fuzzers. Any thread.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace luxodus::test {

/// Aborts unless `holds`; a fuzzer reports that with its input.
inline void must(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzzed: %s\n", what);
  std::abort();
}

}  // namespace luxodus::test
