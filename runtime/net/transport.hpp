// The only seam between a node and the wire: frames go to neighbours and come from them, and the
// node's thread waits here. Promises at most once, and order within a lane of one connection; it
// does not promise delivery: "taken" means queued. A simulated network replaces this and nothing
// else. Thread rule: one node's thread, but for wake().
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
  taken,       // queued: not delivered
  full,        // try again later
  unreachable  // no connection
};

struct Arrival {
  NodeId neighbour;  // as the connection names it
  Lane lane = Lane::control;
  std::span<const std::byte> bytes;  // until the next call; at any address
};

class Transport {
 public:
  virtual ~Transport() = default;

  /// Sends one frame, given in two parts. Never blocks.
  virtual Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
                    std::span<const std::byte> body) = 0;

  /// The neighbour has fallen silent: a connection to it that was begun here begins anew, since the
  /// old one may take bytes that will never make a frame again. What it held is lost.
  virtual void renew(NodeId neighbour) = 0;

  /// The neighbour has refused this node: a connection to it that was begun here ends, until
  /// renew(). Where another process has this node's name, it would take that one's connection away.
  virtual void part(NodeId) {}

  /// The next frame that has come, control before bulk; nothing if none has. Never blocks.
  virtual std::optional<Arrival> receive() = 0;

  /// Waits for a frame, for wake(), or for the moment `until`, whichever is first.
  virtual void wait_until(Nanoseconds until) = 0;

  /// Ends a wait, or the next one if none is under way. Any thread.
  virtual void wake() noexcept = 0;
};

}  // namespace luxodus
