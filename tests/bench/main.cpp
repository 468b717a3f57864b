// luxodus_bench [--repeats N] [--share X] [--scene NAME] [--pack FILE] [TABLE ...]: prints the
// tables named, or all.
#include <charconv>
#include <cstdio>
#include <set>
#include <string>

#include "runtime/core/denormals.hpp"
#include "runtime/core/isolated_job.hpp"
#include "tests/bench/tables.hpp"

namespace {

struct Options {
  int repeats = 9;
  double share = 1;   // fraction of the particles and paths of images, bias, views and allocation
  std::string scene;  // for merit and bias: prefix of scene names
  std::string pack;   // for residency
};

struct Table {
  const char* name;
  void (*print)(const Options& options);
};

// Memory first: the peak resident size is that of the whole process.
constexpr Table tables[] = {
    {"memory", [](const Options&) { luxodus::bench::print_memory(708); }},
    {"speed", [](const Options& o) { luxodus::bench::print_speed(o.repeats); }},
    {"threads", [](const Options& o) { luxodus::bench::print_threads(o.repeats); }},
    {"pieces", [](const Options& o) { luxodus::bench::print_pieces(o.repeats); }},
    {"flights", [](const Options&) { luxodus::bench::print_flights(); }},
    {"switch", [](const Options& o) { luxodus::bench::print_switch(o.repeats); }},
    {"routes", [](const Options& o) { luxodus::bench::print_routes(o.repeats); }},
    {"nodes", [](const Options& o) { luxodus::bench::print_nodes(o.repeats); }},
    {"delay", [](const Options& o) { luxodus::bench::print_delay(o.repeats); }},
    {"flushes", [](const Options& o) { luxodus::bench::print_flushes(o.repeats); }},
    {"residency", [](const Options& o) { luxodus::bench::print_residency(o.pack); }},
    {"merit", [](const Options& o) { luxodus::bench::print_merit(o.repeats, o.scene); }},
    {"images", [](const Options& o) { luxodus::bench::print_images(o.share); }},
    {"seeds", [](const Options& o) { luxodus::bench::print_image_seeds(o.share); }},
    {"bias", [](const Options& o) { luxodus::bench::print_bias(o.share, o.scene); }},
    {"choice", [](const Options& o) { luxodus::bench::print_choice(o.share); }},
    {"views", [](const Options& o) { luxodus::bench::print_views(o.share); }},
    {"colours", [](const Options& o) { luxodus::bench::print_colours(o.share); }},
    {"rooms", [](const Options& o) { luxodus::bench::print_rooms(o.share); }},
    {"features", [](const Options& o) { luxodus::bench::print_features(o.repeats); }},
    {"allocation", [](const Options& o) { luxodus::bench::print_allocation(o.share); }},
    {"edits", [](const Options&) { luxodus::bench::print_edits(); }},
    {"layouts", [](const Options& o) { luxodus::bench::print_layouts(o.share); }},
    {"smoke", [](const Options&) { luxodus::bench::print_smoke(); }},
};

bool is_table(const std::string& word) {
  for (const Table& table : tables)
    if (word == table.name) return true;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (const auto served = luxodus::serve_isolated_job(argc, argv)) return *served;
  luxodus::flush_denormals();
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
    if (word == "--share" && i + 1 < argc) {
      const std::string number = argv[++i];
      const auto read =
          std::from_chars(number.data(), number.data() + number.size(), options.share);
      if (read.ec == std::errc() && options.share > 0 && options.share <= 1) continue;
    }
    if (word == "--scene" && i + 1 < argc) {
      options.scene = argv[++i];
      continue;
    }
    if (word == "--pack" && i + 1 < argc) {
      options.pack = argv[++i];
      continue;
    }
    if (is_table(word)) {
      wanted.insert(word);
      continue;
    }
    std::fprintf(stderr,
                 "luxodus_bench [--repeats 1..1000] [--share 0..1] [--scene NAME] [--pack FILE] "
                 "[TABLE ...]; tables:");
    for (const Table& table : tables) std::fprintf(stderr, " %s", table.name);
    std::fprintf(stderr, "; of the network, and peers: net_bench\n");
    return 2;
  }
  for (const Table& table : tables)
    if (wanted.empty() || wanted.count(table.name) > 0) table.print(options);
}
