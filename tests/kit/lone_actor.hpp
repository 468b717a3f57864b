// Surroundings of an actor that is tested alone, while the test plays all others: a sender that
// records messages, and a node among three, of which the two others are connected and silent. One
// thread.
#pragma once

#include <map>
#include <vector>

#include "runtime/actor/scheduler.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "tests/unit/runtime/net/net_kit.hpp"

namespace luxodus::test {

struct NotedSender final : Sender {
  explicit NotedSender(NodeId of) : self(of) {}

  struct Sent {
    MessageId id;
    Message message;
  };

  MessageId next_id() override { return {self, {1}, ++ids}; }
  SendOutcome send(Address, Address to, const MessageId& id, const Message& message,
                   SharedBytes = {}) override {
    sent[to.node].push_back({id, message});
    return SendOutcome::taken;
  }
  /// All messages of this type sent to a node.
  template <class Body>
  std::vector<Body> told(NodeId node) const {
    std::vector<Body> out;
    const auto at = sent.find(node);
    if (at == sent.end()) return out;
    for (const Sent& one : at->second)
      if (const Body* const body = std::get_if<Body>(&one.message)) out.push_back(*body);
    return out;
  }

  NodeId self;
  uint64_t ids = 0;
  std::map<NodeId, std::vector<Sent>> sent;
};

/// Node 0, on a manual clock.
struct LoneNode {
  LoneNode() { cluster.bring_up(); }
  void end_fibers() {
    scheduler.fibers().cancel_all();
    settle();
  }
  /// Turns until only time could bring more work.
  void settle() {
    while (scheduler.turn() <= cluster.clock.now()) {
    }
  }
  void run(Nanoseconds span) {
    for (const Nanoseconds end = cluster.clock.now() + span; cluster.clock.now() < end;) {
      cluster.turn(milliseconds(50));
      settle();
    }
  }
  Network& network() { return cluster[0].network; }

  static SchedulerLimits few_fibers() {
    SchedulerLimits limits;
    limits.fibers.count = 4;
    limits.fibers.max_maps = 1000;
    return limits;
  }
  struct QuietSource final : EventSource {
    bool poll() override { return false; }
    void wait_until(Nanoseconds) override {}
    void wake() noexcept override {}
  };

  Cluster cluster{3, ring(3)};
  QuietSource source;
  Scheduler scheduler{few_fibers(), cluster.clock, source};
};

}  // namespace luxodus::test
