// A simulated world of many nodes on one thread: virtual time, links that follow a fault plan,
// nodes that crash and restart. The nodes run the production code; the world replaces only Clock
// and Transport. Runs are reproducible from the seed: events come in the order of (time, sequence),
// all random numbers derive from the seed, and a hash of all events tells whether two runs were
// equal.
//
// Simulated links lose what real ones lose: a frame taken by the transport is in flight, not
// delivered. It is lost when the connection breaks, when either end crashes, or when the link is
// cut. Thread rule: one thread.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/core/faults.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/net/net_config.hpp"
#include "runtime/net/transport.hpp"
#include "runtime/sim/sim_clock.hpp"

namespace luxodus {

/// A node as the world drives it.
class SimNode {
 public:
  virtual ~SimNode() = default;
  /// One turn, which never waits. Returns when the next is due, if nothing arrives before.
  virtual Nanoseconds turn() = 0;
  /// Whether it has left for good.
  virtual bool finished() const = 0;
  /// Called before it is destroyed in the middle of its work: its fibers must return. Messages sent
  /// from here on are lost.
  virtual void die() = 0;
};

struct SimSetup {
  uint16_t nodes = 0;
  std::vector<Edge> edges;
  FaultPlan plan;
  Nanoseconds turn_cost = microseconds(1);   // of an empty turn, so that time passes
  Nanoseconds frame_cost = microseconds(2);  // of receiving a frame
  Nanoseconds send_cost = 0;                 // of giving a frame to a link
  double byte_cost_ns = 0;                   // of each byte of a frame, at either end
  Nanoseconds wake_cost = 0;  // operating system's delay until an idle node sees an arrival
  Nanoseconds rest_cost = 0;  // CPU time of going idle and waking again
  Nanoseconds reconnect = milliseconds(100);  // until a broken connection is restored
  /// Machine of each node: nodes of one machine share its cores, each for a turn at a time. Empty:
  /// each node has a machine of its own.
  std::vector<uint16_t> hosts;
  uint32_t cores = 0;  // per machine; 0: one for every node
};

class SimWorld {
 public:
  /// Makes a node for its n-th life, counted from 0.
  using MakeNode = std::function<std::unique_ptr<SimNode>(NodeId node, uint32_t life)>;

  explicit SimWorld(const SimSetup& setup);
  ~SimWorld();

  SimClock& clock(NodeId node);
  Transport& transport(NodeId node);

  /// Makes all nodes. Requires: called once.
  void start(MakeNode make);

  /// Processes the next event. Returns false if there is none, or all nodes have left.
  bool step();
  Nanoseconds now() const { return now_; }
  /// The node; null while it is crashed or after it has left.
  SimNode* node(NodeId node);
  /// The node that left in the last event, in its final state; null if none did.
  const SimNode* departed() const { return departed_.get(); }
  /// The node of the last event; no_node if there was none.
  NodeId last() const { return last_; }

  struct Counters {
    uint64_t events = 0;
    uint64_t frames = 0;
    uint64_t bytes = 0;
    uint64_t lost = 0;  // for any reason
    uint64_t duplicated = 0;
    uint64_t reordered = 0;
    uint64_t corrupted = 0;
    uint64_t ghosts = 0;
    uint64_t refused_full = 0;
    uint64_t crashes = 0;
    uint64_t faults = 0;  // begun, including crashes
  };
  const Counters& counters() const { return counters_; }
  /// Hash of all events so far.
  uint64_t trace_hash() const { return trace_.value(); }

 private:
  class Port;
  struct Node;
  struct Way;
  struct Frame;
  struct Event;

  void push(Event event);
  void begin_counted();
  void wake(Node& node, Nanoseconds at);
  void take_turn(Node& node);
  Nanoseconds* free_core(const Node& node);
  void charge_bytes(Node& node, size_t bytes);
  void arrive(uint32_t slot);
  void begin(const Fault& fault);
  void end(const Fault& fault);
  void crash(Node& node);
  void make(Node& node);
  void break_connection(NodeId a, NodeId b);

  Sent send(NodeId from, NodeId to, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body);
  void launch(Way& way, Frame frame, Nanoseconds at);
  Way* way(NodeId from, NodeId to);
  bool healed() const { return now_ >= setup_.plan.healed_at; }

  const SimSetup setup_;
  LinkTroubles troubles_;
  MakeNode make_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::unique_ptr<SimNode> departed_;
  std::vector<std::unique_ptr<Way>> ways_;  // nodes x nodes, null if there is no link
  // by machine, when each is free; empty if cores are unlimited
  std::vector<std::vector<Nanoseconds>> cores_;
  std::vector<Frame> frames_;  // in flight, by slot
  std::vector<uint32_t> free_slots_;
  std::vector<Event> events_;  // a heap, the earliest first
  uint64_t sequence_ = 0;
  Nanoseconds now_ = 0;
  NodeId last_;
  size_t here_ = 0;  // nodes that have not left
  Hasher trace_;
  Counters counters_;
};

}  // namespace luxodus
