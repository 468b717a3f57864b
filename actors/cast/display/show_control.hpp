// The coordinator's side of the display: sends a snapshot of its totals, piece by piece, and tracks
// whether the run's flux is on a disk. One show at a time; a later one replaces it. Lost, late and
// duplicate messages: a piece that is requested again is sent again; a request for a piece of a
// replaced show gets an empty answer, and the requester starts again. Thread rule: the node's
// thread, except pack().
#pragma once

#include <optional>
#include <string>

#include "actors/cast/display/totals_snapshot.hpp"
#include "actors/cast/names/role.hpp"
#include "runtime/messaging/actor_system.hpp"
#include "runtime/messaging/retry_timer.hpp"

namespace luxodus {

class ShowControl {
 public:
  /// `display`: its node; nothing: there is none. `self`: the coordinator that it asks. Requires:
  /// `sender` outlives this.
  ShowControl(const std::optional<NodeId>& display, const LocalRun& run, const RetryTimer& timer,
              Sender& sender, Address self);

  bool any() const { return display_.has_value(); }
  NodeId node() const { return *display_; }
  bool is_display(Address from) const {
    return from.actor == role::display && display_ == from.node;
  }

  /// A request for a piece; one for the first waits until the totals are packed.
  void on(const Letter<ShowTotals>& letter);
  /// Whether totals are to be packed, as soon as nothing is being added to them.
  bool wanted() const { return wanted_.has_value(); }
  /// Returns whether totals are wanted, so that pack() and packed() follow. Until then no piece is
  /// sent.
  bool begin_pack();
  /// Any thread. Requires: nothing is added to the totals meanwhile.
  void pack(const LocalRun& run, double seconds);
  /// Answers the waiting request; `over`: the run is, for this reason.
  void packed(bool over, StopReason reason);
  /// Tells the display that the run is over, or that it failed and has no results; but not while
  /// the display may yet answer the previous message.
  void tell_end(const RunEnded& ended, Nanoseconds now);
  /// The display has sent a message.
  void heard(Nanoseconds now) { telling_.answered(now); }
  /// A node has restarted: what its display said before no longer holds.
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
  std::optional<Wanted> shown_;  // the request whose totals are packed
  bool over_ = false;            // whether the run was over then
  StopReason reason_ = StopReason::particles;
  bool packing_ = false;  // the snapshot belongs to another thread
  bool saved_ = false;
  const RetryTimer new_timer_;
  RetryTimer telling_ = new_timer_;  // retries of telling it the end
};

}  // namespace luxodus
