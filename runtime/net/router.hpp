// Store and forward over next-hop tables: every frame received and every message made here goes to
// the neighbour that the table names, or to this node's own actors.
//
// Why it cannot deadlock. A frame that has passed h links lies in a buffer of class h, and every
// (link, kind, class) has buffers of its own; a frame leaves only for a buffer of class h + 1. Let
// H be the hop limit. A frame of class H is at its destination or is dropped: its buffer becomes
// free whatever other frames do. If buffers of class h + 1 always become free again, then their
// credit returns, and the frame at the head of any queue of class h can go on. By induction from H
// downwards, buffers of every class become free again, including messages made here (class 0)
// (Merlin and Schweitzer, "Deadlock avoidance in store-and-forward networks", IEEE Trans. Comm. 28,
// 1980). Nothing is assumed of the graph or of the tables, which may change at any time and may
// even loop: hops only grow, and end at H.
//
// A destination must not make a frame wait for the network, or there would be a cycle. So each kind
// has buffers of its own: a request may wait for room to send its reply; a reply waits for nothing
// (its requester has set room aside); a commit waits only for its actor, and control for nothing.
// Credit returns in link frames, which need none.
//
// Thread rule: one node's thread.
#pragma once

#include <span>
#include <vector>

#include "runtime/net/link.hpp"
#include "runtime/net/net_config.hpp"
#include "runtime/net/outbox.hpp"

namespace luxodus {

class Router {
 public:
  /// Takes frames whose destination is this node.
  class Destination {
   public:
    virtual ~Destination() = default;
    /// False: not now, try again.
    virtual bool take(const Envelope& envelope, std::span<const std::byte> body,
                      Nanoseconds now) = 0;
  };

  Router(const NetConfig& config, NetCounters& counters, std::vector<Link>& links,
         Destination& here);

  /// Requires: one entry per node, each a neighbour or no_node.
  void use(NextHops hops);
  bool reaches(NodeId destination) const { return hop_to(destination) != nullptr; }

  Outbox& outbox(Kind kind) { return outboxes_[static_cast<size_t>(kind) - 1]; }

  /// Moves what can be moved, urgent kinds first, in turns among links and classes, up to a bound
  /// that keeps a turn of the node short. Returns true if there may be more to move at once.
  bool pump(uint64_t epoch, Nanoseconds now);

 private:
  bool pump_kind(Kind kind, Nanoseconds now);
  bool step(Link& from, Kind kind, uint8_t hop_class, Nanoseconds now);
  bool step_outbox(Kind kind, Nanoseconds now);
  void spend(size_t bytes);
  Link* hop_to(NodeId destination) const;

  const NetConfig& config_;
  NetCounters& counters_;
  std::vector<Link>& links_;
  Destination& here_;
  std::vector<Link*> next_;  // by destination; null if there is no route
  std::vector<Outbox> outboxes_;
  uint64_t epoch_ = 0;
  size_t first_link_ = 0;  // starts the next round
  size_t budget_ = 0;      // frames that this turn may still move
  size_t bytes_left_ = 0;
};

}  // namespace luxodus
