// Objects that fibers of one node fetch from another over TCP of this host: by their size, and by
// the number of fibers, each of which waits for one object. Every fetch passes the cache, credit,
// retries and the check of the object's hash, as in a run.
#include <fmt/core.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "runtime/core/processor_time.hpp"
#include "runtime/fetch/part_server.hpp"
#include "runtime/net/net_pair.hpp"
#include "runtime/net/zmq_transport.hpp"
#include "tests/bench/net_tables.hpp"

namespace luxodus::bench {

using namespace net_pair;

namespace {

const SystemClock system_clock;

/// Objects of equal size, which the holder keeps in memory.
struct Objects final : ObjectStore {
  Objects(size_t count, size_t bytes) {
    for (size_t n = 0; n < count; ++n) {
      auto made = std::make_shared<std::vector<std::byte>>(bytes, std::byte{1});
      std::memcpy(made->data(), &n, std::min(sizeof n, bytes));
      const SharedBytes shared{*made, made};
      places.push_back({object_id_of(shared.bytes), bytes, {holder}});
      held[places.back().id.value] = shared;
    }
  }
  SharedBytes find(ObjectId object) override { return held.at(object.value); }

  std::vector<ObjectPlace> places;
  std::unordered_map<uint64_t, SharedBytes> held;
};

struct NoObjects final : ObjectStore {
  SharedBytes find(ObjectId) override { return {}; }
};

/// Keeps the bytes as they came.
struct Kept final : BuiltObject {
  explicit Kept(SharedBytes bytes_) : wire(std::move(bytes_)) {}
  size_t bytes() const override { return wire.bytes.size(); }
  SharedBytes wire_bytes() const override { return wire; }
  SharedBytes wire;
};
struct Keeping final : ObjectBuilder {
  void build(uint32_t object, SharedBytes bytes, Client& client) override {
    client.built(object, {std::make_shared<Kept>(std::move(bytes))});
  }
};

/// A cache of a few objects: nearly every one that is asked for must be fetched.
CacheConfig small_cache(size_t object_bytes) {
  return {.budget_bytes = 8 * object_bytes, .largest_build_bytes = object_bytes, .pinned_share = 0};
}

class Node final : NetHandler, EventSource {
 public:
  Node(ZmqContext& context, NodeId self, const Objects& objects, ObjectStore& store, size_t fibers)
      : self_(self),
        transport(context, {self}, system_clock),
        network(config_of(self), transport, *this, system_clock.now()),
        system(self, network, size_t{64} << 20),
        scheduler(limits_for(fibers), system_clock, *this),
        server(fetch_of(self), small_cache(objects.places.front().wire_bytes), objects.places,
               store, builder_, scheduler, system, Random(1, RandomStream::test)) {
    system.add(ActorName::part_server, server, "part_server");
  }

  void run_until(const std::function<bool()>& done) {
    while (!done()) {
      const Nanoseconds due = scheduler.turn();
      if (due > system_clock.now()) wait_until(due);
    }
  }

 private:
  bool poll() override { return network.poll(system_clock.now()); }
  void send_out() override { network.send_out(system_clock.now()); }
  void wait_until(Nanoseconds due) override {
    transport.wait_until(std::min(due, network.next_deadline()));
  }
  void wake() noexcept override { transport.wake(); }

  bool deliver(const Delivery& delivery) override {
    system.deliver(delivery);
    return true;
  }
  std::span<std::byte> room_for(const MessageId& id, NodeId, ActorPair actors,
                                size_t bytes) override {
    return system.room_for(id, actors.to, bytes);
  }
  void abandoned(const MessageId& id, Kind) override { system.abandoned(id); }
  bool intercept(const Delivery& passing) override { return system.intercept(passing); }
  void link_changed(NodeId, LinkPhase) override {}
  NextHops reroute(std::span<const Edge>) override { return {{asker, holder}}; }

  static FetchConfig fetch_of(NodeId self) {
    FetchConfig config;
    config.self = self;
    return config;
  }
  static SchedulerLimits limits_for(size_t fibers) {
    SchedulerLimits limits;
    limits.fibers.count = fibers + 1;
    limits.timers_beside_fibers = 8192;
    return limits;
  }

  NodeId self_;
  Keeping builder_;

 public:
  ZmqTransport transport;
  Network network;
  ActorSystem system;
  Scheduler scheduler;
  PartServer server;
};

struct Rate {
  double objects_per_s = 0;
  double processor_us = 0;  // of both nodes and ZeroMQ's threads, for an object
};

/// Keeps `fibers` fetches of this size in flight for this long.
Rate measure(size_t bytes, size_t fibers, Nanoseconds span) {
  // Each fiber fetches another object than those that are in flight or resident.
  Objects objects(2 * fibers + 16, bytes);
  NoObjects none;
  ZmqContext context({});
  Node first(context, asker, objects, none, fibers), second(context, holder, objects, objects, 1);
  const auto bound = first.transport.listen({"tcp://127.0.0.1:*", "tcp://127.0.0.1:*"});
  if (!bound || !second.transport.connect(asker, bound.value())) return {};
  std::atomic<bool> done{false};
  std::thread answering([&] { second.run_until([&] { return done.load(); }); });
  first.run_until([&] { return first.network.phase(holder) == LinkPhase::up; });
  uint64_t fetched = 0, asked = 0;
  bool ends = false;
  for (size_t i = 0; i < fibers; ++i)
    LUX_CHECK(first.scheduler.fibers().start("asks",
                                             [&] {
                                               while (!ends) {
                                                 const auto next = static_cast<uint32_t>(
                                                     asked++ % objects.places.size());
                                                 const Got got = first.server.cache().get(next);
                                                 if (got.how == Got::How::resident) ++fetched;
                                               }
                                             }),
              "the limits count every fiber");
  const auto run = [&](Nanoseconds lasts) {
    const Nanoseconds end = system_clock.now() + lasts;
    first.run_until([&] { return system_clock.now() >= end; });
  };
  run(span / 10);  // warm-up
  const uint64_t before = first.server.fetcher().counters().fetches;
  const Nanoseconds began = system_clock.now();
  const double taken = clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
  run(span);
  const auto count = static_cast<double>(first.server.fetcher().counters().fetches - before);
  const Rate rate{count * 1e9 / static_cast<double>(system_clock.now() - began),
                  (clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - taken) * 1e6 / count};
  ends = true;
  first.run_until([&] { return first.scheduler.fibers().live() == 0; });
  done = true;
  second.transport.wake();
  answering.join();
  return rate;
}

}  // namespace

void print_fetches(Nanoseconds span, size_t bytes, size_t fibers) {
  fmt::print("\nObjects fetched over TCP\n{:<10} {:>8} {:>12} {:>22}\n", "bytes", "fibers",
             "objects/s", "processor [us/object]");
  struct Row {
    size_t bytes;
    size_t fibers;
  };
  std::vector<Row> rows{{64, 1},     {64, 16},      {64, 256},     {64, 4096},
                        {4096, 256}, {100'000, 16}, {100'000, 256}};
  if (bytes > 0 && fibers > 0) rows = {{bytes, fibers}};
  for (const Row row : rows) {
    const Rate rate = measure(row.bytes, row.fibers, span);
    fmt::print("{:<10} {:>8} {:>12.0f} {:>22.2f}\n", row.bytes, row.fibers, rate.objects_per_s,
               rate.processor_us);
  }
}

}  // namespace luxodus::bench
