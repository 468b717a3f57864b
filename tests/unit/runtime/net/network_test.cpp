#include "runtime/net/network.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

constexpr NodeId a{0}, b{1}, c{2};

/// Two nodes and the link between them; `change` modifies the second's configuration.
Cluster pair_with(const std::function<void(NetConfig&)>& change) {
  return Cluster(2, ring(2), [&](NetConfig& config) {
    if (config.self == b) change(config);
  });
}

}  // namespace

TEST_CASE("two nodes with the same identity connect and exchange messages", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  REQUIRE(pair[0].network.phase(b) == LinkPhase::up);
  REQUIRE(pair[1].network.phase(a) == LinkPhase::up);

  const MessageId id = pair[0].network.next_id();
  REQUIRE(pair[0].network.send(b, id, FetchObject{{42}, 1000, 1}) == SendOutcome::taken);
  pair.turn();
  REQUIRE(pair[1].handler.taken.size() == 1);
  const Taken& got = pair[1].handler.taken[0];
  CHECK(got.source == a);
  CHECK(got.id == id);
  CHECK(got.hops == 1);
  CHECK(std::get<FetchObject>(got.message).object == ObjectId{42});
}

TEST_CASE("a node that has sent is due at once, and not only at its next beat",
          "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair.turn();
  const Nanoseconds resting = pair[0].network.next_deadline();
  REQUIRE(resting > 0);
  REQUIRE(pair[0].network.send(b, pair[0].network.next_id(), FetchObject{{42}, 1000, 1}) ==
          SendOutcome::taken);
  CHECK(pair[0].network.next_deadline() == 0);
  pair.turn();
  CHECK(pair[0].network.next_deadline() > 0);
}

TEST_CASE("a reply of many chunks arrives whole, and its bytes are released",
          "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  const auto object = pattern(1'000'003);
  auto shared = share(object);
  const std::weak_ptr<const void> alive = shared.owner;
  const MessageId id = pair[1].network.next_id();  // node b asked
  REQUIRE(pair[0].network.send(b, id, ObjectFound{{7}, a}, std::move(shared)) ==
          SendOutcome::taken);
  pair.run(milliseconds(100));
  REQUIRE(pair[1].handler.taken.size() == 1);
  CHECK(pair[1].handler.taken[0].payload == object);
  CHECK(alive.expired());
}

TEST_CASE("unexpected pieces are dropped and counted", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair[1].handler.wants_pieces = false;
  pair[0].network.send(b, pair[1].network.next_id(), ObjectFound{}, share(pattern(200'000)));
  pair.run(milliseconds(100));
  CHECK(pair[1].handler.taken.empty());
  CHECK(pair[1].network.counters().dropped_unexpected == 4);
}

TEST_CASE("a message whose pieces stop arriving is abandoned", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  const MessageId id = pair[1].network.next_id();
  pair[0].network.send(b, id, ObjectFound{}, share(pattern(2 * defaults::bulk_window_bytes)));
  pair[0].network.poll(pair.clock.now());  // one window goes out
  pair[1].network.poll(pair.clock.now());
  pair.stop(0);
  pair.run(seconds(11));
  REQUIRE(pair[1].handler.abandoned_ids.size() == 1);
  CHECK(pair[1].handler.abandoned_ids[0] == id);
  CHECK(pair[1].network.counters().assemblies_abandoned == 1);
}

TEST_CASE("nodes with different identities refuse each other with the reason at both ends",
          "[runtime][network]") {
  struct Row {
    RefusalReason reason;
    std::function<void(NetConfig&)> change;
  };
  const Row table[] = {
      {RefusalReason::protocol, [](NetConfig& n) { ++n.identity.protocol; }},
      {RefusalReason::run, [](NetConfig& n) { ++n.identity.run_id; }},
      {RefusalReason::level, [](NetConfig& n) { n.identity.level = Level::statistical; }},
      {RefusalReason::scene, [](NetConfig& n) { ++n.identity.scene_hash; }},
      {RefusalReason::topology, [](NetConfig& n) { ++n.identity.topology_hash; }},
      {RefusalReason::isa, [](NetConfig& n) { n.identity.isa = "sse2"; }},
      {RefusalReason::build, [](NetConfig& n) { n.identity.build = "other"; }},
      {RefusalReason::fingerprint, [](NetConfig& n) { ++n.identity.fingerprint; }},
  };
  for (const Row& row : table) {
    INFO(name_of(row.reason));
    Cluster pair = pair_with(row.change);
    pair.bring_up();
    const auto at = static_cast<size_t>(row.reason);
    for (const size_t node : {0u, 1u}) {
      CHECK(pair[node].network.phase(node == 0 ? b : a) == LinkPhase::refused);
      const NetCounters& counted = pair[node].network.counters();
      CHECK(counted.refused[at] + counted.refused_by_peer[at] > 0);
    }
    CHECK(pair[0].network.counters().refused[at] + pair[1].network.counters().refused[at] > 0);
    CHECK(pair[0].network.counters().refused_by_peer[at] +
              pair[1].network.counters().refused_by_peer[at] >
          0);
  }
}

namespace {

/// A connected worker and controller; the controller has a results path.
Cluster working_pair() {
  Cluster pair(2, ring(2), [](NetConfig& config) {
    if (config.self == b) config.identity.results = "/results/first";
  });
  pair.bring_up();
  return pair;
}

}  // namespace

TEST_CASE("a node that works for a run refuses the controller of another, and its link stays up",
          "[runtime][network]") {
  Cluster pair = working_pair();
  REQUIRE(pair[0].network.phase(b) == LinkPhase::up);
  NetConfig second = pair[1].config;
  second.incarnation = {2001};
  second.identity.results = "/results/second";
  pair.stop(1);
  pair.start(second);
  pair.bring_up();
  CHECK(pair[1].network.phase(a) == LinkPhase::refused);
  CHECK(pair[1].network.taken_elsewhere() == a);
  const std::string words = pair[1].network.refusal_of(a);
  CHECK(words.find("/results/first") != std::string::npos);
  CHECK(words.find("/results/second") != std::string::npos);
  CHECK(pair[0].network.phase(b) != LinkPhase::refused);
  CHECK(pair[0].network.counters().links_up == 1);
  // The first controller, after a pause or a restart, is accepted again.
  NetConfig first = second;
  first.incarnation = {3001};
  first.identity.results = "/results/first";
  pair.stop(1);
  pair.start(first);
  pair.bring_up();
  CHECK(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[1].network.phase(a) == LinkPhase::up);
  CHECK_FALSE(pair[1].network.taken_elsewhere());
}

TEST_CASE("a node whose run has said bye is free for another", "[runtime][network]") {
  Cluster pair = working_pair();
  pair[1].network.say_bye();
  pair.run(milliseconds(50));
  NetConfig second = pair[1].config;
  second.incarnation = {2001};
  second.identity.results = "/results/second";
  pair.stop(1);
  pair.start(second);
  pair.bring_up();
  CHECK(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[1].network.phase(a) == LinkPhase::up);
}

TEST_CASE("at level statistical the instruction sets may differ", "[runtime][network]") {
  Cluster pair(2, ring(2), [](NetConfig& config) {
    config.identity.level = Level::statistical;
    if (config.self == b) config.identity.isa = "sse2";
  });
  pair.bring_up();
  CHECK(pair[0].network.phase(b) == LinkPhase::up);
}

TEST_CASE("a refused node is accepted after its configuration is fixed", "[runtime][network]") {
  Cluster pair = pair_with([](NetConfig& n) { ++n.identity.scene_hash; });
  pair.bring_up();
  REQUIRE(pair[0].network.phase(b) == LinkPhase::refused);
  NetConfig right = pair[1].config;
  --right.identity.scene_hash;
  right.incarnation = {2001};
  pair.stop(1);
  pair.start(right);
  pair.bring_up();
  CHECK(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[1].network.phase(a) == LinkPhase::up);
}

TEST_CASE("a restarted node is accepted, and its earlier incarnation is not mixed in",
          "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  const MessageId old_question = pair[1].network.next_id();
  NetConfig again = pair[1].config;
  again.incarnation = {2001};
  pair.stop(1);
  pair.start(again);
  pair.bring_up();
  REQUIRE(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[0].network.counters().links_up == 2);
  CHECK(pair[0].network.counters().links_down == 1);

  pair[0].network.send(b, old_question, ObjectNotHere{{7}, a});
  pair[0].network.send(b, pair[1].network.next_id(), ObjectNotHere{{8}, a});
  pair.run(milliseconds(50));
  REQUIRE(pair[1].handler.taken.size() == 1);
  CHECK(std::get<ObjectNotHere>(pair[1].handler.taken[0].message).object == ObjectId{8});
  CHECK(pair[1].network.counters().dropped_stale >= 1);
}

TEST_CASE("a silent link becomes suspect, goes down, and comes up when it is healed",
          "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair.net.cut(a, b);
  pair.run(milliseconds(1000));
  CHECK(pair[0].network.phase(b) == LinkPhase::suspect);
  pair.run(seconds(2));
  CHECK_FALSE(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[0].network.send(b, pair[0].network.next_id(), AskStatus{}) ==
        SendOutcome::unreachable);
  // The connection may have swallowed the frames.
  CHECK(pair[0].transport.renewed == std::vector<NodeId>{b});
  CHECK(pair[1].transport.renewed == std::vector<NodeId>{a});
  pair.net.heal();
  pair.run(seconds(12));
  CHECK(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[1].network.phase(a) == LinkPhase::up);
  CHECK(pair[0].network.send(b, pair[0].network.next_id(), AskStatus{}) == SendOutcome::taken);
  pair.turn();
  CHECK(pair[1].handler.count<AskStatus>() == 1);
}

TEST_CASE("after bye a link is down at once", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair[1].network.say_bye();
  pair.net.arrive();
  pair[0].network.poll(pair.clock.now());
  CHECK(pair[0].network.phase(b) == LinkPhase::down);
}

TEST_CASE("a stalled node suspects no neighbour and counts its lag", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  const uint64_t late = pair[0].network.counters().beats_late;
  for (int i = 0; i < 10; ++i) {  // only b is polled, and its beats fill the queue
    pair[1].network.poll(pair.clock.now());
    pair.clock.advance(milliseconds(100));
  }
  pair.clock.advance(seconds(10));
  pair[0].network.poll(pair.clock.now());
  CHECK(pair[0].network.phase(b) == LinkPhase::up);
  CHECK(pair[0].network.counters().beats_late == late + 1);
}

TEST_CASE("control overtakes bulk between its chunks", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair[0].network.send(b, pair[1].network.next_id(), ObjectFound{}, share(pattern(3'000'000)));
  pair[0].network.poll(pair.clock.now());
  pair[0].network.send(b, pair[0].network.next_id(), AskStatus{});
  pair.turn();
  REQUIRE_FALSE(pair[1].handler.taken.empty());
  CHECK(std::holds_alternative<AskStatus>(pair[1].handler.taken[0].message));
  pair.run(milliseconds(200));
  CHECK(pair[1].handler.count<ObjectFound>() == 1);
}

TEST_CASE("small replies do not wait for a large one", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair[0].network.send(b, pair[1].network.next_id(), ObjectFound{}, share(pattern(3'000'000)));
  pair[0].network.send(b, pair[1].network.next_id(), ObjectNotHere{});
  pair.run(milliseconds(200));
  REQUIRE(pair[1].handler.taken.size() == 2);
  CHECK(std::holds_alternative<ObjectNotHere>(pair[1].handler.taken[0].message));
}

TEST_CASE("an actor without room blocks its senders and loses nothing", "[runtime][network]") {
  Cluster pair(2, ring(2), [](NetConfig& config) { config.outbox_messages = 8; });
  pair.bring_up();
  bool busy = true;
  pair[1].handler.on_deliver = [&](const Delivery&) { return !busy; };
  size_t sent = 0;
  while (sent < 100'000) {
    if (pair[0].network.send(b, pair[0].network.next_id(), FetchObject{}) == SendOutcome::full) {
      const size_t before = pair.net.frames;
      pair.turn();
      if (pair.net.frames == before &&
          pair[0].network.send(b, pair[0].network.next_id(), FetchObject{}) == SendOutcome::full)
        break;
    } else {
      ++sent;
    }
  }
  REQUIRE(sent < 100'000);  // the sender was blocked
  busy = false;
  pair.run(seconds(1));
  CHECK(pair[1].handler.taken.size() >= sent);
  CHECK(pair[1].network.counters().dropped_over_credit == 0);
}

TEST_CASE("a full transport delays frames and loses none", "[runtime][network]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  pair.net.faults.capacity = 1;
  for (int i = 0; i < 20; ++i)
    REQUIRE(pair[0].network.send(b, pair[0].network.next_id(), FetchObject{}) ==
            SendOutcome::taken);
  pair.run(seconds(1));
  CHECK(pair[1].handler.taken.size() == 20);
  CHECK(pair[0].network.counters().transport_full > 0);
}

TEST_CASE("frames with flipped bits end no node", "[runtime][network]") {
  Cluster trio(3, ring(3));
  trio.bring_up();
  trio.net.faults = {.loss = 0.02f, .twice = 0.02f, .reorder = 0.02f, .flipped_bit = 0.5f};
  for (int i = 0; i < 3000; ++i) {
    trio[0].network.send(b, trio[0].network.next_id(), Flush{1, 2, {3, 4}});
    trio[1].network.send(c, trio[1].network.next_id(), FetchObject{});
    trio.turn(milliseconds(10));
  }
  CHECK(trio[1].network.counters().dropped_malformed > 100);
  trio.net.faults = {};
  trio.run(seconds(70));  // a flipped bit may look like another scene, which is refused and retried
  for (uint16_t i = 0; i < 3; ++i)
    CHECK(trio[i].network.phase({static_cast<uint16_t>((i + 1) % 3)}) == LinkPhase::up);
  const size_t before = trio[1].handler.taken.size();
  trio[0].network.send(b, trio[0].network.next_id(), AskStatus{});
  trio.run(milliseconds(100));
  CHECK(trio[1].handler.taken.size() > before);
}

TEST_CASE("an inconsistent configuration is rejected at start", "[runtime][network]") {
  const auto starts = [](const std::function<void(NetConfig&)>& change) {
    NetConfig config = config_of(0, 2, ring(2), 1);
    change(config);
    SimNet net;
    NetNode node(net, config, 0);
  };
  CHECK_NOTHROW(starts([](NetConfig&) {}));
  CHECK_THROWS(starts([](NetConfig& n) { n.incarnation = {0}; }));
  CHECK_THROWS(starts([](NetConfig& n) { n.hop_limit = 0; }));
  CHECK_THROWS(starts([](NetConfig& n) { n.self = {2}; }));
  CHECK_THROWS(starts([](NetConfig& n) { n.bulk_window_bytes = 1000; }));
  CHECK_THROWS(starts([](NetConfig& n) { n.edges.push_back({{0}, {1}}); }));
  CHECK_THROWS(starts([](NetConfig& n) { n.edges.push_back({{0}, {9}}); }));
}
