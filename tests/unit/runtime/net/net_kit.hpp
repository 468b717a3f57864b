// Nodes of a test: a cluster on a graph, with a handler that records deliveries and can refuse,
// answer on the way, or echo. One thread, manual clock.
#pragma once

#include <spdlog/spdlog.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <queue>
#include <string>
#include <vector>

#include "runtime/net/network.hpp"
#include "tests/unit/runtime/net/sim_net.hpp"

namespace luxodus::test {

inline std::vector<Edge> ring(uint16_t nodes) {
  std::vector<Edge> edges;
  for (uint16_t i = 0; i + 1 < nodes; ++i) edges.push_back({{i}, {static_cast<uint16_t>(i + 1)}});
  if (nodes > 2) edges.push_back({{0}, {static_cast<uint16_t>(nodes - 1)}});
  return edges;
}

/// A ring with chords of +-`step`: four links a node.
inline std::vector<Edge> chordal_ring(uint16_t nodes, uint16_t step) {
  auto edges = ring(nodes);
  for (uint16_t i = 0; i < nodes; ++i) {
    const auto j = static_cast<uint16_t>((i + step) % nodes);
    const auto [a, b] = std::minmax(i, j);
    edges.push_back({{a}, {b}});
  }
  return edges;
}

/// Shortest paths by breadth-first search from every destination; ties go to the smaller neighbour.
inline NextHops shortest(NodeId self, size_t nodes, const std::vector<Edge>& edges,
                         std::span<const Edge> down) {
  std::vector<std::vector<uint16_t>> links(nodes);
  for (const Edge& e : edges) {
    if (std::find(down.begin(), down.end(), e) != down.end()) continue;
    links[e.a.value].push_back(e.b.value);
    links[e.b.value].push_back(e.a.value);
  }
  for (auto& l : links) std::sort(l.begin(), l.end());
  NextHops out;
  out.next.assign(nodes, no_node);
  std::vector<bool> seen(nodes, false);
  std::queue<uint16_t> todo;
  seen[self.value] = true;
  for (const uint16_t n : links[self.value]) {
    seen[n] = true;
    out.next[n] = {n};
    todo.push(n);
  }
  while (!todo.empty()) {
    const uint16_t at = todo.front();
    todo.pop();
    for (const uint16_t n : links[at]) {
      if (seen[n]) continue;
      seen[n] = true;
      out.next[n] = out.next[at];
      todo.push(n);
    }
  }
  return out;
}

inline NetConfig config_of(uint16_t self, uint16_t nodes, std::vector<Edge> edges,
                           uint64_t incarnation) {
  NetConfig config;
  config.self = {self};
  config.incarnation = {incarnation};
  config.nodes = nodes;
  config.edges = std::move(edges);
  config.identity = {protocol_version, {self}, Level::bit, 11, 22, 33, 44, "build", "avx2"};
  return config;
}

struct Taken {
  NodeId source;
  MessageId id;
  int hops;
  Message message;
  std::vector<std::byte> payload;
};

class Handler : public NetHandler {
 public:
  explicit Handler(const NetConfig& config) : config_(config) {}

  std::vector<Taken> taken;
  std::vector<std::pair<NodeId, LinkPhase>> changes;
  std::vector<MessageId> abandoned_ids;
  std::function<bool(const Delivery&)> on_deliver;  // before it is recorded
  std::function<bool(const Delivery&)> on_intercept;
  std::function<void(NodeId, LinkPhase)> on_link;
  bool wants_pieces = true;

  bool deliver(const Delivery& d) override {
    if (on_deliver && !on_deliver(d)) return false;
    taken.push_back({d.source, d.id, d.hops, d.message, {d.payload.begin(), d.payload.end()}});
    return true;
  }
  std::span<std::byte> room_for(const MessageId& id, NodeId, ActorPair, size_t bytes) override {
    if (!wants_pieces) return {};
    auto& room = rooms_[id.sequence];
    room.resize((bytes + 7) / 8);
    return std::as_writable_bytes(std::span(room));
  }
  void abandoned(const MessageId& id, Kind) override { abandoned_ids.push_back(id); }
  bool intercept(const Delivery& d) override { return on_intercept && on_intercept(d); }
  void link_changed(NodeId n, LinkPhase phase) override {
    changes.emplace_back(n, phase);
    if (on_link) on_link(n, phase);
  }
  NextHops reroute(std::span<const Edge> down) override {
    return shortest(config_.self, config_.nodes, config_.edges, down);
  }

  template <class M>
  size_t count() const {
    return static_cast<size_t>(std::count_if(taken.begin(), taken.end(), [](const Taken& t) {
      return std::holds_alternative<M>(t.message);
    }));
  }

 private:
  NetConfig config_;
  std::map<uint64_t, std::vector<uint64_t>> rooms_;
};

struct NetNode {
  NetNode(SimNet& net, const NetConfig& c, Nanoseconds now)
      : config(c), transport(net, c.self), handler(c), network(c, transport, handler, now) {}
  NetConfig config;
  SimTransport transport;
  Handler handler;
  Network network;
};

class Cluster {
 public:
  using Change = std::function<void(NetConfig&)>;

  Cluster(uint16_t nodes, const std::vector<Edge>& edges, const Change& change = {},
          uint64_t seed = 1)
      : net(seed) {
    spdlog::set_level(spdlog::level::off);
    for (uint16_t i = 0; i < nodes; ++i) {
      auto config = config_of(i, nodes, edges, 1000u + i);
      if (change) change(config);
      nodes_.push_back(std::make_unique<NetNode>(net, config, clock.now()));
    }
  }

  SimNet net;
  ManualClock clock{seconds(1)};

  NetNode& operator[](size_t i) { return *nodes_[i]; }
  size_t size() const { return nodes_.size(); }

  /// Polls every node a few times, then advances time.
  void turn(Nanoseconds by = milliseconds(1)) {
    for (int round = 0; round < 3; ++round) {
      for (auto& node : nodes_)
        if (node) node->network.poll(clock.now());
      net.arrive();
    }
    clock.advance(by);
  }
  void run(Nanoseconds span, Nanoseconds step = milliseconds(10)) {
    for (Nanoseconds t = 0; t < span; t += step) turn(step);
  }
  void bring_up() { run(seconds(1)); }

  void stop(uint16_t i) {
    net.leave({i});
    nodes_[i].reset();
  }
  void start(const NetConfig& config) {
    net.join(config.self);
    nodes_[config.self.value] = std::make_unique<NetNode>(net, config, clock.now());
  }

 private:
  std::vector<std::unique_ptr<NetNode>> nodes_;
};

inline std::vector<std::byte> pattern(size_t bytes, unsigned seed = 1) {
  std::vector<std::byte> out(bytes);
  uint32_t x = seed * 2654435761u + 1;
  for (auto& b : out) {
    x = x * 1664525u + 1013904223u;
    b = static_cast<std::byte>(x >> 24);
  }
  return out;
}

inline SharedBytes share(std::vector<std::byte> bytes) {
  auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {*owner, owner};
}

}  // namespace luxodus::test
