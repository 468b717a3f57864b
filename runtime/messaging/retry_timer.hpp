// When a question that has had no answer is asked again. Whoever asks at a fixed pace fills a slow
// network with copies of what already waits in it, so that answers come later still. This timer
// follows the network as TCP's does (RFC 6298, https://www.rfc-editor.org/rfc/rfc6298): the first
// wait is twice as long as the last answer took, and each copy doubles it.
#pragma once

#include <algorithm>
#include <optional>

#include "runtime/core/clock.hpp"

namespace luxodus {

/// Of one kind of question, of which one is asked at a time.
class RetryTimer {
 public:
  /// All waits lie between these.
  RetryTimer(Nanoseconds least, Nanoseconds most) : least_(least), most_(std::max(least, most)) {}

  /// The question is on its way, for the first time or again.
  void asked(Nanoseconds now) {
    wait_ = begun_ ? std::min(2 * wait_, most_) : first_wait();
    if (!begun_) begun_ = now;
    asked_ = now;
  }
  /// Which copy was answered nobody knows: an answer takes as long as was thought, where that fits
  /// one of them. Were it counted from the first, a first one that is lost each time would double
  /// all waits; from the last, waits would be too short for a slow network.
  void answered(Nanoseconds now) {
    if (!begun_) return;
    took_ = std::clamp(took_, now - asked_, now - *begun_);
    begun_.reset();
    answered_ = now;
  }
  /// Nobody wants the answer any more.
  void forget() { begun_.reset(); }

  /// Asked, and not answered for too long.
  bool is_due(Nanoseconds now) const { return begun_ && now - asked_ >= wait_; }
  /// Nothing is on its way that may yet be answered in time.
  bool may_ask(Nanoseconds now) const { return !begun_ || is_due(now); }
  /// How long the next question will wait before it is asked again.
  Nanoseconds first_wait() const { return std::clamp(2 * took_, least_, most_); }
  /// How long to leave the network to others after an answer, where the next question can wait:
  /// then what a thousand nodes ask in vain takes a ninth of what a slow network carries.
  Nanoseconds rest() const { return std::clamp(8 * took_, least_, most_); }
  /// Nothing is asked, and that long ago was the last answer.
  bool has_rested(Nanoseconds now) const {
    return !begun_ && (!answered_ || now - *answered_ >= rest());
  }
  /// Of what is said again and again, though it was answered.
  bool may_remind(Nanoseconds now) const { return is_due(now) || has_rested(now); }
  /// How long an answer takes, as far as is known; 0: there was none.
  Nanoseconds took() const { return took_; }

 private:
  Nanoseconds least_, most_;
  Nanoseconds took_ = 0;
  std::optional<Nanoseconds> begun_;     // asking
  std::optional<Nanoseconds> answered_;  // for the last time
  Nanoseconds asked_ = 0;
  Nanoseconds wait_ = 0;
};

}  // namespace luxodus
