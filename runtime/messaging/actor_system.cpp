#include "runtime/messaging/actor_system.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/core/check.hpp"

namespace luxodus {

ActorSystem::ActorSystem(NodeId self, Network& network, size_t max_payload_bytes)
    : self_(self), network_(network), pool_(max_payload_bytes) {}

void ActorSystem::add(ActorName name, Recipient& actor, const char* label) {
  Place& place = places_.at(static_cast<size_t>(name));
  LUX_CHECK(place.actor == nullptr, "two actors of one name");
  place.actor = &actor;
  place.label = label;
}

SendOutcome ActorSystem::send(Address from, Address to, const MessageId& id, const Message& message,
                              SharedBytes payload) {
  if (to.node != self_)
    return network_.send(to.node, id, message, std::move(payload), {from.actor, to.actor});
  ++counters_.local;
  Place* place = place_of(to.actor);
  if (place == nullptr) return SendOutcome::taken;
  Message copy = message;
  const auto offered = put(*place, {from, id, copy, Payload(std::move(payload))});
  return offered == Offered::rejected ? SendOutcome::full : SendOutcome::taken;
}

/// Null, and counted, if no actor of this name is here.
ActorSystem::Place* ActorSystem::place_of(ActorName to) {
  Place& place = places_[static_cast<size_t>(to)];  // any byte, if it comes from outside
  if (place.actor != nullptr) return &place;
  ++counters_.no_actor;
  return nullptr;
}

std::optional<Offered> ActorSystem::put(Place& place, IncomingMessage incoming) {
  const std::optional<Offered> offered = place.actor->accept(std::move(incoming));
  if (!offered) ++counters_.not_accepted;
  if (offered == Offered::taken) ++place.taken;
  if (offered == Offered::rejected) {
    ++counters_.rejected;
    ++place.rejected;
  }
  return offered;
}

// ---- deliveries of the network ------------------------------------------------------------------

/// A payload that came in pieces is in its room already; others are copied into one.
std::optional<Payload> ActorSystem::payload_of(const Delivery& delivery) {
  if (const auto at = rooms_.find(key_of(delivery.id)); at != rooms_.end()) {
    PayloadRoom room = std::move(at->second);
    rooms_.erase(at);
    return Payload(pool_, std::move(room), delivery.payload);
  }
  if (delivery.payload.empty()) return Payload();
  PayloadRoom room = pool_.take(delivery.payload.size());
  if (room.empty()) return std::nullopt;
  const auto bytes = room.bytes().first(delivery.payload.size());
  std::copy(delivery.payload.begin(), delivery.payload.end(), bytes.begin());
  return Payload(pool_, std::move(room), bytes);
}

void ActorSystem::deliver(const Delivery& delivery) {
  Place* place = place_of(delivery.actors.to);
  if (place == nullptr) return abandoned(delivery.id);
  AwaitedRooms* rooms = place->actor->rooms();
  std::optional<Payload> payload;
  if (rooms == nullptr)
    payload = payload_of(delivery);
  else
    payload.emplace(rooms->keep(delivery.id, delivery.payload));
  if (!payload) {
    ++counters_.no_room;
    return;
  }
  (void)put(*place, {{delivery.source, delivery.actors.from},
                     delivery.id,
                     delivery.message,
                     std::move(*payload),
                     delivery.hops});
}

bool ActorSystem::intercept(const Delivery& passing) {
  Place& place = places_[static_cast<size_t>(passing.actors.to)];
  if (place.actor == nullptr) return false;
  if (passing.source == self_ || !passing.payload.empty()) return false;
  return place.actor->answers(passing.message) && put(place, {{passing.source, passing.actors.from},
                                                              passing.id,
                                                              passing.message,
                                                              Payload(),
                                                              passing.hops}) == Offered::taken;
}

std::span<std::byte> ActorSystem::room_for(const MessageId& id, ActorName to, size_t bytes) {
  Place* place = place_of(to);
  if (place == nullptr) return {};
  if (AwaitedRooms* rooms = place->actor->rooms()) return rooms->room_for(id, bytes);
  abandoned(id);
  PayloadRoom room = pool_.take(bytes);
  if (room.empty()) {
    ++counters_.no_room;
    return {};
  }
  PayloadRoom& kept = rooms_[key_of(id)];
  kept = std::move(room);
  return kept.bytes();
}

void ActorSystem::abandoned(const MessageId& id) {
  const auto at = rooms_.find(key_of(id));
  if (at == rooms_.end()) return;
  pool_.give_back(std::move(at->second));
  rooms_.erase(at);
}

// ---- numbers ------------------------------------------------------------------------------------

void ActorSystem::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"messages_local", "", "Messages between actors of the node.", ""}, c.local);
  metrics.add_counter({"messages_no_actor", "", "Messages to an actor that is not here.", ""},
                      c.no_actor);
  metrics.add_counter(
      {"messages_not_accepted", "", "Messages of a type that their actor does not receive.", ""},
      c.not_accepted);
  metrics.add_counter({"messages_no_room", "", "Messages without room for their payload.", ""},
                      c.no_room);
  for (const Place& place : places_) {
    if (place.actor == nullptr) continue;
    const std::string actor = fmt::format("actor=\"{}\"", place.label);
    metrics.add_counter({"mailbox_taken", "", "Messages that came to an actor.", actor},
                        place.taken);
    metrics.add_counter({"mailbox_rejected", "", "Messages to a full mailbox.", actor},
                        place.rejected);
    metrics.add_gauge({"mailbox_waiting", "", "Messages in a mailbox.", actor}, place.waiting);
  }
}

void ActorSystem::sample() {
  for (Place& place : places_)
    if (place.actor != nullptr) place.waiting = place.actor->waiting();
}

}  // namespace luxodus
