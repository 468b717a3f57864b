#include "actors/cast/node/node_setup.hpp"

#include <fmt/format.h>

#include "actors/cast/node/fingerprint.hpp"
#include "actors/cast/node/graph_routes.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

namespace {
/// Hash of the run's identity: nodes that place objects, shards, coordinators or the display
/// differently must not join one run.
uint64_t hash_of(const RunSetup& run) {
  const NodeId controller{static_cast<uint16_t>(run.graph.controller())};
  const bool shown_elsewhere = run.display && *run.display != controller;
  const bool levels = run.tree != nullptr && run.tree->has_levels();
  if (run.objects == nullptr && run.shards.owners.empty() && !shown_elsewhere && !levels)
    return run.scene.scene_hash;
  Hasher hash;
  hash.add(run.scene.scene_hash);
  if (shown_elsewhere) hash.add(uint64_t{run.display->value});
  for (Vertex v = 0; levels && v < run.graph.workers(); ++v)
    hash.add(uint64_t{run.tree->parent(v)});
  for (const NodeId owner : run.shards.owners) hash.add(uint64_t{owner.value});
  if (run.objects == nullptr) return hash.value();
  for (const ObjectPlace& place : run.objects->places()) {
    hash.add(place.id.value);
    for (const NodeId holder : place.holders) hash.add(uint64_t{holder.value});
  }
  return hash.value();
}

/// A random first lease, so that leases of different coordinators or incarnations differ.
uint64_t first_lease_of(Incarnation life) {
  Hasher hash;
  hash.add(life.value);
  return hash.value() >> 1;
}

/// A flush of ten million bins takes a third of it.
constexpr size_t longest_message = 1u << 30;
}  // namespace

CoordinatorConfig coordinator_config(const RunSetup& run, const NodeSetup& node) {
  CoordinatorConfig config;
  config.self = node.net.self;
  const Vertex self = node.net.self.value;
  for (Vertex v = 0; v < run.graph.workers(); ++v) {
    const NodeId other{static_cast<uint16_t>(v)};
    if (run.tree->parent(v) == self)
      config.workers.push_back(other);
    else if (run.tree->has_levels() && v != self && run.tree->height(v) < run.tree->height(self))
      config.orphans.push_back(other);
    config.below.push_back({run.tree->tracers(v), run.tree->height(v)});
  }
  config.lease_time = node.lease_time;
  config.max_leases = static_cast<uint32_t>(node.photons.leases);
  config.start = node.start;
  config.lost = node.lost;
  config.names = run.names;
  config.state = {node.net.identity.scene_hash};
  config.first_lease = first_lease_of(node.net.incarnation);
  return config;
}

Result<void> join_links(ZmqTransport& transport, const NodeSetup& node) {
  for (const Endpoints& where : node.links.listen) {
    if (auto at = transport.listen(where); !at) return at.problem();
  }
  for (const auto& [neighbour, where] : node.links.connect) {
    const auto key = node.public_keys.find(neighbour);
    auto to = transport.connect(neighbour, where,
                                key == node.public_keys.end() ? std::string() : key->second);
    if (!to) return to.problem();
  }
  return {};
}

std::string NodeTransport::meeting_trouble(const Network& network) const {
  std::string text;
  // What neighbours said comes first: a connection may also break while a neighbour that has
  // refused this node ends.
  for (const NodeId neighbour : network.neighbours()) {
    const std::string refusal = network.refusal_of(neighbour);
    if (!refusal.empty()) text += "; " + refusal;
  }
  if (machine_.context.turned_away() > 0)
    text += fmt::format("; {} connections were turned away, since their keys are not listed here",
                        machine_.context.turned_away());
  if (sockets_.counters().refused_us > 0)
    text += "; a neighbour turned this node away, since it does not list this node's key";
  if (sockets_.counters().handshake_failed > 0)
    text +=
        "; a neighbour broke off: it has another key than the one listed here, or is no node of a "
        "run";
  if (sockets_.counters().not_a_node > 0)
    text +=
        "; what listens at a neighbour's port does not answer as a node: another program has it";
  return text;
}

std::unique_ptr<ObjectBuilder> make_part_builder(const CompiledScene& scene,
                                                 const SceneParts& parts) {
  return std::make_unique<PartBuilder>(scene, parts);
}

void complete(NetConfig& net, const RunSetup& run) {
  std::optional<Routes> own;
  if (run.routes == nullptr) own = balanced_routes(run.graph);
  const Routes& routes = own ? *own : *run.routes;
  net.identity.scene_hash = hash_of(run);
  net.identity.topology_hash = routes.hash();
  net.identity.build = LUX_VERSION;
  net.identity.isa = isa_in_use();
  net.identity.fingerprint = numeric_fingerprint();
  net.nodes = run.graph.vertices();
  net.edges = edges_of(run.graph);
  const uint32_t hops = routes.longest() + 2;  // a detour around one failure
  net.hop_limit =
      std::max(net.hop_limit, static_cast<uint8_t>(std::min<uint32_t>(limits::hops, hops)));
  net.max_message_bytes = std::max(net.max_message_bytes, longest_message);
}

}  // namespace luxodus
