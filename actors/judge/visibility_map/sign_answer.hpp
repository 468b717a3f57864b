// What a person who looks towards a sign gets from it, in brief. Plain values and pure functions;
// any thread.
#pragma once

#include <cstdint>

#include "scenes/emergency/legibility.hpp"

namespace luxodus {

/// What a person who looks towards a sign gets from it. `hidden`: by the building, or no face of
/// the sign is turned to the person.
enum class SignAnswer : uint8_t { read, seen, invisible, hidden, undecided };
inline constexpr size_t sign_answers = static_cast<size_t>(SignAnswer::undecided) + 1;
/// "read", "seen", ...
const char* name_of(SignAnswer answer);

struct SignEstimate {
  SignAnswer answer = SignAnswer::undecided;
  /// The sign is surely seen: read, seen, or undecided between the two.
  bool surely_seen = false;
  /// As in Sight, for the eyes of the assessment; in the worse of aged and new light. Errors are
  /// those of a value that holds at `sure_errors` of them. 0 if the light decides nothing.
  Uncertain reading_level, seeing_level;
};

/// The estimate that a verdict on the light of a view amounts to.
SignEstimate estimate_of(const Sight& sight);

/// Whether both say that a sign is read, or seen: what holds between two times. Levels are the
/// lower ones.
SignEstimate worse_of(const SignEstimate& a, const SignEstimate& b);

}  // namespace luxodus
