// luxodus_bench [--repeats N] [TABLE ...]: prints the tables named, or all.
#include <xmmintrin.h>

#include <charconv>
#include <cstdio>
#include <set>
#include <string>

#include "tests/bench/tables.hpp"

namespace {

struct Table {
  const char* name;
  void (*print)(int repeats);
};

// Memory first: the highest resident size is of the whole process.
constexpr Table tables[] = {
    {"memory", [](int) { luxodus::bench::print_memory(708); }},
    {"speed", luxodus::bench::print_speed},
    {"threads", luxodus::bench::print_threads},
    {"pieces", luxodus::bench::print_pieces},
    {"switch", luxodus::bench::print_switch},
    {"nodes", luxodus::bench::print_nodes},
    {"delay", luxodus::bench::print_delay},
    {"flushes", luxodus::bench::print_flushes},
    {"residency", [](int) { luxodus::bench::print_residency(); }},
    {"smoke", [](int) { luxodus::bench::print_smoke(); }},
};

bool is_table(const std::string& word) {
  for (const Table& table : tables)
    if (word == table.name) return true;
  return false;
}

}  // namespace

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
    if (is_table(word)) {
      wanted.insert(word);
      continue;
    }
    std::fprintf(stderr, "luxodus_bench [--repeats 1..1000] [TABLE ...]; tables:");
    for (const Table& table : tables) std::fprintf(stderr, " %s", table.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  for (const Table& table : tables)
    if (wanted.empty() || wanted.count(table.name) > 0) table.print(repeats);
}
