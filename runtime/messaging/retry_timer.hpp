// When to retry a request without an answer. Retrying at a fixed pace fills a slow network with
// copies of requests that already wait in it, so that answers come even later. This timer adapts to
// the network as TCP's does (RFC 6298, https://www.rfc-editor.org/rfc/rfc6298): the first wait is
// twice as long as the last answer took, and each copy doubles it. Plain value; one node's thread.
#pragma once

#include <algorithm>
#include <optional>

#include "runtime/core/clock.hpp"

namespace luxodus {

/// For one kind of request, of which one is in flight at a time.
class RetryTimer {
 public:
  /// All waits lie in this range.
  RetryTimer(Nanoseconds least, Nanoseconds most) : least_(least), most_(std::max(least, most)) {}

  /// The request was sent, for the first time or again.
  void asked(Nanoseconds now) {
    wait_ = begun_ ? std::min(2 * wait_, most_) : first_wait();
    if (!begun_) begun_ = now;
    asked_ = now;
  }
  /// It is unknown which copy was answered, so the estimate is only moved into the range between
  /// the last and the first copy. Counting from the first copy would double all waits whenever the
  /// first copy is lost; counting from the last would make waits too short for a slow network.
  void answered(Nanoseconds now) {
    if (!begun_) return;
    took_ = std::clamp(took_, now - asked_, now - *begun_);
    begun_.reset();
    answered_ = now;
  }
  /// The answer is no longer wanted.
  void forget() { begun_.reset(); }

  /// Whether a request has waited too long for its answer.
  bool is_due(Nanoseconds now) const { return begun_ && now - asked_ >= wait_; }
  /// Whether no request is in flight that may still be answered in time.
  bool may_ask(Nanoseconds now) const { return !begun_ || is_due(now); }
  /// How long the next request will wait before its first retry.
  Nanoseconds first_wait() const { return std::clamp(2 * took_, least_, most_); }
  /// How long to pause after an answer if the next request can wait: polling by a thousand nodes
  /// then takes a ninth of the capacity of a slow network.
  Nanoseconds rest() const { return std::clamp(8 * took_, least_, most_); }
  /// Whether no request is in flight and the pause after the last answer is over.
  bool has_rested(Nanoseconds now) const {
    return !begun_ && (!answered_ || now - *answered_ >= rest());
  }
  /// For a message that is repeated although it was answered.
  bool may_remind(Nanoseconds now) const { return is_due(now) || has_rested(now); }
  /// Estimated time to an answer; 0 if there was none.
  Nanoseconds took() const { return took_; }

 private:
  Nanoseconds least_, most_;
  Nanoseconds took_ = 0;
  std::optional<Nanoseconds> begun_;     // when the request was first sent
  std::optional<Nanoseconds> answered_;  // the last time
  Nanoseconds asked_ = 0;
  Nanoseconds wait_ = 0;
};

}  // namespace luxodus
