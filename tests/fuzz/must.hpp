// What holds for every input, or the fuzzer has found something.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace luxodus::test {

/// Ends the program, which a fuzzer reports with its input, unless `holds`.
inline void must(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzzed: %s\n", what);
  std::abort();
}

}  // namespace luxodus::test
