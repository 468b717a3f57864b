// Links as slow as wished: every frame is held back until `delay` has passed since it was sent, so
// that runs of one machine show what distance costs and what hides it. Promises the order of each
// link and lane, and that a wait ends when a held frame is due. A frame carries the moment at which
// it was sent, so the node that takes it in late, because it was busy, does not add to the delay;
// hence both ends of every link must be delayed, by one clock.
// What is held is bounded: beyond it, frames rest in the transport below, and credit ends.
// Thread rule: one node's thread, but for wake().
#pragma once

#include <array>
#include <vector>

#include "runtime/net/transport.hpp"

namespace luxodus {

namespace limits {
/// Of a link: a tenth of a beat's patience. Questions of a run have seconds for their answers.
inline constexpr Nanoseconds link_delay = milliseconds(100);
/// Held back at once by a node [bytes]: four links' windows, 5 classes of 0.5 MB, six times over.
inline constexpr size_t held_back_bytes = 64 << 20;
}  // namespace limits

class DelayedTransport final : public Transport {
 public:
  /// Requires: `below` and `clock` outlive this; 0 <= delay.
  DelayedTransport(Transport& below, Nanoseconds delay, const Clock& clock,
                   size_t held_most = limits::held_back_bytes)
      : below_(below), delay_(delay), clock_(clock), held_most_(held_most) {}

  Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override;
  std::optional<Arrival> receive() override;
  void wait_until(Nanoseconds until) override;
  void wake() noexcept override { below_.wake(); }

  /// Bytes of the frames that are held back now.
  size_t held_bytes() const { return held_bytes_; }
  /// Frames too short to say when they were sent: the other end is not delayed. They are dropped.
  uint64_t unstamped() const { return unstamped_; }

 private:
  struct Held {
    Nanoseconds due = 0;
    uint64_t number = 0;  // of arrival: frames of one link and one moment keep their order
    NodeId neighbour;
    std::vector<std::byte> bytes;
  };
  static bool later(const Held& a, const Held& b) {
    return a.due != b.due ? a.due > b.due : a.number > b.number;
  }

  void take_in();
  std::optional<Arrival> take_due();

  Transport& below_;
  const Nanoseconds delay_;
  const Clock& clock_;
  const size_t held_most_;
  std::array<std::vector<Held>, lanes> held_;  // heaps, the earliest first
  Held given_;                                 // what the last arrival points into
  std::vector<std::byte> stamped_;             // a head being sent
  size_t held_bytes_ = 0;
  uint64_t arrived_ = 0;
  uint64_t unstamped_ = 0;
};

}  // namespace luxodus
