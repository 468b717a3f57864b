// Nodes that fetch, for tests: an in-memory network, a manual clock, stores with given objects, and
// a builder that answers at once, on demand, or with a problem. One thread.
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/fetch/part_server.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

namespace luxodus::test {

/// Objects of a test, by number: pseudo-random bytes, and their holders.
struct Objects {
  std::vector<ObjectPlace> places;
  std::vector<SharedBytes> bytes;

  uint32_t add(size_t size, std::vector<NodeId> holders) {
    const auto number = static_cast<uint32_t>(places.size());
    bytes.push_back(share(pattern(size, number + 1)));
    places.push_back({object_id_of(bytes.back().bytes), size, std::move(holders)});
    return number;
  }
  ObjectId id(uint32_t object) const { return places[object].id; }
};

struct MapStore final : ObjectStore {
  SharedBytes find(ObjectId object) override {
    const auto found = held.find(object.value);
    return found == held.end() ? SharedBytes{} : found->second;
  }
  std::map<uint64_t, SharedBytes> held;
};

struct TestObject final : BuiltObject {
  /// `alive` counts instances, and outlives the node if objects are shared.
  TestObject(uint32_t n, size_t charged, std::shared_ptr<int> alive, SharedBytes wire = {})
      : number(n), charge(charged), wire_(std::move(wire)), alive_(std::move(alive)) {
    ++*alive_;
  }
  ~TestObject() override { --*alive_; }
  size_t bytes() const override { return charge; }
  SharedBytes wire_bytes() const override { return wire_; }
  uint32_t number;
  size_t charge;

 private:
  SharedBytes wire_;
  std::shared_ptr<int> alive_;
};

/// Builds objects of `charge` bytes each, unless `charges` says otherwise. Answers at once, or on
/// request.
class TestBuilder final : public ObjectBuilder {
 public:
  void build(uint32_t object, SharedBytes bytes, Client& client) override {
    CHECK_FALSE(bytes.bytes.empty());
    if (on_build) on_build(object);
    built.push_back(object);
    pending_ = {object, &client};
    bytes_ = std::move(bytes);
    if (at_once) answer();
  }
  void answer() {
    REQUIRE(pending_.second != nullptr);
    const auto [object, client] = std::exchange(pending_, {});
    if (problem) return client->built(object, luxodus::problem("no such thing"));
    const size_t size = charges.contains(object) ? charges[object] : charge;
    client->built(object,
                  {std::make_shared<TestObject>(object, size, alive, std::exchange(bytes_, {}))});
  }
  bool pending() const { return pending_.second != nullptr; }

  bool at_once = true;
  bool problem = false;
  size_t charge = 100;
  std::map<uint32_t, size_t> charges;
  std::vector<uint32_t> built;  // in order
  std::function<void(uint32_t)> on_build;
  const std::shared_ptr<int> alive = std::make_shared<int>(0);

 private:
  std::pair<uint32_t, Client*> pending_{0, nullptr};
  SharedBytes bytes_;
};

/// Settings of a test node.
struct FetchSetup {
  FetchConfig fetch;
  CacheConfig cache{.budget_bytes = 1'000'000, .largest_build_bytes = 100, .pinned_share = 0.5};
  size_t fibers = 16;
  uint64_t seed = 1;
};

class FetchNode final : public NetHandler, public EventSource {
 public:
  FetchNode(SimNet& net, const NetConfig& net_config, const Objects& objects, FetchSetup setup,
            const ManualClock& clock)
      : config(net_config),
        transport(net, config.self),
        network(config, transport, *this, clock.now()),
        system(config.self, network, 1 << 20),
        scheduler(limits_of(setup), clock, *this),
        server(on(config.self, setup.fetch), setup.cache, objects.places, store, builder, scheduler,
               system, chance(setup.seed, config.self)),
        clock_(clock) {
    system.add(ActorName::part_server, server, "part_server");
  }

  NetConfig config;
  SimTransport transport;
  Network network;
  ActorSystem system;
  Scheduler scheduler;
  Fibers& fibers = scheduler.fibers();
  Timers& timers = scheduler.timers();
  MapStore store;
  TestBuilder builder;
  PartServer server;
  ObjectCache& cache = server.cache();
  const Fetcher& fetcher = server.fetcher();
  std::function<void(const Delivery&)> on_deliver;
  bool mute = false;  // takes requests without answering
  bool intercepts = true;

  FiberId start(const Task& body) {
    const auto id = fibers.start("test", body);
    REQUIRE(id.has_value());
    return *id;
  }
  void run_fibers() {
    while (fibers.any_ready()) fibers.run_next();
  }
  void turn() {
    scheduler.turn();
    run_fibers();
  }
  /// Sends a message as this node's part server would, to the part server of another node.
  void say(NodeId to, const MessageId& id, const Message& message, SharedBytes bytes = {}) {
    (void)system.send(server.address(), {to, ActorName::part_server}, id, message,
                      std::move(bytes));
  }

  bool poll() override { return network.poll(clock_.now()); }
  void send_out() override { network.send_out(clock_.now()); }
  void wait_until(Nanoseconds) override {}
  void wake() noexcept override {}

  bool deliver(const Delivery& d) override {
    if (on_deliver) on_deliver(d);
    if (!mute) system.deliver(d);
    return true;
  }
  std::span<std::byte> room_for(const MessageId& id, NodeId, ActorPair actors,
                                size_t bytes) override {
    return system.room_for(id, actors.to, bytes);
  }
  void abandoned(const MessageId& id, Kind) override { system.abandoned(id); }
  bool intercept(const Delivery& d) override { return intercepts && system.intercept(d); }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge> down) override {
    return shortest(config.self, config.nodes, config.edges, down);
  }

 private:
  static SchedulerLimits limits_of(const FetchSetup& setup) {
    SchedulerLimits limits;
    limits.fibers = {.count = setup.fibers, .max_maps = 1000};
    limits.timers_beside_fibers = 200;
    return limits;
  }
  static FetchConfig on(NodeId self, FetchConfig fetch) {
    fetch.self = self;
    return fetch;
  }
  static Random chance(uint64_t seed, NodeId self) {
    Random out(seed, RandomStream::test);
    out.start(self.value);
    return out;
  }
  const ManualClock& clock_;
};

/// Nodes in a row, each linked to the next; usually node 0 asks.
class FetchCluster {
 public:
  FetchCluster(uint16_t nodes, const Objects& objects, const FetchSetup& setup = {},
               const Cluster::Change& change = {})
      : net(setup.seed) {
    spdlog::set_level(spdlog::level::off);
    std::vector<Edge> row;
    for (uint16_t i = 0; i + 1 < nodes; ++i) row.push_back({{i}, {static_cast<uint16_t>(i + 1)}});
    for (uint16_t i = 0; i < nodes; ++i) {
      NetConfig config = config_of(i, nodes, row, 1000u + i);
      if (change) change(config);
      nodes_.push_back(std::make_unique<FetchNode>(net, config, objects, setup, clock));
    }
    for (const ObjectPlace& place : objects.places)
      for (const NodeId holder : place.holders) give(holder, objects, place.id);
    run(seconds(1));
  }

  SimNet net;
  ManualClock clock{seconds(1)};

  FetchNode& operator[](size_t i) { return *nodes_[i]; }

  void give(NodeId node, const Objects& objects, ObjectId id) {
    for (size_t i = 0; i < objects.places.size(); ++i)
      if (objects.places[i].id == id) nodes_[node.value]->store.held[id.value] = objects.bytes[i];
  }
  void turn(Nanoseconds by = milliseconds(1)) {
    for (int round = 0; round < 3; ++round) {
      for (const auto& node : nodes_)
        if (node) node->turn();
      net.arrive();
    }
    clock.advance(by);
  }
  void run(Nanoseconds span, Nanoseconds step = milliseconds(10)) {
    for (Nanoseconds t = 0; t < span; t += step) turn(step);
  }
  /// Turns until it holds; fails the test after `most`.
  void until(const std::function<bool()>& holds, Nanoseconds most = seconds(100)) {
    const Nanoseconds end = clock.now() + most;
    while (!holds()) {
      REQUIRE(clock.now() < end);
      turn();
    }
  }
  void stop(uint16_t i) {
    net.leave({i});
    nodes_[i].reset();
  }

 private:
  std::vector<std::unique_ptr<FetchNode>> nodes_;
};

/// The outcome of one get().
struct CacheRead {
  FetchNode& node;
  uint32_t object;
  bool done = false;
  Got got{};
  uint32_t number = 0;  // of the object, read while it was resident

  Task body() {
    return [this] {
      got = node.cache.get(object);
      if (got.object != nullptr) number = static_cast<const TestObject*>(got.object)->number;
      done = true;
    };
  }
};

}  // namespace luxodus::test
