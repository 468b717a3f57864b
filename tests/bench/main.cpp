// luxodus_bench [--repeats N] [speed|threads|memory|pieces|switch|residency ...]: prints the tables
// named, or all.
#include <xmmintrin.h>

#include <charconv>
#include <cstdio>
#include <set>
#include <string>

#include "tests/bench/tables.hpp"

int main(int argc, char** argv) {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // denormals to zero, as in a run
  int repeats = 9;
  std::set<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--repeats" && i + 1 < argc) {
      const std::string number = argv[++i];
      const auto read = std::from_chars(number.data(), number.data() + number.size(), repeats);
      if (read.ec == std::errc() && repeats >= 1 && repeats <= 1000) continue;
    }
    if (word == "speed" || word == "threads" || word == "memory" || word == "pieces" ||
        word == "switch" || word == "residency") {
      wanted.insert(word);
      continue;
    }
    std::fprintf(stderr,
                 "luxodus_bench [--repeats 1..1000] "
                 "[speed|threads|memory|pieces|switch|residency ...]\n");
    return 2;
  }
  const auto asked = [&](const char* table) { return wanted.empty() || wanted.count(table) > 0; };
  // Memory first: the highest resident size is of the whole process.
  if (asked("memory")) luxodus::bench::print_memory(708);
  if (asked("speed")) luxodus::bench::print_speed(repeats);
  if (asked("threads")) luxodus::bench::print_threads(repeats);
  if (asked("pieces")) luxodus::bench::print_pieces(repeats);
  if (asked("switch")) luxodus::bench::print_switch(repeats);
  if (asked("residency")) luxodus::bench::print_residency();
}
