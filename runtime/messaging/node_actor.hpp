// An actor that others reach by its address, on its own node or across the network. It declares the
// types that it receives as `Letter<Message>`, each with a limit and a reaction, and has a handler
// for every one:
//
//   class Server final
//       : public NodeActor<Server,
//                          ControlLane<Accepts<Letter<FetchObject>, 64, WhenFull::reject>>,
//                          DataLane<Accepts<Tidy, 1, WhenFull::coalesce>>> {
//     void on(const Letter<FetchObject>& request);
//     void on(const Tidy&);  // sent by itself: no address leads to it
//
// A kind that comes from other nodes never waits for room: see ActorSystem. Every message may
// arrive twice. Thread rule: the node's thread.
#pragma once

#include "runtime/actor/actor.hpp"
#include "runtime/messaging/actor_system.hpp"

namespace luxodus {

/// A request that could not leave its node, for lack of room or of a route, is tried again after
/// this: about when links come up. Waiting for the sender's next periodic check instead could find
/// the outbox full of the same other requests each time.
constexpr Nanoseconds retry_after = milliseconds(20);

template <class Derived, class Control, class Data>
class NodeActor : public Actor<Derived, Control, Data>, public Recipient {
  using Base = Actor<Derived, Control, Data>;

 public:
  /// Requires: `sender` outlives this.
  NodeActor(Scheduler& scheduler, Sender& sender, Address self, const char* tag)
      : Base(scheduler, tag), sender_(sender), self_(self) {}

  Address address() const { return self_; }

  std::optional<Offered> accept(IncomingMessage incoming) final {
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
  /// Sends a new message; it is lost if there is no room or no route.
  SendOutcome tell(Address to, const Message& message, SharedBytes payload = {}) {
    return sender_.send(self_, to, sender_.next_id(), message, std::move(payload));
  }
  /// Answers a letter under its id.
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
