// Credit-based flow control of one pool: one link, direction, kind and hop class. Both ends count
// bytes from the beginning of the session and send totals, never differences, so grants and reports
// may be lost, duplicated or late. The receiver learns from the sender's total what was lost on the
// way, and frees it; it never holds more than its window, whatever the sender does. Thread rule:
// one node's thread.
#pragma once

#include <algorithm>
#include <cstdint>

namespace luxodus {

/// The sending end.
class CreditOut {
 public:
  /// `window` is the receiver's: no more than that is ever outstanding, whatever it grants.
  explicit CreditOut(uint64_t window) : window_(window) {}

  bool allows(uint64_t bytes) const { return bytes <= limit_ - sent_; }
  /// Requires: allows(bytes).
  void spend(uint64_t bytes) { sent_ += bytes; }
  void grant(uint64_t limit) { limit_ = std::max(limit_, std::min(limit, sent_ + window_)); }
  /// The receiver has restarted and counts from 0.
  void restart() { sent_ = limit_ = 0; }
  uint64_t sent() const { return sent_; }
  /// Bytes that may still be sent.
  uint64_t left() const { return limit_ - sent_; }

 private:
  uint64_t window_;
  uint64_t sent_ = 0;
  uint64_t limit_ = 0;  // >= sent_
};

/// The receiving end.
class CreditIn {
 public:
  explicit CreditIn(uint64_t window = 0) : window_(window) {}

  /// A frame of this many bytes has arrived, with the sender's total. False: there is no room, and
  /// it must be dropped.
  bool arrive(uint64_t sent, uint64_t bytes) {
    const bool room = bytes <= window_ - held_;
    arrived_ = std::max(arrived_, sent);
    if (room) held_ += bytes;
    return room;
  }

  /// The sender reports its total: everything sent before has arrived or is lost.
  void settle(uint64_t sent) { arrived_ = std::max(arrived_, sent); }

  /// The sender has restarted and counts from 0. Held bytes stay held.
  void restart() { arrived_ = announced_ = 0; }

  /// Requires: bytes <= held().
  void release(uint64_t bytes) { held_ -= bytes; }

  /// The total up to which the sender may send.
  uint64_t limit() const { return arrived_ + (window_ - held_); }

  /// Returns the limit to announce now, and remembers it as announced.
  uint64_t announce() { return announced_ = limit(); }

  /// Whether half the window has become free since the last announcement: worth a frame of its own.
  bool overdue() const { return limit() >= announced_ + window_ / 2 && limit() > announced_; }

  bool news() const { return limit() > announced_; }
  uint64_t held() const { return held_; }
  uint64_t window() const { return window_; }

 private:
  uint64_t window_;
  uint64_t held_ = 0;  // <= window_
  uint64_t arrived_ = 0;
  uint64_t announced_ = 0;
};

}  // namespace luxodus
