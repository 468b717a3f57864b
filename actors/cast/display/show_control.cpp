#include "actors/cast/display/show_control.hpp"

#include "actors/cast/names/role.hpp"
#include "runtime/messaging/node_actor.hpp"

namespace luxodus {

ShowControl::ShowControl(const std::optional<NodeId>& display, const LocalRun& run,
                         const RetryTimer& timer, Sender& sender, Address self)
    : display_(display), sender_(sender), self_(self), new_timer_(timer) {
  if (display_) snapshot_.emplace(run.totals().groups(), run.totals().layout().totals());
}

/// Each incarnation of the display numbers its shows; another one has other ids.
void ShowControl::on(const Letter<ShowTotals>& letter) {
  const Wanted question{letter.from, letter.id, letter.body};
  const bool known = !packing_ && shown_ && shown_->asked.show == question.asked.show &&
                     shown_->question.incarnation == question.question.incarnation;
  if (known && question.asked.piece < snapshot_->pieces())
    return answer(question.from, question.question, question.asked);
  if (question.asked.piece == 0) {
    wanted_ = question;
    return;
  }
  sender_.send(self_, question.from, question.question,
               TotalsShown{.show = question.asked.show, .piece = question.asked.piece});
}

bool ShowControl::begin_pack() {
  packing_ = wanted();
  return packing_;
}

void ShowControl::pack(const LocalRun& run, double seconds) {
  snapshot_->pack(run, seconds);
}

void ShowControl::packed(bool over, StopReason reason) {
  packing_ = false;
  shown_ = std::exchange(wanted_, std::nullopt);
  over_ = over;
  reason_ = reason;
  if (!shown_) return;  // the requester has restarted
  answer(shown_->from, shown_->question, shown_->asked);
}

void ShowControl::answer(Address to, const MessageId& question, const ShowTotals& asked) {
  TotalsShown shown = snapshot_->head(asked.piece);
  shown.show = asked.show;
  shown.over = over_;
  shown.stopped = static_cast<uint8_t>(reason_);
  sender_.send(self_, to, question, shown, snapshot_->bytes(asked.piece));
}

void ShowControl::tell_end(const RunEnded& ended, Nanoseconds now) {
  if (!any() || saved_ || !telling_.may_remind(now)) return;
  const Address display{*display_, role::display};
  if (sender_.send(self_, display, sender_.next_id(), ended) == SendOutcome::taken)
    telling_.asked(now);
}

void ShowControl::end_life(NodeId node) {
  if (display_ != node) return;
  telling_ = new_timer_;
  saved_ = false;
  wanted_.reset();
  shown_.reset();
}

void ShowControl::saved() {
  saved_ = true;
  shown_.reset();
  if (!packing_) snapshot_->forget();
}

}  // namespace luxodus
