#include "actors/judge/visibility_map/sign_answer.hpp"

#include <algorithm>

namespace luxodus {

namespace {

/// How much an answer promises: less counts.
int promise(const SignEstimate& estimate) {
  if (estimate.answer == SignAnswer::read) return 4;
  if (estimate.answer == SignAnswer::undecided) return estimate.surely_seen ? 3 : 1;
  return estimate.answer == SignAnswer::seen ? 2 : 0;
}

const Uncertain& lower(const Uncertain& a, const Uncertain& b) {
  return b.value < a.value ? b : a;
}

}  // namespace

const char* name_of(SignAnswer answer) {
  switch (answer) {
    case SignAnswer::read:
      return "read";
    case SignAnswer::seen:
      return "seen";
    case SignAnswer::invisible:
      return "invisible";
    case SignAnswer::hidden:
      return "hidden";
    case SignAnswer::undecided:
      return "undecided";
  }
  return "";
}

SignEstimate estimate_of(const Sight& sight) {
  SignEstimate out;
  out.reading_level = sight.reading_level;
  out.seeing_level = sight.seeing_level;
  switch (sight.verdict) {
    case SightVerdict::legible:
      out.answer = SignAnswer::read;
      break;
    case SightVerdict::visible:
      out.answer = SignAnswer::seen;
      break;
    case SightVerdict::invisible:
      out.answer = SignAnswer::invisible;
      break;
    case SightVerdict::hidden:
      out.answer = SignAnswer::hidden;
      break;
    case SightVerdict::undecided:
      out.surely_seen = sight.seeing_level.value - sight.sure_errors * sight.seeing_level.error >=
                        sight.seen_from;
      break;
    case SightVerdict::not_assessed:
      break;
  }
  out.surely_seen |= out.answer == SignAnswer::read || out.answer == SignAnswer::seen;
  return out;
}

SignEstimate worse_of(const SignEstimate& a, const SignEstimate& b) {
  SignEstimate out = promise(b) < promise(a) ? b : a;
  out.surely_seen = a.surely_seen && b.surely_seen;
  out.reading_level = lower(a.reading_level, b.reading_level);
  out.seeing_level = lower(a.seeing_level, b.seeing_level);
  return out;
}

}  // namespace luxodus
