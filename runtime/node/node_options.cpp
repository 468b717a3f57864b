#include "runtime/node/node_options.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "runtime/node/shortest_routes.hpp"

namespace luxodus {

namespace {

/// Fibers of one node: 64 GB of address space with usual stacks.
constexpr size_t max_fibers = 1'000'000;
constexpr size_t max_message_limit = 1 << 30;
constexpr size_t max_known_objects = 10'000'000;

/// Adds mistakes as sentences of one form.
class Checks {
 public:
  explicit Checks(Problems& out) : out_(out) {}
  template <class... Values>
  void require(bool holds, fmt::format_string<Values...> text, const Values&... values) {
    if (!holds)
      out_.add(problem("NodeOptions: " + fmt::vformat(text, fmt::make_format_args(values...))));
  }

 private:
  Problems& out_;
};

void check_nodes(Checks& checks, const NodeOptions& options) {
  const size_t count = options.nodes.size();
  checks.require(count > 0 && count < no_node.value,
                 "nodes has {} endpoints: give one for each node, in the order of their numbers",
                 count);
  checks.require(count == 0 || options.self < count,
                 "self is {}, but the {} nodes have the numbers 0 to {}", options.self, count,
                 count - 1);
  std::set<std::string> taken;
  for (size_t i = 0; i < count; ++i) {
    const auto at = endpoints_of(options.nodes[i]);
    if (!at) {
      checks.require(false, "nodes[{}] is '{}': {}", i, options.nodes[i], at.problem().what);
      continue;
    }
    const bool free = taken.insert(at->control).second && taken.insert(at->bulk).second;
    checks.require(free,
                   "nodes[{}] is '{}', which another node has already: a node takes two ports, the "
                   "one that is given and the next",
                   i, options.nodes[i]);
  }
}

void check_links(Checks& checks, const NodeOptions& options) {
  const size_t count = options.nodes.size();
  bool whole = true;
  std::set<Edge> seen;
  for (const Edge& link : options.links) {
    const bool fits = link.a < link.b && link.b.value < count && seen.insert(link).second;
    whole = whole && fits;
    checks.require(fits,
                   "links has one from {} to {}: a link joins two nodes below {}, the smaller "
                   "number first, and is listed once",
                   link.a.value, link.b.value, count);
  }
  if (!whole || options.links.empty()) return;
  const size_t longest = longest_route(count, options.links);
  checks.require(longest > 0, "links do not join all {} nodes: add the missing ones", count);
  checks.require(longest <= limits::hops, "links make ways of {} hops, and a frame passes {}",
                 longest, limits::hops);
}

void check_keys(Checks& checks, const NodeOptions& options) {
  if (!options.keys) {
    checks.require(options.public_keys.empty(), "public_keys are given without keys");
    return;
  }
  checks.require(options.public_keys.size() == options.nodes.size(),
                 "public_keys has {} keys for {} nodes: with keys each node's public key is needed",
                 options.public_keys.size(), options.nodes.size());
  for (size_t i = 0; i < options.public_keys.size(); ++i)
    checks.require(options.public_keys[i].size() == 40,
                   "public_keys[{}] has {} characters: a key has 40, of Z85", i,
                   options.public_keys[i].size());
}

void check_sizes(Checks& checks, const NodeOptions& options) {
  checks.require(options.fibers <= max_fibers, "fibers is {}: {} are the most", options.fibers,
                 max_fibers);
  constexpr size_t least_message = 4096;
  checks.require(
      options.max_message_bytes >= least_message && options.max_message_bytes <= max_message_limit,
      "max_message_bytes is {}: give {} to {}", options.max_message_bytes, least_message,
      max_message_limit);
  checks.require(options.waiting_bytes >= options.max_message_bytes,
                 "waiting_bytes is {}, and one message may have {}: raise the first or lower the "
                 "second",
                 options.waiting_bytes, options.max_message_bytes);
  checks.require(options.max_object_bytes > 0 && options.max_object_bytes <= max_message_limit,
                 "max_object_bytes is {}: give 1 to {}", options.max_object_bytes,
                 max_message_limit);
  checks.require(
      options.cache_bytes / 2 >= options.max_object_bytes,
      "cache_bytes is {}, and the largest object may have {}: a cache needs room for two "
      "of them, one ready and one that comes in, so raise cache_bytes or lower "
      "max_object_bytes",
      options.cache_bytes, options.max_object_bytes);
  checks.require(options.objects > 0 && options.objects <= max_known_objects,
                 "objects is {}: give 1 to {}", options.objects, max_known_objects);
  checks.require(options.times.beat > 0 && options.times.down_after_beats > 0,
                 "times has beats of {} ns of which {} may be missed: both must be above 0",
                 options.times.beat, options.times.down_after_beats);
}

}  // namespace

Result<Endpoints> endpoints_of(const std::string& where) {
  if (where.starts_with("ipc://") && where.size() > 6) return Endpoints{where, where + "-bulk"};
  const size_t colon = where.rfind(':');
  uint16_t port = 0;
  const char* end = where.data() + where.size();
  if (where.starts_with("tcp://") && colon > 6) {
    const auto read = std::from_chars(where.data() + colon + 1, end, port);
    if (read.ec == std::errc() && read.ptr == end && port > 0 && port < 65535)
      return Endpoints{where, fmt::format("{}:{}", where.substr(0, colon), port + 1)};
  }
  return problem("an endpoint is tcp://HOST:PORT, with a port of 1 to 65534, or ipc://PATH");
}

std::vector<Edge> links_of(const NodeOptions& options) {
  return options.links.empty() ? all_pairs(options.nodes.size()) : options.links;
}

Problems mistakes_in(const NodeOptions& options) {
  Problems found;
  Checks checks(found);
  check_nodes(checks, options);
  check_links(checks, options);
  check_keys(checks, options);
  check_sizes(checks, options);
  return found;
}

}  // namespace luxodus
