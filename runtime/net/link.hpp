// One neighbour: its state, the handshake and beats, the credit of every pool in both directions,
// and the frames that came from it and wait to go on or to be taken. Link frames (handshake, beat,
// grant) need no credit and are used up where they arrive, so grants never wait for grants.
// Thread rule: one node's thread.
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
  std::span<std::byte> scratch;  // for one message that a link makes
};

class Link {
 public:
  Link(const LinkSurroundings& around, NodeId neighbour, Nanoseconds now);

  NodeId neighbour() const { return neighbour_; }
  const LinkState& state() const { return state_; }
  /// Why it is refused, for people; "" where it is not.
  std::string refusal_text() const {
    return state_.phase() == LinkPhase::refused ? refusal_ : std::string();
  }
  /// Whether the neighbour works for another run, and has said so.
  bool refused_as_taken() const {
    return state_.phase() == LinkPhase::refused && refused_for_ == RefusalReason::taken;
  }
  /// Times that it came up: tells a link that fell and rose from one that stood.
  uint64_t sessions() const { return sessions_; }

  /// Lets time pass and says hello if that is due.
  void tick(Nanoseconds now);
  void forgive(Nanoseconds span) { state_.forgive(span); }
  /// One beat on each lane, to a neighbour that listens: all totals and limits of the lane.
  void beat(uint64_t view_hash);
  void say_bye();
  void say(const LinkChanges& changes);

  /// A message of kind `link` has come. False: from another life than the one accepted; dropped.
  bool take(const Envelope& envelope, Lane lane, const Message& message, Nanoseconds now);

  /// Whether a routed frame is of this life of the neighbour for this life of ours; if so, its
  /// grant is used.
  bool admits(const Envelope& envelope, Nanoseconds now);
  /// Charges a frame that was admitted to its pool and keeps it there; false: over its window.
  bool hold(const Envelope& envelope, std::span<const std::byte> body);
  /// As hold(), for a frame that is used up at once.
  bool pass(const Envelope& envelope, size_t body_bytes);

  enum class Gone : uint8_t { sent, not_now };
  /// Sends a routed frame, if the link is usable and there is credit for its kind and hops.
  Gone send(Envelope envelope, std::span<const std::byte> body, Nanoseconds now);
  /// Tells limits that have grown by half a window.
  void tell_grants();

  /// Frames that came in this kind and class, the oldest first. Requires: 1 <= hop class <= limit.
  const FrameRing& pool(Kind kind, uint8_t hop_class) const { return at(kind, hop_class).frames; }
  /// Requires: the pool is not empty.
  void release(Kind kind, uint8_t hop_class);

  // What has passed over it, and what may: for those who watch.
  void count_arrival(size_t frame_bytes) { bytes_received_ += frame_bytes; }
  uint64_t bytes_sent() const { return bytes_sent_; }
  uint64_t bytes_received() const { return bytes_received_; }
  /// Credit of all pools that this node may still use up.
  uint64_t credit_bytes() const;
  /// What came and waits here, in all pools.
  uint64_t held_bytes() const;

  size_t memory_bytes() const;
  /// The same, before a link is made.
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
  /// `to`: another life of the neighbour than the one that is accepted.
  Sent say(const Message& message, Lane lane, std::optional<Incarnation> to = {});
  Sent give(const Envelope& envelope, std::span<const std::byte> body, Lane lane);
  void note_rise(bool was_usable, Nanoseconds now);

  LinkSurroundings around_;
  NodeId neighbour_;
  LinkState state_;
  std::vector<Pool> pools_;
  size_t grant_cursor_ = 0;
  uint64_t sessions_ = 0;
  std::string refusal_;  // the last one
  RefusalReason refused_for_ = RefusalReason::protocol;
  bool parted_ = false;  // refused, and the connection ended: it is made again before a hello
  /// Where the results go of the run that this node works for, as the neighbour said; "": it has
  /// not. Once said, it holds until the neighbour says bye.
  std::string works_for_;
  /// Refusals, by reason: ours, and the neighbour's. One who asks and asks cannot fill the log.
  std::array<OnceAMinute, refusal_reasons> log_refusal_, log_being_refused_;
  uint64_t bytes_sent_ = 0;
  uint64_t bytes_received_ = 0;
};

}  // namespace luxodus
