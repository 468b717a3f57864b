// luxodus_bench [--repeats N] [--pack FILE] [TABLE ...]: prints the tables named, or all.
#include <xmmintrin.h>

#include <charconv>
#include <cstdio>
#include <set>
#include <string>

#include "tests/bench/tables.hpp"

namespace {

struct Options {
  int repeats = 9;
  std::string pack;  // of residency
};

struct Table {
  const char* name;
  void (*print)(const Options& options);
};

// Memory first: the highest resident size is of the whole process.
constexpr Table tables[] = {
    {"memory", [](const Options&) { luxodus::bench::print_memory(708); }},
    {"speed", [](const Options& o) { luxodus::bench::print_speed(o.repeats); }},
    {"threads", [](const Options& o) { luxodus::bench::print_threads(o.repeats); }},
    {"pieces", [](const Options& o) { luxodus::bench::print_pieces(o.repeats); }},
    {"switch", [](const Options& o) { luxodus::bench::print_switch(o.repeats); }},
    {"nodes", [](const Options& o) { luxodus::bench::print_nodes(o.repeats); }},
    {"delay", [](const Options& o) { luxodus::bench::print_delay(o.repeats); }},
    {"flushes", [](const Options& o) { luxodus::bench::print_flushes(o.repeats); }},
    {"residency", [](const Options& o) { luxodus::bench::print_residency(o.pack); }},
    {"merit", [](const Options& o) { luxodus::bench::print_merit(o.repeats); }},
    {"images", [](const Options&) { luxodus::bench::print_images(); }},
    {"features", [](const Options& o) { luxodus::bench::print_features(o.repeats); }},
    {"allocation", [](const Options&) { luxodus::bench::print_allocation(); }},
    {"edits", [](const Options&) { luxodus::bench::print_edits(); }},
    {"smoke", [](const Options&) { luxodus::bench::print_smoke(); }},
};

bool is_table(const std::string& word) {
  for (const Table& table : tables)
    if (word == table.name) return true;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // denormals to zero, as in a run
  Options options;
  std::set<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--repeats" && i + 1 < argc) {
      const std::string number = argv[++i];
      const auto read =
          std::from_chars(number.data(), number.data() + number.size(), options.repeats);
      if (read.ec == std::errc() && options.repeats >= 1 && options.repeats <= 1000) continue;
    }
    if (word == "--pack" && i + 1 < argc) {
      options.pack = argv[++i];
      continue;
    }
    if (is_table(word)) {
      wanted.insert(word);
      continue;
    }
    std::fprintf(stderr, "luxodus_bench [--repeats 1..1000] [--pack FILE] [TABLE ...]; tables:");
    for (const Table& table : tables) std::fprintf(stderr, " %s", table.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  for (const Table& table : tables)
    if (wanted.empty() || wanted.count(table.name) > 0) table.print(options);
}
