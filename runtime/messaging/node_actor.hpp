// An actor that others reach by its address, on its own node or across the network. What it
// receives it declares as `Letter<Message>`, with a limit and a reaction for each, and it has a
// handler for every one:
//
//   class TracingWorker final
//       : public NodeActor<TracingWorker, ControlLane<Accepts<Letter<LeaseGranted>, 8,
//       WhenFull::reject>>,
//                          DataLane<Accepts<PackFlush, 1, WhenFull::coalesce>>> {
//     void on(const Letter<LeaseGranted>& granted);
//     void on(PackFlush);  // sent by itself: no address leads to it
//
// A kind that comes from other nodes never waits for room: see ActorSystem. Every one may come
// twice. Thread rule: the node's thread.
#pragma once

#include "runtime/actor/actor.hpp"
#include "runtime/messaging/actor_system.hpp"

namespace luxodus {

/// A question that did not leave its node, for lack of room or of a way, is put again so soon:
/// about as soon as links stand. Who waited for its next look instead might find the same others
/// before it in the outbox, look after look.
constexpr Nanoseconds retry_after = milliseconds(20);

template <class Derived, class Control, class Data>
class NodeActor : public Actor<Derived, Control, Data>, public Recipient {
  using Base = Actor<Derived, Control, Data>;

 public:
  /// Requires: `sender` outlives it.
  NodeActor(Scheduler& scheduler, Sender& sender, Address self, const char* tag)
      : Base(scheduler, tag), sender_(sender), self_(self) {}

  Address address() const { return self_; }

  std::optional<Offered> accept(Incoming incoming) final {
    return std::visit(
        [&](auto& body) -> std::optional<Offered> {
          using Body = std::decay_t<decltype(body)>;
          if constexpr (Base::template accepts<Letter<Body>>)
            return this->offer(Letter<Body>{incoming.from, incoming.id, std::move(body),
                                            std::move(incoming.payload), incoming.hops});
          else
            return std::nullopt;
        },
        incoming.message);
  }
  size_t waiting() const final { return Base::waiting(); }

 protected:
  Sender& sender() { return sender_; }
  /// A message of its own; what finds no room or no way is lost.
  SendOutcome tell(Address to, const Message& message, SharedBytes payload = {}) {
    return sender_.send(self_, to, sender_.next_id(), message, std::move(payload));
  }
  /// An answer to a letter, under its id.
  template <class Body>
  SendOutcome answer(const Letter<Body>& question, const Message& message,
                     SharedBytes payload = {}) {
    return sender_.send(self_, question.from, question.id, message, std::move(payload));
  }

 private:
  Sender& sender_;
  const Address self_;
};

}  // namespace luxodus
