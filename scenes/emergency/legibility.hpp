// Whether somebody reads a sign, from the luminances that arrive at the eye: the verdict of the
// reality mode. A verdict is given only where it holds by two standard errors. It says what can be
// read when looked at; to notice a sign is another matter. Pure functions; any thread.
#pragma once

#include <optional>
#include <string>

#include "scenes/emergency/remark.hpp"
#include "scenes/emergency/sight.hpp"
#include "scenes/emergency/sign_geometry.hpp"

namespace luxodus {

/// A number with its standard error.
struct Uncertain {
  double value = 0;
  double error = 0;
};

/// What arrives from one sign.
struct SignLook {
  Uncertain legend, ground, surround;  // luminances at the eye [cd/m2]
  /// Legend less ground at the eye, without the light that the smoke sends from before them: that
  /// is the same for both, and all its chance would be in their difference.
  Uncertain difference;
  Uncertain face;            // mean of the whole face
  double visible_share = 1;  // of the face that nothing solid hides
  double transmission = 1;   // of the smoke on the way
  double veil_cd_m2 = 0;     // of glare in the eye
};

enum class SightVerdict { legible, visible, invisible, hidden, undecided, not_assessed };
/// "visible but not legible", ...
const char* name_of(SightVerdict verdict);

struct Sight {
  SightVerdict verdict = SightVerdict::not_assessed;
  std::optional<Remark> reason;  // where there is one to give
  Uncertain reading_level;       // visibility level of the smallest detail of the legend
  Uncertain seeing_level;        // of the face as a whole, by its pattern or before its surround
  double extinction = 0;         // mean on the line of sight [1/m]
  double jin_m = 0;              // how far Jin's law would have it legible
  bool jin_legible = false;
  bool stings = false;      // irritant smoke and the distance forbid reading it, whatever its light
  ViewingDistance viewing;  // what the code's rule would say
};

struct SightRules {
  Eye eye;
  bool irritant_smoke = false;
};

/// Requires: a view with a face turned to the eye.
Sight judge_sight(const Sign& sign, const SignView& view, const SignLook& look,
                  const SightRules& rules);

/// Whether it is read, or chance leaves open that it is.
bool may_be_read(const Sight& sight);

/// Of one view in two lights that the same paths have shown: the standard error of its level of
/// reading in the other light less that in the first. `beyond`: what arrives in the other light
/// less what does in the first, with the errors of that.
double error_of_level_beyond(const SignLook& first, const SignLook& other, const SignLook& beyond,
                             const SignView& view, const Eye& eye);

/// Which of two verdicts on one view, in two lights, counts: the one that is worse, or may be. What
/// is undecided may be invisible, unless it is surely seen: then it is legible or visible.
bool is_worse(const Sight& a, const Sight& b);

}  // namespace luxodus
