// Injects faults into a node's links and the node itself by a plan, on a real network: for studies
// of the cost of distance, and for drills. It wraps the transport of every node; without a plan it
// is not created.
//
// The sender draws a frame's fate and stamps the frame with the time of sending and how long to
// hold it; the receiver holds it. If all nodes share a clock, a receiver that reads a frame late,
// because it was busy, adds nothing to the delay. Frames keep the order of their link and lane,
// unless they are to be overtaken. The held bytes are bounded: beyond the limit, frames stay in the
// transport below, and credit runs out. Pauses and crashes are real. Thread rule: one node's
// thread, except wake().
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "runtime/core/faults.hpp"
#include "runtime/net/transport.hpp"

namespace luxodus {

namespace limits {
/// Largest delay of a link that is slow for a whole run: a tenth of the heartbeat timeout. Requests
/// of a run wait for seconds.
inline constexpr Nanoseconds link_delay = milliseconds(100);
/// Most that a node holds back at once [bytes]: four links' windows, 5 classes of 0.5 MB, six times
/// over.
inline constexpr size_t held_back_bytes = 64 << 20;
/// A frame is held no longer than this, whatever its stamp says.
inline constexpr Nanoseconds held_back_for = seconds(60);
}  // namespace limits

struct FaultyConfig {
  NodeId self;
  FaultPlan plan;
  /// All nodes share one clock: they are on one host.
  bool one_clock = true;
  size_t max_held = limits::held_back_bytes;
  /// Replace a real pause and the abrupt end of the process. Null: real ones.
  std::function<void(Nanoseconds)> stand_still;
  std::function<void()> crash;
};

class FaultyTransport final : public Transport {
 public:
  /// The plan's times count from construction. Requires: `below` and `clock` outlive this.
  FaultyTransport(Transport& below, FaultyConfig config, const Clock& clock);

  Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override;
  void renew(NodeId neighbour) override { below_.renew(neighbour); }
  void part(NodeId neighbour) override { below_.part(neighbour); }
  std::optional<Arrival> receive() override;
  uint64_t lost_connections() const override { return below_.lost_connections(); }
  void wait_until(Nanoseconds until) override;
  void wake() noexcept override { below_.wake(); }

  struct Counters {
    uint64_t lost = 0;
    uint64_t duplicated = 0;
    uint64_t overtaken = 0;
    uint64_t harmed = 0;
    uint64_t unstamped = 0;  // too short for a stamp: the other end has no plan
  };
  const Counters& counters() const { return counters_; }
  /// Bytes of the frames that are held now.
  size_t held_bytes() const { return held_bytes_; }

 private:
  /// Precedes every frame.
  struct Stamp {
    Nanoseconds sent = 0;
    Nanoseconds hold = 0;
    uint64_t overtaken = 0;
  };
  struct Held {
    Nanoseconds due = 0;
    uint64_t number = 0;  // order of arrival: frames of one link and time keep their order
    NodeId neighbour;
    std::vector<std::byte> bytes;
  };
  static bool later(const Held& a, const Held& b) {
    return a.due != b.due ? a.due > b.due : a.number > b.number;
  }
  /// State of the way to and from a neighbour.
  struct Way {
    Nanoseconds free_at = 0;                    // when the wire is free, by its bandwidth
    std::array<Nanoseconds, lanes> last_due{};  // of frames received from it in order
  };

  Nanoseconds moment() const { return clock_.now() - began_; }
  bool holds(Fault::Kind kind, NodeId neighbour) const;
  Nanoseconds clogged_for(NodeId neighbour) const;
  Sent give(NodeId neighbour, Lane lane, const Stamp& stamp);
  void suffer();
  void take_in();
  void hold_back(const Arrival& arrival);
  std::optional<Arrival> take_due();

  Transport& below_;
  const FaultyConfig config_;
  const Clock& clock_;
  const Nanoseconds began_;
  LinkTroubles troubles_;
  std::map<NodeId, Way> ways_;
  std::array<std::vector<Held>, lanes> held_;  // heaps, the earliest first
  Held given_;                                 // the frame that the last Arrival points into
  std::vector<std::byte> frame_;               // the frame being sent
  size_t held_bytes_ = 0;
  uint64_t arrived_ = 0;
  Nanoseconds working_since_;  // for the fault `slow`
  Counters counters_;
};

}  // namespace luxodus
