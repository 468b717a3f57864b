// The coordinator's side of the display: it sends its totals, and waits until the display has saved
// the flux on a disk.
#include <fmt/format.h>

#include <algorithm>

#include "actors/cast/coordinator/run_coordinator.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

/// Seconds of tracing, in this incarnation.
double RunCoordinator::shown_seconds() const {
  const Nanoseconds until = over_ ? over_since_ : clock().now();
  return seconds_in(until - began_);
}

/// Once a run is over nothing is added any more.
void RunCoordinator::show_last_totals() {
  if (!over_ || fault_ || reading_ || !shows_.wanted()) return;
  reading_ = packing_ = shows_.begin_pack();
  const auto read = [this, seconds = shown_seconds()] {
    try {
      shows_.pack(run_, seconds);
    } catch (...) {
      reading_failed_ = std::current_exception();
    }
  };
  calls_.begin(read, own_task([this] { totals_read(false); }));
}

/// What a display said in an earlier incarnation no longer holds. Another coordinator may lead its
/// node, and its tracer reports the restart only to that one.
void RunCoordinator::meet_display(Incarnation life) {
  if (display_life_ && *display_life_ != life) shows_.end_life(shows_.node());
  display_life_ = life;
  shows_.heard(clock().now());
}

void RunCoordinator::on(const Letter<ShowTotals>& show) {
  if (!shows_.is_display(show.from)) return;
  meet_display(show.id.incarnation);
  shows_.on(show);
  over_ ? show_last_totals() : look_at_totals();
}

void RunCoordinator::on(const Letter<FluxSaved>& saved) {
  if (!shows_.is_display(saved.from)) return;
  meet_display(saved.id.incarnation);
  if (!saved.body.fault.empty()) return lose_display(saved.body.fault);
  if (!over_) return;
  shows_.saved();
  let_go_when_told();
}

/// Whether the results are saved, or never will be. The display is awaited as long as it lives: a
/// disk may be slow, or full for a while. An interrupted run waits for no unreachable display.
bool RunCoordinator::show_is_settled() {
  if (!shows_.any() || shows_.is_saved() || fault_) return true;
  const NodeId node = shows_.node();
  if (node == config_.self || network_.reaches(node)) return false;
  const Nanoseconds now = clock().now();
  const Nanoseconds since = peers_.at(node).unreachable_since.value_or(now);
  // After an earlier incarnation has counted all, it may still have to appear.
  const Nanoseconds patience = done_before_ ? std::max(config_.start, config_.lost) : config_.lost;
  if (!interrupt_.load() && now - std::max(since, over_since_) < patience) return false;
  if (book_.committed() == 0) return true;  // there is nothing to write
  lose_display(fmt::format("no way leads to {}, which was to write the results", name_of(node)));
  return true;
}

void RunCoordinator::lose_display(const std::string& why) {
  if (!over_) return fail(why);
  if (fault_) return;
  lost_display_ = true;
  fault_ = problem(why, ProblemKind::lost_peer);
  log_error("run=unwritten text=\"{}\"", why);
  tell_end_anew();
}

}  // namespace luxodus
