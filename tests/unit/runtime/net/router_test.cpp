// Forwarding: routes, hop limit, failures, answers on the way, and a load test that store and
// forward cannot deadlock.
#include "runtime/net/router.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/runtime/net/net_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// The smallest buffers that the protocol allows: every pool holds one chunk of 256 bytes.
void tiny(NetConfig& config) {
  config.small_chunk_bytes = config.bulk_chunk_bytes = 256;
  config.small_window_bytes = config.bulk_window_bytes = frame_charge(256);
  config.outbox_messages = 2;
}

uint64_t dropped(const NetCounters& c) {
  return c.dropped_malformed + c.dropped_stranger + c.dropped_stale + c.dropped_over_credit +
         c.dropped_hop_limit + c.dropped_unreachable + c.dropped_unexpected;
}

/// Every node sends `questions` requests to the nodes at these distances in turn; each is answered
/// with 1000 bytes. Outboxes are kept full, so every buffer on every path is in use. Returns the
/// number of turns until all answers have arrived.
int ask(Cluster& cluster, const std::vector<size_t>& distances, size_t questions, int max_turns) {
  const size_t n = cluster.size();
  const SharedBytes object = share(pattern(1000));
  std::vector<size_t> asked(n, 0);
  for (size_t i = 0; i < n; ++i) {
    Network& network = cluster[i].network;
    cluster[i].handler.on_deliver = [&network, object](const Delivery& d) {
      if (!std::holds_alternative<FetchObject>(d.message)) return true;
      return network.send(d.source, d.id, ObjectFound{}, object) == SendOutcome::taken;
    };
  }
  for (int turn = 0; turn < max_turns; ++turn) {
    bool done = true;
    for (size_t i = 0; i < n; ++i) {
      while (asked[i] < questions) {
        const size_t distance = distances[asked[i] % distances.size()];
        Network& network = cluster[i].network;
        if (network.send({static_cast<uint16_t>((i + distance) % n)}, network.next_id(),
                         FetchObject{}) != SendOutcome::taken)
          break;
        ++asked[i];
      }
      done &= cluster[i].handler.count<ObjectFound>() == questions;
    }
    if (done) return turn;
    cluster.turn();
  }
  return max_turns;
}

void check_no_drops(Cluster& cluster) {
  for (size_t i = 0; i < cluster.size(); ++i) CHECK(dropped(cluster[i].network.counters()) == 0);
}

}  // namespace

TEST_CASE("a forwarded message arrives with its number of links", "[runtime][router]") {
  Cluster cluster(6, ring(6));
  cluster.bring_up();
  const MessageId id = cluster[0].network.next_id();
  REQUIRE(cluster[0].network.send({3}, id, FetchObject{{5}, 6, 7}) == SendOutcome::taken);
  cluster.run(milliseconds(50));
  REQUIRE(cluster[3].handler.taken.size() == 1);
  CHECK(cluster[3].handler.taken[0].hops == 3);
  CHECK(cluster[3].handler.taken[0].source == NodeId{0});
  CHECK(cluster[3].handler.taken[0].id == id);
}

TEST_CASE("a message beyond the hop limit is dropped and counted", "[runtime][router]") {
  Cluster cluster(8, ring(8), [](NetConfig& config) { config.hop_limit = 2; });
  cluster.bring_up();
  cluster[0].network.send({2}, cluster[0].network.next_id(), AskStatus{});
  cluster[0].network.send({4}, cluster[0].network.next_id(), AskStatus{});
  cluster.run(milliseconds(50));
  CHECK(cluster[2].handler.taken.size() == 1);
  CHECK(cluster[4].handler.taken.empty());
  CHECK(cluster[2].network.counters().dropped_hop_limit == 1);
}

TEST_CASE("a node on the way that has the object answers", "[runtime][router]") {
  Cluster cluster(6, ring(6));
  cluster.bring_up();
  const SharedBytes object = share(pattern(200'000));
  cluster[1].handler.on_intercept = [&](const Delivery& d) {
    const auto& fetch = std::get<FetchObject>(d.message);
    if (fetch.object != ObjectId{5}) return false;
    return cluster[1].network.send(d.source, d.id, ObjectFound{fetch.object, {1}}, object) ==
           SendOutcome::taken;
  };
  cluster[0].network.send({2}, cluster[0].network.next_id(), FetchObject{{5}, 0, 1});
  cluster[0].network.send({2}, cluster[0].network.next_id(), FetchObject{{6}, 0, 1});
  cluster.run(milliseconds(100));
  REQUIRE(cluster[0].handler.taken.size() == 1);
  CHECK(std::get<ObjectFound>(cluster[0].handler.taken[0].message).answered_by == NodeId{1});
  CHECK(cluster[0].handler.taken[0].payload.size() == 200'000);
  CHECK(cluster[1].network.counters().requests_intercepted == 1);
  REQUIRE(cluster[2].handler.taken.size() == 1);
  CHECK(std::get<FetchObject>(cluster[2].handler.taken[0].message).object == ObjectId{6});
}

TEST_CASE("when a link goes down all nodes route around it, and back when it returns",
          "[runtime][router]") {
  Cluster cluster(6, ring(6));
  cluster.bring_up();
  cluster.net.cut({0}, {1});
  cluster.run(seconds(4));
  for (size_t i = 0; i < 6; ++i) CHECK(cluster[i].network.epoch() == 1);
  cluster[0].network.send({1}, cluster[0].network.next_id(), AskStatus{});
  cluster.run(milliseconds(100));
  REQUIRE(cluster[1].handler.taken.size() == 1);
  CHECK(cluster[1].handler.taken[0].hops == 5);

  cluster.net.heal();
  cluster.run(seconds(12));
  for (size_t i = 0; i < 6; ++i) CHECK(cluster[i].network.epoch() == 2);
  cluster[0].network.send({1}, cluster[0].network.next_id(), AskStatus{});
  cluster.run(milliseconds(100));
  CHECK(cluster[1].handler.taken.back().hops == 1);
}

TEST_CASE("partitioned nodes agree on all links when they meet again", "[runtime][router]") {
  Cluster cluster(6, ring(6));
  cluster.bring_up();
  cluster.net.cut({0}, {5});
  cluster.net.cut({2}, {3});
  cluster.run(seconds(4));
  CHECK(cluster[0].network.send({4}, cluster[0].network.next_id(), AskStatus{}) ==
        SendOutcome::unreachable);
  cluster.net.heal();
  cluster.run(seconds(15));
  for (size_t i = 1; i < 6; ++i) CHECK(cluster[i].network.epoch() == cluster[0].network.epoch());
  CHECK(cluster[0].network.send({4}, cluster[0].network.next_id(), AskStatus{}) ==
        SendOutcome::taken);
  cluster.run(milliseconds(50));
  CHECK(cluster[4].handler.taken.size() == 1);
}

TEST_CASE("a restarted node learns of link changes that it missed", "[runtime][router]") {
  Cluster cluster(6, ring(6));
  cluster.bring_up();
  NetConfig again = cluster[3].config;
  again.incarnation = {2003};
  cluster.stop(3);
  cluster.run(seconds(4));
  cluster.start(again);
  cluster.run(seconds(15));
  for (size_t i = 0; i < 6; ++i) CHECK(cluster[i].network.epoch() == cluster[0].network.epoch());
  cluster[2].network.send({4}, cluster[2].network.next_id(), AskStatus{});
  cluster.run(milliseconds(50));
  REQUIRE(cluster[4].handler.taken.size() == 1);
  CHECK(cluster[4].handler.taken[0].hops == 2);
}

TEST_CASE("a handler told that a link is up can send over it, even if routes had given it up",
          "[runtime][router]") {
  Cluster pair(2, ring(2));
  pair.bring_up();
  NetConfig again = pair[1].config;
  again.incarnation = {2001};
  pair.stop(1);
  pair.run(seconds(4));
  REQUIRE_FALSE(pair[0].network.reaches({1}));
  int ups = 0;
  SendOutcome sent = SendOutcome::full;
  pair[0].handler.on_link = [&](NodeId neighbour, LinkPhase phase) {
    if (phase != LinkPhase::up) return;
    ++ups;
    sent = pair[0].network.send(neighbour, pair[0].network.next_id(), AskStatus{});
  };
  pair.start(again);
  pair.run(seconds(15));
  CHECK(ups == 1);
  CHECK(sent == SendOutcome::taken);
  CHECK(pair[1].handler.count<AskStatus>() == 1);
}

// Without hop classes this stops forever: every node fills the next one's buffer with frames to be
// forwarded, and no buffer ever becomes free.
TEST_CASE("a full cycle of frames that must all be forwarded does not deadlock",
          "[runtime][router]") {
  Cluster cluster(7, ring(7), tiny);
  cluster.bring_up();
  CHECK(ask(cluster, {3}, 100, 20'000) < 20'000);
  check_no_drops(cluster);
}

TEST_CASE("full all-to-all load on a ring does not deadlock", "[runtime][router]") {
  Cluster cluster(7, ring(7), tiny);
  cluster.bring_up();
  CHECK(ask(cluster, {1, 2, 3, 4, 5, 6}, 120, 40'000) < 40'000);
  check_no_drops(cluster);
}

TEST_CASE("full all-to-all load on a graph of four links does not deadlock", "[runtime][router]") {
  Cluster cluster(13, chordal_ring(13, 5), tiny);  // C13(1,5): diameter 2, the minimum
  cluster.bring_up();
  CHECK(ask(cluster, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 120, 40'000) < 40'000);
  check_no_drops(cluster);
}

TEST_CASE("under loss, duplication and reordering credit returns and load goes on",
          "[runtime][router]") {
  Cluster cluster(7, ring(7), tiny);
  cluster.bring_up();
  cluster.net.faults = {.loss = 0.05f, .twice = 0.05f, .reorder = 0.05f};
  ask(cluster, {1, 2, 3, 4, 5, 6}, 120, 2'000);  // some answers never arrive
  cluster.net.faults = {};
  cluster.run(seconds(12));
  std::vector<size_t> before(cluster.size());
  for (size_t i = 0; i < cluster.size(); ++i) {
    before[i] = cluster[i].handler.taken.size();
    REQUIRE(cluster[i].network.send({static_cast<uint16_t>((i + 3) % 7)},
                                    cluster[i].network.next_id(),
                                    AskStatus{}) == SendOutcome::taken);
  }
  cluster.run(seconds(1));
  for (size_t i = 0; i < cluster.size(); ++i) {
    const size_t to = (i + 3) % 7;
    CHECK(cluster[to].handler.taken.size() > before[to]);
  }
}
