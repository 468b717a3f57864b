// The state of one link as seen by one of its ends: a pure state machine of events and time. It
// sends nothing and knows no frames; Link feeds it events and does what is due. Thread rule: one
// node's thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/core/clock.hpp"
#include "runtime/core/ids.hpp"

namespace luxodus {

//  ┌────────────┐ hello out ┌──────────┐ acknowledged ┌────┐ 3 missed ┌─────────┐
//  │ connecting │ ────────► │ greeting │ ───────────► │ up │ ───────► │ suspect │
//  └────────────┘ ◄──────── └──────────┘ ◄─────────── └────┘ ◄─────── └─────────┘
//     ▲    │    unreachable    │    ▲   another life     │   any frame     │
//     │    │ patience          │    │                    │ bye,            │ 8 missed, bye,
//     │    ▼ over              ▼    │ accepted           ▼ unreachable     ▼ unreachable
//  ┌──────────────────────────────────────────────────────────────────────────────┐
//  │                                     down                                     │
//  └──────────────────────────────────────────────────────────────────────────────┘
//  down ── backoff over ──► connecting;  connecting, refused ── accepted ──► greeting
//  any  ── identities differ, or the peer says so ──► refused
//
// Accepted: the peer's identity agrees with ours. Acknowledged: a frame from that incarnation of
// the peer was addressed to this incarnation of ours, so it has accepted us. A refused link keeps
// sending hello at long intervals: the cause at either end may have been fixed.
enum class LinkPhase : uint8_t { connecting, greeting, up, suspect, down, refused };

constexpr const char* name_of(LinkPhase phase) {
  constexpr const char* names[] = {"connecting", "greeting", "up", "suspect", "down", "refused"};
  return names[static_cast<size_t>(phase)];
}

struct LinkTimes {
  Nanoseconds beat = milliseconds(250);
  int suspect_after_beats = 3;
  int down_after_beats = 8;                 // 2 s: longer than a page fault or a build
  Nanoseconds patience = seconds(10);       // for a greeting: hosts start at different times
  Nanoseconds backoff = milliseconds(250);  // between hellos, doubled up to:
  Nanoseconds max_backoff = seconds(5);
  Nanoseconds refused_retry = seconds(30);  // an operator acts within minutes, and reads the log
};

class LinkState {
 public:
  LinkState(const LinkTimes& times, Nanoseconds now);

  LinkPhase phase() const { return phase_; }
  bool usable() const { return phase_ == LinkPhase::up || phase_ == LinkPhase::suspect; }
  bool accepted() const { return accepted_; }
  /// The incarnation of the peer accepted last; 0 before the first.
  Incarnation peer() const { return peer_; }

  /// The transport took our hello.
  void greeted(Nanoseconds now);
  /// The transport has no connection.
  void unreachable(Nanoseconds now);
  /// The peer's identity agrees with ours. Returns true if this is a new incarnation: counts of the
  /// previous one are void. A greeting of a peer that is accepted already is no sign of life: on a
  /// link that loses what we send, it greets for as long as it does not hear us.
  bool accept(Incarnation peer, Nanoseconds now);
  /// The accepted peer addressed this incarnation of ours.
  void acknowledge(Nanoseconds now);
  /// The accepted peer sent a frame.
  void heard(Nanoseconds now);
  void bye(Nanoseconds now) { fall(now); }
  void refuse(Nanoseconds now);
  /// Sends no hello before `at`: the connection must be made first.
  void postpone_until(Nanoseconds at) { hello_at_ = at; }
  void tick(Nanoseconds now);
  /// This node itself was stalled for `span`: extends all timeouts, since it could hear nobody.
  void forgive(Nanoseconds span);

  bool hello_due(Nanoseconds now) const;
  /// When tick() or hello_due() may next change something.
  Nanoseconds next_deadline() const;

 private:
  void fall(Nanoseconds now);
  void postpone_hello(Nanoseconds now);

  LinkTimes times_;
  LinkPhase phase_ = LinkPhase::connecting;
  Incarnation peer_;
  bool accepted_ = false;
  Nanoseconds attempt_began_;
  Nanoseconds heard_;
  Nanoseconds hello_at_;
  Nanoseconds backoff_;
};

}  // namespace luxodus
