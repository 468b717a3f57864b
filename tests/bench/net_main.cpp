// net_bench [--seconds N] [links] [fetches] [nodes] [peers] [--bytes N --fibers N]: prints the
// tables named, or all; of fetches and peers all rows, or one.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <charconv>
#include <string_view>

#include "tests/bench/net_tables.hpp"

namespace {

struct Options {
  size_t seconds = 2;
  size_t bytes = 0, fibers = 0;
  bool links = false, fetches = false, nodes = false, peers = false;
};

/// Whether it is a number from 1 to `most`.
bool read_number(std::string_view text, size_t most, size_t& number) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() && read.ptr == text.data() + text.size() && number >= 1 &&
         number <= most;
}

bool read_options(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const std::string_view next = i + 1 < argc ? argv[i + 1] : "";
    if (word == "links")
      options.links = true;
    else if (word == "fetches")
      options.fetches = true;
    else if (word == "nodes")
      options.nodes = true;
    else if (word == "peers")
      options.peers = true;
    else if ((word == "--seconds" && read_number(next, 600, options.seconds)) ||
             (word == "--bytes" && read_number(next, 16 << 20, options.bytes)) ||
             (word == "--fibers" && read_number(next, 16384, options.fibers)))
      ++i;
    else
      return false;
  }
  return (options.bytes > 0) == (options.fibers > 0);
}

}  // namespace

int main(int argc, char** argv) {
  spdlog::set_level(spdlog::level::err);
  Options options;
  if (!read_options(argc, argv, options)) {
    fmt::print(
        stderr,
        "net_bench [--seconds 1..600] [links] [fetches] [nodes] [peers] [--bytes 1..16777216 "
        "--fibers 1..16384]\n");
    return 2;
  }
  const auto span = luxodus::seconds(static_cast<int64_t>(options.seconds));
  const bool all = !options.links && !options.fetches && !options.nodes && !options.peers;
  // First those that start processes, which other threads would disturb.
  if (options.peers || all) luxodus::bench::print_peers(span, options.bytes, options.fibers);
  if (options.nodes || all) luxodus::bench::print_nodes(span);
  if (options.links || all) luxodus::bench::print_links(span);
  if (options.fetches || all) luxodus::bench::print_fetches(span, options.bytes, options.fibers);
}
