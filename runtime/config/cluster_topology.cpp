// Reads the links of a cluster file.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "runtime/config/cluster_reading.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/toml/words.hpp"

namespace luxodus::config {

namespace {

void read_sizes(TableReader& keys, TopologyChoice& choice) {
  using Controller = TopologyChoice::Controller;
  choice.max_links = static_cast<uint32_t>(keys.integer("links"));
  const std::string controller = keys.choice("controller");
  choice.controller = controller == "node"       ? Controller::node
                      : controller == "forwards" ? Controller::forwards
                                                 : Controller::endpoint;
  choice.max_controller_links = static_cast<uint32_t>(keys.integer("controller_links"));
  if (choice.controller != Controller::node) return;
  choice.max_controller_links = 0;
  if (keys.has("controller_links")) {
    keys.problem("controller_links",
                 "a controller that is wired as a node has 'links'; leave this out");
  }
}

}  // namespace

NodeId named(const std::string& name, const SourcePlace& place, ClusterReading& reading) {
  if (const auto id = find_node(reading.cluster, name)) return *id;
  std::vector<std::string_view> known;
  for (const ClusterNode& node : reading.cluster.nodes) known.push_back(node.name);
  const auto near = toml::nearest_word(name, known);
  reading.findings.problem(place,
                           fmt::format("there is no node \"{}\"{}", excerpt(name),
                                       near ? fmt::format("; did you mean \"{}\"?", *near) : ""));
  return no_node;
}

void read_topology(TableReader& top, ClusterReading& reading) {
  const toml::Table* table = top.table("topology");
  const std::string said =
      table ? toml::chosen_kind(*table, cluster_schema(), "topology", "kind") : "amp";
  TopologyChoice& choice = reading.cluster.topology;
  const auto reader = [&](const std::string& kind) {
    return top.inner("topology", {"topology", kind});
  };
  if (said == "file") {
    TableReader keys = reader("topology.file");
    choice.kind = TopologyChoice::Kind::file;
    choice.file = keys.path("file");
  } else if (said == "links") {
    TableReader keys = reader("topology.links");
    choice.kind = TopologyChoice::Kind::links;
    reading.links = keys.name_pairs("pairs");
    read_sizes(keys, choice);
  } else {
    TableReader keys = reader("topology.amp");
    keys.choice("kind");  // reports an invalid kind
    read_sizes(keys, choice);
  }
}

void place_shards(ClusterReading& reading) {
  const ClusterConfig& cluster = reading.cluster;
  std::vector<NodeId>& shards = reading.cluster.tally.shards;
  // The most that a flush can name, without the controller's (proto: limits::tally_shards).
  if (reading.shards.size() > limits::tally_shards)
    return reading.findings.problem(reading.shards.front().place,
                                    fmt::format("there are {} shards; at most {} are allowed",
                                                reading.shards.size(), limits::tally_shards));
  for (const TableReader::Name& name : reading.shards) {
    const NodeId node = named(name.text, name.place, reading);
    if (node == no_node) continue;
    if (node == cluster.controller()) {
      reading.findings.problem(name.place,
                               fmt::format("\"{}\" is the controller, which holds the first "
                                           "share anyway: name workers",
                                           name.text));
    } else if (std::count(shards.begin(), shards.end(), node) > 0) {
      reading.findings.problem(
          name.place, fmt::format("\"{}\" holds a share of the totals already", name.text));
    } else {
      shards.push_back(node);
    }
  }
}

void place_display(ClusterReading& reading) {
  const ClusterConfig& cluster = reading.cluster;
  NodeId& node = reading.cluster.display.node;
  node = cluster.controller();
  if (reading.display.text.empty()) return;
  const NodeId named_one = named(reading.display.text, reading.display.place, reading);
  if (named_one == no_node) return;
  node = named_one;
  if (!cluster.node(node).stores)
    reading.findings.problem(
        reading.display.place,
        fmt::format("\"{}\" has no scene parts of its own (stores = false), and pictures are "
                    "rendered in the whole scene: name another node",
                    reading.display.text));
}

void connect_nodes(ClusterReading& reading) {
  const ClusterConfig& cluster = reading.cluster;
  TopologyChoice& choice = reading.cluster.topology;
  choice.max_controller_links =
      std::min(choice.max_controller_links, static_cast<uint32_t>(cluster.workers()));
  std::set<Edge> seen;
  std::vector<uint32_t> links(cluster.nodes.size());
  for (const TableReader::NamePair& pair : reading.links) {
    const NodeId one = named(pair.first, pair.place, reading);
    const NodeId other = named(pair.second, pair.place, reading);
    if (one == no_node || other == no_node) continue;
    if (one == other) {
      reading.findings.problem(pair.place,
                               fmt::format("this links node \"{}\" to itself", pair.first));
      continue;
    }
    const Edge edge = edge_between(one, other);
    if (!seen.insert(edge).second) {
      reading.findings.problem(
          pair.place, fmt::format("\"{}\" and \"{}\" are linked already", pair.first, pair.second));
      continue;
    }
    choice.edges.push_back(edge);
    for (const NodeId end : {one, other}) {
      const bool special =
          end == cluster.controller() && choice.controller != TopologyChoice::Controller::node;
      const uint32_t most = special ? choice.max_controller_links : choice.max_links;
      if (++links[end.value] == most + 1) {
        reading.findings.problem(
            pair.place,
            fmt::format("\"{}\" has more than the {} links that '{}' allows",
                        cluster.node(end).name, most, special ? "controller_links" : "links"));
      }
    }
  }
}

}  // namespace luxodus::config
