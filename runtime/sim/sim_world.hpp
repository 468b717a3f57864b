// A world of one thread in which many nodes run: virtual time, links that do what a fault plan
// says, nodes that crash and begin anew. The nodes run the production code; they reach this world
// by two of their seams, Clock and Transport. One seed, one run: events come in the order of (time,
// sequence), all chance is drawn from the seed, and the hash of all events tells whether two runs
// were the same.
//
// Simulated links lose what real ones lose: a frame that was taken is on its way, not delivered. It
// is gone when the connection breaks, when either end crashes, when a link is cut. Thread rule: one
// thread.
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
  /// It is about to be destroyed in the middle of its work: fibers have to return. What it sends
  /// from here on is lost.
  virtual void die() = 0;
};

struct SimSetup {
  uint16_t nodes = 0;
  std::vector<Edge> edges;
  FaultPlan plan;
  Nanoseconds turn_cost = microseconds(1);   // of a turn by itself, so that time passes
  Nanoseconds frame_cost = microseconds(2);  // of taking in a frame
  Nanoseconds send_cost = 0;                 // of giving a frame to a link
  double byte_cost_ns = 0;                   // of each byte of a frame, at either end
  Nanoseconds wake_cost = 0;  // until a node that rests sees what has come: the system's part
  Nanoseconds rest_cost = 0;  // of going to rest and waking again, on the node's processor
  Nanoseconds reconnect = milliseconds(100);  // until a broken connection stands again
  /// Machines: nodes of one share its cores, each a turn at a time. By node; empty: to each its
  /// own.
  std::vector<uint16_t> hosts;
  uint32_t cores = 0;  // of each machine; 0: one for every node
};

class SimWorld {
 public:
  /// Makes a node for its n-th life, 0 at first.
  using MakeNode = std::function<std::unique_ptr<SimNode>(NodeId node, uint32_t life)>;

  explicit SimWorld(const SimSetup& setup);
  ~SimWorld();

  SimClock& clock(NodeId node);
  Transport& transport(NodeId node);

  /// Makes all nodes. Requires: once.
  void start(MakeNode make);

  /// The next event. False: there is none, or all nodes have left.
  bool step();
  Nanoseconds now() const { return now_; }
  /// The node, null while it is crashed or after it has left.
  SimNode* node(NodeId node);
  /// The node that left in the last event, as it left; null where none did.
  const SimNode* departed() const { return departed_.get(); }
  /// The node that had the last event; no_node where none had.
  NodeId last() const { return last_; }

  struct Counters {
    uint64_t events = 0;
    uint64_t frames = 0;
    uint64_t bytes = 0;
    uint64_t lost = 0;  // for whatever reason
    uint64_t duplicated = 0;
    uint64_t reordered = 0;
    uint64_t corrupted = 0;
    uint64_t ghosts = 0;
    uint64_t refused_full = 0;
    uint64_t crashes = 0;
    uint64_t faults = 0;  // begun, crashes among them
  };
  const Counters& counters() const { return counters_; }
  /// Of all events so far.
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
  std::vector<std::unique_ptr<Way>> ways_;       // nodes x nodes, null where there is no link
  std::vector<std::vector<Nanoseconds>> cores_;  // by machine, when each is free; where they count
  std::vector<Frame> frames_;                    // on their way, by slot
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
