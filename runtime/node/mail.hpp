// What actors of an application send each other: bytes, or a Cap'n Proto message of a schema of
// their own. An actor is named by any text; a message carries the text's hash, so no list of names
// is needed. Plain values; a Mail belongs to its node's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "proto/messages.hpp"
#include "runtime/messaging/payload.hpp"

namespace luxodus {

/// The number of a name: XXH3 of its text, never below 16. Two names of one program are compared
/// at start, so that no hash stands for both.
uint64_t name_hash(std::string_view name);

/// An actor of an application, on any node.
struct ActorRef {
  NodeId node;
  uint64_t name = 0;

  friend bool operator==(const ActorRef&, const ActorRef&) = default;
};

/// The actor of this name on this node: `actor_at(1, "store")`.
inline ActorRef actor_at(uint16_t node, std::string_view name) {
  return {NodeId{node}, name_hash(name)};
}

/// A message of the application's own schema: proto/own_message.hpp has one.
template <class Message>
concept TypedBytes = requires(const Message& message) {
  std::span<const std::byte>(message.bytes());
  uint64_t{message.schema()};
};

/// What is sent: a view of bytes, and the id of their Cap'n Proto struct, if they are one.
struct Content {
  std::span<const std::byte> bytes;
  uint64_t schema = 0;

  Content(std::span<const std::byte> content) : bytes(content) {}  // NOLINT: implicit on purpose
  Content(std::string_view text)                                   // NOLINT: implicit on purpose
      : bytes(std::as_bytes(std::span(text.data(), text.size()))) {}
  Content(const std::string& text) : Content(std::string_view(text)) {}  // NOLINT: as above
  Content(const char* text) : Content(std::string_view(text)) {}  // NOLINT: implicit on purpose
  template <TypedBytes Message>
  Content(const Message& message)  // NOLINT: implicit on purpose
      : bytes(message.bytes()), schema(message.schema()) {}
};

inline std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A message as an actor gets it. It may arrive twice: a sender that has no answer sends it again
/// under the same id.
struct Mail {
  ActorRef from;
  MessageId id;
  uint64_t schema = 0;  // of the content; 0: bytes
  Payload payload = {};

  /// The content, at an address that words may have. Valid as long as this.
  std::span<const std::byte> bytes() const { return payload.bytes(); }
  std::string_view text() const { return as_text(bytes()); }
};

}  // namespace luxodus
