// A node's links and the node itself as bad as a plan of faults says, on a real network: for
// studies of what distance costs, and for rehearsals. It stands between a node and its sockets, at
// every node; where there is no plan, it is not there at all.
//
// The sender draws a frame's fate and writes in front of it when it was sent and how long it is to
// be held; the receiver holds it. Where all nodes share a clock, a receiver that takes a frame in
// late, because it was busy, does not add to the delay. Frames keep the order of their link and
// lane, unless they are to be overtaken. What is held is bounded: beyond it, frames rest in the
// transport below, and credit ends. Nodes stand still and crash for real. Thread rule: one node's
// thread, but for wake().
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "runtime/core/faults.hpp"
#include "runtime/net/transport.hpp"

namespace luxodus {

namespace limits {
/// Of a link that is slow for a whole run: a tenth of a beat's patience. Questions of a run have
/// seconds for their answers.
inline constexpr Nanoseconds link_delay = milliseconds(100);
/// Held back at once by a node [bytes]: four links' windows, 5 classes of 0.5 MB, six times over.
inline constexpr size_t held_back_bytes = 64 << 20;
/// A frame is held for no longer than this, whatever it says.
inline constexpr Nanoseconds held_back_for = seconds(60);
}  // namespace limits

struct FaultyConfig {
  NodeId self;
  FaultPlan plan;
  /// All nodes tell the time alike: they are on one host.
  bool one_clock = true;
  size_t max_held = limits::held_back_bytes;
  /// How a node stands still for so long, and how its process ends at once. Null: for real.
  std::function<void(Nanoseconds)> stand_still;
  std::function<void()> crash;
};

class FaultyTransport final : public Transport {
 public:
  /// The plan's moments count from now. Requires: `below` and `clock` outlive this.
  FaultyTransport(Transport& below, FaultyConfig config, const Clock& clock);

  Sent send(NodeId neighbour, Lane lane, std::span<const std::byte> head,
            std::span<const std::byte> body) override;
  void renew(NodeId neighbour) override { below_.renew(neighbour); }
  void part(NodeId neighbour) override { below_.part(neighbour); }
  std::optional<Arrival> receive() override;
  void wait_until(Nanoseconds until) override;
  void wake() noexcept override { below_.wake(); }

  struct Counters {
    uint64_t lost = 0;
    uint64_t duplicated = 0;
    uint64_t overtaken = 0;
    uint64_t harmed = 0;
    uint64_t unstamped = 0;  // too short to say when they were sent: the other end has no plan
  };
  const Counters& counters() const { return counters_; }
  /// Bytes of the frames that are held back now.
  size_t held_bytes() const { return held_bytes_; }

 private:
  /// In front of every frame.
  struct Stamp {
    Nanoseconds sent = 0;
    Nanoseconds hold = 0;
    uint64_t overtaken = 0;
  };
  struct Held {
    Nanoseconds due = 0;
    uint64_t number = 0;  // of arrival: frames of one link and one moment keep their order
    NodeId neighbour;
    std::vector<std::byte> bytes;
  };
  static bool later(const Held& a, const Held& b) {
    return a.due != b.due ? a.due > b.due : a.number > b.number;
  }
  /// What is known of a neighbour.
  struct Way {
    Nanoseconds free_at = 0;                    // of the wire, by its bandwidth
    std::array<Nanoseconds, lanes> last_due{};  // of what came from it in order
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
  Held given_;                                 // what the last arrival points into
  std::vector<std::byte> frame_;               // one being sent
  size_t held_bytes_ = 0;
  uint64_t arrived_ = 0;
  Nanoseconds working_since_;  // for a node that is slow
  Counters counters_;
};

}  // namespace luxodus
