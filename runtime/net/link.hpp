// One neighbour: its state, the handshake and heartbeats, the credit of every pool in both
// directions, and the frames from it that wait to be forwarded or delivered. Link frames
// (handshake, beat, grant) need no credit and are consumed on arrival, so grants never wait for
// grants. Thread rule: one node's thread.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "proto/codec.hpp"
#include "runtime/core/once_a_minute.hpp"
#include "runtime/net/counters.hpp"
#include "runtime/net/credit.hpp"
#include "runtime/net/frame_ring.hpp"
#include "runtime/net/link_state.hpp"
#include "runtime/net/net_config.hpp"
#include "runtime/net/transport.hpp"

namespace luxodus {

constexpr Lane lane_of(Kind kind) {
  return NetConfig::is_bulk(kind) ? Lane::bulk : Lane::control;
}

/// What the links of a node share.
struct LinkSurroundings {
  const NetConfig& config;
  Transport& transport;
  Codec& codec;
  NetCounters& counters;
  std::span<std::byte> scratch;  // buffer for one message of a link
};

class Link {
 public:
  Link(const LinkSurroundings& around, NodeId neighbour, Nanoseconds now);

  NodeId neighbour() const { return neighbour_; }
  const LinkState& state() const { return state_; }
  /// Why the link is refused, for people; "" if it is not.
  std::string refusal_text() const {
    return state_.phase() == LinkPhase::refused ? refusal_ : std::string();
  }
  /// Whether the neighbour has said that it works for another run.
  bool refused_as_taken() const {
    return state_.phase() == LinkPhase::refused && refused_for_ == RefusalReason::taken;
  }
  /// How often the link came up: distinguishes a link that fell and recovered from one that stayed
  /// up.
  uint64_t sessions() const { return sessions_; }

  /// Advances time and sends a hello if one is due.
  void tick(Nanoseconds now);
  void forgive(Nanoseconds span) { state_.forgive(span); }
  /// Sends one beat on each lane, to an accepted neighbour: all totals and limits of the lane.
  void beat(uint64_t view_hash, Nanoseconds now);
  void say_bye();
  void say(const LinkChanges& changes);

  /// A message of kind `link` has arrived. False: it comes from another incarnation than the
  /// accepted one, and is dropped.
  bool take(const Envelope& envelope, Lane lane, const Message& message, Nanoseconds now);

  /// Whether a routed frame is from the accepted incarnation of the neighbour to this incarnation
  /// of ours; if so, its grant is applied.
  bool admits(const Envelope& envelope, Nanoseconds now);
  /// Charges an admitted frame to its pool and keeps it there. False: the window is exceeded.
  bool hold(const Envelope& envelope, std::span<const std::byte> body);
  /// As hold(), for a frame that is consumed at once.
  bool pass(const Envelope& envelope, size_t body_bytes);

  enum class Gone : uint8_t { sent, not_now };
  /// Sends a routed frame if the link is usable and there is credit for its kind and hops.
  Gone send(Envelope envelope, std::span<const std::byte> body, Nanoseconds now);
  /// Announces limits that have grown by half a window.
  void tell_grants();

  /// Frames received in this kind and class, the oldest first. Requires: 1 <= hop class <= limit.
  const FrameRing& pool(Kind kind, uint8_t hop_class) const { return at(kind, hop_class).frames; }
  /// Requires: the pool is not empty.
  void release(Kind kind, uint8_t hop_class);

  // Traffic and credit, for metrics.
  void count_arrival(size_t frame_bytes) { bytes_received_ += frame_bytes; }
  uint64_t bytes_sent() const { return bytes_sent_; }
  uint64_t bytes_received() const { return bytes_received_; }
  /// Credit left in all pools, as a sender.
  uint64_t credit_bytes() const;
  /// Bytes received that wait here, in all pools.
  uint64_t held_bytes() const;

  size_t memory_bytes() const;
  /// Memory of a link, before it is made.
  static size_t memory_bytes(const NetConfig& config);

 private:
  struct Pool {
    Pool(size_t window, size_t max_body) : out(window), in(window), frames(window, max_body) {}
    CreditOut out;
    CreditIn in;
    FrameRing frames;
  };
  size_t index(Kind kind, uint8_t hop_class) const;
  Pool& at(Kind kind, uint8_t hop_class) { return pools_[index(kind, hop_class)]; }
  const Pool& at(Kind kind, uint8_t hop_class) const { return pools_[index(kind, hop_class)]; }

  void meet(const Envelope& envelope, const Identity& theirs, bool welcomed, Nanoseconds now);
  bool taken(const Envelope& envelope, const Identity& theirs, Nanoseconds now);
  void be_refused(const Refuse& refuse, Nanoseconds now);
  void settle(const Beat& beat, Lane lane);
  void use(const Grant& grant);
  Grant next_grant();
  Envelope link_envelope() const;
  /// `to`: an incarnation other than the accepted one.
  Sent say(const Message& message, Lane lane, std::optional<Incarnation> to = {});
  Sent give(const Envelope& envelope, std::span<const std::byte> body, Lane lane);
  void note_rise(bool was_usable, Nanoseconds now);

  LinkSurroundings around_;
  NodeId neighbour_;
  LinkState state_;
  std::vector<Pool> pools_;
  size_t grant_cursor_ = 0;
  uint64_t sessions_ = 0;
  std::string refusal_;  // the last one, in words
  RefusalReason refused_for_ = RefusalReason::protocol;
  bool parted_ = false;  // refused and disconnected: reconnect before the next hello
  /// Where the run that this node works for writes its results, as the neighbour said; "" if it has
  /// not. Once set, it holds until the neighbour says bye.
  std::string works_for_;
  /// Rate limits of refusals in the log, by reason: ours, and the neighbour's.
  std::array<OnceAMinute, refusal_reasons> log_refusal_, log_being_refused_;
  uint64_t bytes_sent_ = 0;
  uint64_t bytes_received_ = 0;
};

}  // namespace luxodus
