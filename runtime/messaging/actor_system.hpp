// The actors of a node and the routing between actors on all nodes: a sender gives an address,
// whether local or remote. A message to this node goes into its actor's mailbox; one to another
// node goes to the network, and there into a mailbox. No message waits in the network for room in a
// mailbox, where it would hold up others' messages: it is dropped and counted, and a sender that
// needs an answer retries under the same id. Thread rule: one node's thread.
#pragma once

#include <array>
#include <map>
#include <memory_resource>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/actor/mailbox.hpp"
#include "runtime/messaging/payload.hpp"
#include "runtime/net/network.hpp"
#include "runtime/observe/metrics.hpp"

namespace luxodus {

/// A message as an actor receives it.
template <class Body>
struct Letter {
  Address from;
  MessageId id;  // of the request, which its answer carries too
  Body body;
  Payload payload = {};
  uint8_t hops = 0;  // links passed
};

/// A message on its way into a mailbox.
struct IncomingMessage {
  Address from;
  MessageId id;
  Message& message;  // may be moved out
  Payload payload;
  uint8_t hops = 0;
};

/// Memory that an actor has set aside for payloads that it awaits and will keep.
class AwaitedRooms {
 public:
  virtual ~AwaitedRooms() = default;
  /// Room for a message in pieces; empty if it is not awaited. It may be filled more than once.
  virtual std::span<std::byte> room_for(const MessageId& id, size_t bytes) = 0;
  /// The payload of an arrived message, in its final place; empty if it is not awaited.
  virtual SharedBytes keep(const MessageId& id, std::span<const std::byte> payload) = 0;
};

/// An actor that others can send to.
class Recipient {
 public:
  virtual ~Recipient() = default;
  /// Puts the message into the mailbox. Returns nothing if the actor does not accept its type.
  virtual std::optional<Offered> accept(IncomingMessage incoming) = 0;
  /// Number of messages waiting.
  virtual size_t waiting() const = 0;
  /// Where payloads for this actor are received; null: in rooms of the system's pool.
  virtual AwaitedRooms* rooms() { return nullptr; }
  /// Whether this actor will answer a message that passes through its node to the same actor
  /// elsewhere.
  virtual bool answers([[maybe_unused]] const Message& passing) { return false; }
};

/// The interface by which an actor sends.
class Sender {
 public:
  virtual ~Sender() = default;
  /// An id for a message of this node.
  virtual MessageId next_id() = 0;
  /// An answer carries the id of its request. Errors (exception): those of Network::send.
  virtual SendOutcome send(Address from, Address to, const MessageId& id, const Message& message,
                           SharedBytes payload = {}) = 0;
  /// Releases the room of an answer of this kind whose further pieces are no longer wanted.
  virtual void forget([[maybe_unused]] const MessageId& id, [[maybe_unused]] Kind kind) {}
  /// Returns the lease list of a processed message, whose memory the next message reuses.
  virtual void take_back([[maybe_unused]] std::vector<uint64_t>&& leases) {}
};

class ActorSystem final : public Sender {
 public:
  /// Payloads take at most `max_payload_bytes`. Requires: `network` outlives this.
  ActorSystem(NodeId self, Network& network, size_t max_payload_bytes);

  NodeId self() const { return self_; }
  /// `label` is the actor's name in metrics. Requires: the name is unused; `actor` and `label`
  /// outlive this.
  void add(ActorName name, Recipient& actor, const char* label);

  MessageId next_id() override { return network_.next_id(); }
  SendOutcome send(Address from, Address to, const MessageId& id, const Message& message,
                   SharedBytes payload = {}) override;
  void forget(const MessageId& id, Kind kind) override { network_.forget(id, kind); }
  void take_back(std::vector<uint64_t>&& leases) override { network_.take_back(std::move(leases)); }

  // ---- deliveries of the network ------------------------------------------------------------

  void deliver(const Delivery& delivery);
  /// Room for a message in pieces to this actor; empty if there is none.
  std::span<std::byte> room_for(const MessageId& id, ActorName to, size_t bytes);
  void abandoned(const MessageId& id);
  /// Offers a passing message to the actor of its name on this node, which may answer it.
  bool intercept(const Delivery& passing);

  struct Counters {
    uint64_t local = 0;         // messages between actors of this node
    uint64_t no_actor = 0;      // no actor of this name is here
    uint64_t not_accepted = 0;  // the actor does not receive this type
    uint64_t rejected = 0;      // its mailbox was full
    uint64_t no_room = 0;       // for its payload
  };
  const Counters& counters() const { return counters_; }
  /// Requires: all actors have been added.
  void add_metrics(Metrics& metrics) const;
  /// Updates the samples of mailboxes, before metrics are published.
  void sample();

 private:
  static constexpr size_t actors = 256;  // whatever a byte may name
  using Key = std::pair<uint64_t, uint64_t>;
  static Key key_of(const MessageId& id) { return {id.incarnation.value, id.sequence}; }

  struct Place {
    Recipient* actor = nullptr;
    const char* label = "";
    uint64_t taken = 0;     // total
    uint64_t rejected = 0;  // its mailbox was full
    uint64_t waiting = 0;   // at the last sample
  };

  Place* place_of(ActorName to);
  std::optional<Offered> put(Place& place, IncomingMessage incoming);
  std::optional<Payload> payload_of(const Delivery& delivery);

  const NodeId self_;
  Network& network_;
  std::array<Place, actors> places_{};  // by name
  RoomPool pool_;
  std::pmr::unsynchronized_pool_resource memory_;    // for the map below
  std::pmr::map<Key, PayloadRoom> rooms_{&memory_};  // of messages that arrive in pieces
  Counters counters_;
};

}  // namespace luxodus
