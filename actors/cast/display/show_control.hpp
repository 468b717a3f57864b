// The coordinator's side of the display: hands out its totals, piece by piece, as they were when
// they were asked for, and knows whether the flux of the run is on a disk. One show at a time, and
// a later one takes its place. What if a message is lost, late, or comes twice? A piece that is
// asked for again is told again; one of a show that is gone is answered by none at all, and who
// asked begins anew. Thread rule: the node's thread, but for pack().
#pragma once

#include <optional>
#include <string>

#include "actors/cast/display/totals_snapshot.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/messaging/retry_timer.hpp"

namespace luxodus {

class ShowControl {
 public:
  /// `display`: the node where it lives; nothing: there is none. `self`: whom it asks.
  /// Requires: `sender` outlives this.
  ShowControl(const std::optional<NodeId>& display, const LocalRun& run, const RetryTimer& timer,
              Sender& sender, Address self);

  bool any() const { return display_.has_value(); }
  NodeId node() const { return *display_; }
  bool is_display(Address from) const {
    return from.actor == ActorName::display && display_ == from.node;
  }

  /// A question for a piece; one for the first waits until the totals are packed.
  void on(const Letter<ShowTotals>& letter);
  /// Whether totals are to be packed, as soon as nobody adds to them.
  bool wanted() const { return wanted_.has_value(); }
  /// Whether pack() and packed() follow, since totals are wanted. Until then no piece is told.
  bool begin_pack();
  /// Any thread. Requires: nobody adds to the totals meanwhile.
  void pack(const LocalRun& run, double seconds);
  /// Answers who waits; `over`: the run is, for this reason.
  void packed(bool over, StopReason reason);
  /// Says that the run is over, or that it failed and leaves nothing; but not while the display may
  /// yet answer the last word of it.
  void tell_end(const RunEnded& ended, Nanoseconds now);
  /// The display has said something.
  void heard(Nanoseconds now) { telling_.answered(now); }
  /// A node has begun anew: what a display there had said holds no more.
  void end_life(NodeId node);
  /// The flux is on the disk.
  void saved();
  bool is_saved() const { return saved_; }

 private:
  void answer(Address to, const MessageId& question, const ShowTotals& asked);

  const std::optional<NodeId> display_;
  Sender& sender_;
  const Address self_;
  std::optional<TotalsSnapshot> snapshot_;
  struct Wanted {
    Address from;
    MessageId question;
    ShowTotals asked;
  };
  std::optional<Wanted> wanted_;
  std::optional<Wanted> shown_;  // whose totals are packed
  bool over_ = false;            // when they were
  StopReason reason_ = StopReason::particles;
  bool packing_ = false;  // what is packed belongs to another thread
  bool saved_ = false;
  const RetryTimer new_timer_;
  RetryTimer telling_ = new_timer_;  // it of the end
};

}  // namespace luxodus
