#include "runtime/net/link_state.hpp"

#include <algorithm>

namespace luxodus {

LinkState::LinkState(const LinkTimes& times, Nanoseconds now)
    : times_(times), attempt_began_(now), heard_(now), hello_at_(now), backoff_(times.backoff) {}

void LinkState::greeted(Nanoseconds now) {
  if (phase_ == LinkPhase::connecting) phase_ = LinkPhase::greeting;
  postpone_hello(now);
}

void LinkState::unreachable(Nanoseconds now) {
  if (usable()) return fall(now);
  if (phase_ == LinkPhase::greeting) phase_ = LinkPhase::connecting;
  if (phase_ != LinkPhase::down) postpone_hello(now);
}

bool LinkState::accept(Incarnation peer, Nanoseconds now) {
  const bool another = peer != peer_;
  // It does not hear us, or it would not greet: only what is addressed to us keeps the link up.
  if (usable() && !another) return false;
  peer_ = peer;
  heard(now);
  accepted_ = true;
  if (phase_ != LinkPhase::greeting) {
    phase_ = LinkPhase::greeting;
    attempt_began_ = now;
    hello_at_ = now;
    backoff_ = times_.backoff;
  }
  return another;
}

void LinkState::acknowledge(Nanoseconds now) {
  heard(now);
  if (phase_ != LinkPhase::greeting || !accepted_) return;
  phase_ = LinkPhase::up;
  backoff_ = times_.backoff;
}

void LinkState::refuse(Nanoseconds now) {
  phase_ = LinkPhase::refused;
  accepted_ = false;
  postpone_hello(now);
}

void LinkState::heard(Nanoseconds now) {
  heard_ = now;
  if (phase_ == LinkPhase::suspect) phase_ = LinkPhase::up;
}

void LinkState::tick(Nanoseconds now) {
  switch (phase_) {
    case LinkPhase::connecting:
    case LinkPhase::greeting:
      if (now - attempt_began_ >= times_.patience) fall(now);
      break;
    case LinkPhase::up:
    case LinkPhase::suspect:
      if (now - heard_ >= times_.beat * times_.down_after_beats)
        fall(now);
      else if (now - heard_ >= times_.beat * times_.suspect_after_beats)
        phase_ = LinkPhase::suspect;
      break;
    case LinkPhase::down:
      if (now < hello_at_) break;
      phase_ = LinkPhase::connecting;
      attempt_began_ = now;
      break;
    case LinkPhase::refused:
      break;
  }
}

bool LinkState::hello_due(Nanoseconds now) const {
  return !usable() && phase_ != LinkPhase::down && now >= hello_at_;
}

void LinkState::forgive(Nanoseconds span) {
  heard_ += span;
  attempt_began_ += span;
}

Nanoseconds LinkState::next_deadline() const {
  switch (phase_) {
    case LinkPhase::connecting:
    case LinkPhase::greeting:
      return std::min(hello_at_, attempt_began_ + times_.patience);
    case LinkPhase::up:
      return heard_ + times_.beat * times_.suspect_after_beats;
    case LinkPhase::suspect:
      return heard_ + times_.beat * times_.down_after_beats;
    case LinkPhase::down:
    case LinkPhase::refused:
      break;
  }
  return hello_at_;
}

void LinkState::fall(Nanoseconds now) {
  if (phase_ == LinkPhase::refused) return;
  phase_ = LinkPhase::down;
  accepted_ = false;
  postpone_hello(now);
}

void LinkState::postpone_hello(Nanoseconds now) {
  if (phase_ == LinkPhase::refused) {
    hello_at_ = now + times_.refused_retry;
    return;
  }
  hello_at_ = now + backoff_;
  backoff_ = std::min(2 * backoff_, times_.max_backoff);
}

}  // namespace luxodus
