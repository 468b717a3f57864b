// The interface between a node and the wire: it sends frames to neighbours, receives theirs, and is
// where the node's thread waits. Promises at-most-once delivery, and order within a lane of one
// connection; it does not promise delivery: "taken" means queued. A simulated network replaces only
// this. Thread rule: one node's thread, except wake().
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "runtime/core/clock.hpp"
#include "runtime/core/ids.hpp"

namespace luxodus {

/// Two queues to every neighbour, so that beats and requests overtake objects.
enum class Lane : uint8_t { control = 0, bulk = 1 };
inline constexpr size_t lanes = 2;

enum class Sent : uint8_t {
  taken,       // queued, not delivered
  full,        // try again later
  unreachable  // no connection
};

struct Arrival {
  NodeId neighbour;  // authenticated by the connection
  Lane lane = Lane::control;
  std::span<const std::byte> bytes;  // valid until the next call; may be unaligned
};

class Transport {
 public:
  virtual ~Transport() = default;

  /// Sends one frame, given in two parts. Never blocks.
  virtual Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
                    std::span<const std::byte> body) = 0;

  /// The neighbour is silent: reconnects if the connection was opened here, since the old stream
  /// may have lost its framing. Frames queued in it are lost.
  virtual void renew(NodeId neighbour) = 0;

  /// The neighbour has refused this node: closes a connection that was opened here, until renew().
  /// If another process uses this node's name, reconnecting would take over its connection.
  virtual void part(NodeId) {}

  /// The next frame received, control before bulk; nothing if there is none. Never blocks.
  virtual std::optional<Arrival> receive() = 0;

  /// Connections lost so far. If there is one more, a neighbour may be gone; what is sent to it
  /// next is unreachable then.
  virtual uint64_t lost_connections() const { return 0; }

  /// Waits for a frame, for wake(), or until `until`, whichever is first.
  virtual void wait_until(Nanoseconds until) = 0;

  /// Ends the current wait, or the next one if there is none. Any thread.
  virtual void wake() noexcept = 0;
};

}  // namespace luxodus
