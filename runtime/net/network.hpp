// The network of one node: links, routes and messages in several pieces, behind three calls. Each
// turn of the node's loop calls poll(); between turns it may send(). Messages may be lost and come
// in any order; each arrival is delivered at most once. A sender that needs an answer retries under
// the same id. Nothing from outside ends a node: bad input is counted and dropped. It knows no
// fibers, no actors and no threads of its own. Thread rule: one node's thread. The handler is
// called only from poll(), and may call send().
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "proto/codec.hpp"
#include "runtime/core/memory_plan.hpp"
#include "runtime/core/once_a_minute.hpp"
#include "runtime/core/result.hpp"
#include "runtime/net/assembler.hpp"
#include "runtime/net/counters.hpp"
#include "runtime/net/link.hpp"
#include "runtime/net/link_view.hpp"
#include "runtime/net/net_config.hpp"
#include "runtime/net/router.hpp"
#include "runtime/net/transport.hpp"
#include "runtime/observe/metrics.hpp"

namespace luxodus {

/// A message that has arrived. The receiver may move the message out.
struct Delivery {
  NodeId source;
  MessageId id;
  uint8_t hops = 0;
  Message& message;
  // valid during the call; for messages in pieces, in their room
  std::span<const std::byte> payload;
  ActorPair actors = {};
};

/// Identifies a request and its answer in the trace of any node.
constexpr uint64_t trace_id(const MessageId& id) {
  return id.incarnation.value ^ (uint64_t{id.node.value} << 48) ^ id.sequence;
}

/// Receives what the network delivers. Thread rule: called from Network::poll().
class NetHandler {
 public:
  virtual ~NetHandler() = default;

  /// False: no room now; the network tries again, and later messages of the kind wait. A request
  /// may wait for room to send its reply; a reply must never wait for the network.
  virtual bool deliver(const Delivery& delivery) = 0;

  /// Memory for a message in several pieces, valid until it is delivered, abandoned(), or released
  /// by Network::forget(). Empty or too short: the message is not wanted (a reply that nobody
  /// awaits) or must be sent again (no room now).
  virtual std::span<std::byte> room_for(const MessageId& id, NodeId source, ActorPair actors,
                                        size_t bytes) = 0;
  /// No more pieces arrive: the room is the handler's again.
  virtual void abandoned(const MessageId& id, Kind kind) = 0;

  /// A request to another node passes here. Returns true if this node has answered it.
  virtual bool intercept(const Delivery& request) = 0;

  /// Called when the routes are updated: a neighbour whose link is up can be sent to.
  virtual void link_changed(NodeId neighbour, LinkPhase phase) = 0;

  /// Next hops on the graph without these links; equal at every node that sees the same links.
  virtual NextHops reroute(std::span<const Edge> down) = 0;
};

enum class SendOutcome : uint8_t {
  taken,
  full,        // the outbox of this kind is full: try again after a poll
  unreachable  // no route
};

class Network {
 public:
  /// Allocates all its memory. Errors (exception): an inconsistent configuration.
  Network(const NetConfig& config, Transport& transport, NetHandler& handler, Nanoseconds now);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// An id for a message of this node: a request, a flush.
  MessageId next_id();

  /// Queues a message. Its kind follows from its type; an answer carries the id of its request, so
  /// that its pieces find the room set aside for them. `actors`: the sender on this node and the
  /// receiver at the destination. Requires: a destination other than this node (local actors need
  /// no network), a message that is not of kind link. Errors (exception): a message over its
  /// limits.
  SendOutcome send(NodeId destination, const MessageId& id, const Message& message,
                   SharedBytes payload = {}, ActorPair actors = {});

  /// Receives, advances time, and forwards what can be forwarded. Never blocks. Returns true if
  /// there is more to do at once.
  bool poll(Nanoseconds now);

  /// Sends what was queued since the last poll(), as far as there is room.
  void send_out(Nanoseconds now);

  /// When poll() must run even if no frame comes: at once after a send().
  Nanoseconds next_deadline() const;

  /// Returns the room of this message to the handler.
  void forget(const MessageId& id, Kind kind) { assembler_.close(id, kind); }

  /// See Codec::take_back.
  void take_back(std::vector<uint64_t>&& leases) { codec_.take_back(std::move(leases)); }

  /// Tells the neighbours that this node leaves.
  void say_bye();

  // ---- observation

  const NetCounters& counters() const { return counters_; }
  /// Registers all counters; `name_of_node` gives the name of a neighbour.
  void add_metrics(Metrics& metrics, const std::function<std::string(NodeId)>& name_of_node);
  /// Updates the samples of links and outboxes, before metrics are published.
  void sample();
  /// Adds the memory of a network with this configuration.
  static void plan_memory(MemoryPlan& plan, const NetConfig& config);

  LinkPhase phase(NodeId neighbour) const;
  /// Whether a route leads to a node, as far as is known here: at the start all links count as up
  /// until they have been tried for LinkTimes::patience.
  bool reaches(NodeId node) const { return router_.reaches(node); }
  /// Why the link to a neighbour is refused, in the words of the end that refused; "" if it is not.
  std::string refusal_of(NodeId neighbour) const;
  /// A neighbour that has said it works for another run: refusal_of() has its words.
  std::optional<NodeId> taken_elsewhere() const;
  std::vector<NodeId> neighbours() const;
  /// Whether a neighbour has been accepted whose link is not up yet: this node is about to meet it,
  /// perhaps in a new incarnation.
  bool meets_neighbour() const;
  uint64_t epoch() const { return view_.epoch(); }
  /// Bytes of the fixed buffers.
  size_t memory_bytes() const;

 private:
  struct Watched;
  class Here;
  /// Metrics of a link.
  struct LinkSample {
    uint64_t phase = 0;  // as LinkPhase numbers them
    uint64_t bytes_sent = 0;
    uint64_t bytes_received = 0;
    uint64_t credit_bytes = 0;
    uint64_t held_bytes = 0;
  };

  void own_lag(Nanoseconds now);
  void probe_if_disturbed(Nanoseconds now);
  bool receive(Nanoseconds now);
  void take_frame(const Arrival& arrival, Nanoseconds now);
  void take_link_message(Link& link, const OpenedFrame& frame, Lane lane, Nanoseconds now);
  void take_routed(Link& link, const OpenedFrame& frame, Lane lane, Nanoseconds now);
  bool consistent(const Envelope& envelope, size_t body_bytes) const;
  bool intercepted(const Envelope& envelope, std::span<const std::byte> body);
  void malformed(NodeId neighbour, const std::string& what, Nanoseconds now);
  bool deliver(const Envelope& envelope, std::span<const std::byte> bytes);
  bool take_here(const Envelope& envelope, std::span<const std::byte> body, Nanoseconds now);
  bool take_piece(const Envelope& envelope, std::span<const std::byte> body, Nanoseconds now);
  void make_room(NodeId newcomer);
  void watch_links(Nanoseconds now);
  void learn(const LinkChanges& told, const Link& by);
  void spread(const LinkChanges& news, const Link* except);
  Link* link_to(NodeId neighbour);

  NetConfig config_;
  Transport& transport_;
  NetHandler& handler_;
  Codec codec_;
  NetCounters counters_;
  std::vector<std::byte> scratch_;  // for the message being made
  std::vector<Link> links_;
  std::vector<Watched> watched_;  // by link: its last known state
  std::vector<LinkSample> link_samples_;
  std::array<uint64_t, routed_kinds.size()> outbox_samples_{};  // messages waiting, by kind
  LinkView view_;
  Assembler assembler_;
  std::unique_ptr<Router::Destination> here_;
  Router router_;
  uint64_t sequence_ = 0;
  Nanoseconds next_beat_;
  uint64_t lost_connections_ = 0;  // as the transport has told so far
  int probes_ = 0;                 // beats that are still to come soon
  OnceAMinute log_lag_;
  bool given_ = false;  // messages were queued since the last poll and have not left yet
};

}  // namespace luxodus
