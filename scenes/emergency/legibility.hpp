// Whether a person reads a sign, judged from the luminances that arrive at the eye: the verdict of
// the reality mode. A verdict is given only if the value is far enough away from the limit, in
// standard errors. It says what a person can read who looks at the sign, not whether the sign is
// noticed. Pure functions; any thread.
#pragma once

#include <optional>
#include <string>

#include "scenes/emergency/eyes.hpp"
#include "scenes/emergency/remark.hpp"
#include "scenes/emergency/sight.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/emergency/uncertain.hpp"

namespace luxodus {

/// Light that arrives at an eye from one sign.
struct SignLook {
  Uncertain legend, ground, surround;  // luminances at the eye [cd/m2]
  /// Luminance of the legend minus that of the ground, at the eye, without light that the smoke in
  /// front of them scatters into the eye: it is the same for both, and would only add its noise.
  Uncertain difference;
  /// Mean luminance of the whole face minus that of its surround, likewise without the light that
  /// smoke up to the face scatters into the eye.
  Uncertain silhouette;
  double beyond_cd_m2 = 0;   // of the surround alone, likewise
  Uncertain face;            // mean luminance of the whole face
  double visible_share = 1;  // share of the face that nothing solid hides
  double transmission = 1;   // share of light that smoke between sign and eye lets pass
  double veil_cd_m2 = 0;     // veiling luminance of disability glare
  ColoursAtEye colours;      // estimates; the luminances above do not depend on them
};

/// The same light as protan eyes see it. Luminances of light whose colour is not known are kept.
SignLook as_protan_eyes_see(SignLook look);

enum class SightVerdict { legible, visible, invisible, hidden, undecided, not_assessed };
inline constexpr size_t sight_verdicts = static_cast<size_t>(SightVerdict::not_assessed) + 1;
/// "visible but not legible", ...
const char* name_of(SightVerdict verdict);

struct Sight {
  SightVerdict verdict = SightVerdict::not_assessed;
  std::optional<Remark> reason;
  Uncertain reading_level;  // visibility level of the legend's smallest detail
  Uncertain
      seeing_level;  // of the whole face: of its pattern, or of its silhouette against the surround
  double extinction = 0;  // mean along the line of sight [1/m]
  double jin_m = 0;       // legible distance by Jin's law
  bool jin_legible = false;
  bool stings =
      false;  // irritant smoke makes reading impossible at this distance, whatever the light
  ViewingDistance viewing;        // distance by the code's rule
  double sure_errors = 2;         // as in SightRules
  double seen_from = level_seen;  // the level from which the face is seen
};

struct SightRules {
  Eye eye;
  bool irritant_smoke = false;
  /// Distance of a value from its limit at which a verdict is given, in standard errors.
  double sure_errors = 2;
  /// People do not know where the sign is: see unknown_place_contrast.
  bool place_unknown = false;

  double seen_from() const;
};

/// How many times the contrast of a sign of known place people need to find one of unknown place:
/// 0.05 to 0.10 instead of 0.01 to 0.02. T. Jin, Bulletin of the Fire Prevention Society of Japan
/// 22 (1972) 11-15, as quoted by pyFDS-Evac (documentation, "Visibility").
inline constexpr double unknown_place_contrast = 5;

inline double SightRules::seen_from() const {
  return level_seen * (place_unknown ? unknown_place_contrast : 1);
}

/// Requires: a view in which a face is turned to the eye.
Sight judge_sight(const Sign& sign, const SignView& view, const SignLook& look,
                  const SightRules& rules);

/// Distances along the line of sight within which a legend is read and a face is seen [m].
struct Reach {
  double read_m = 0, seen_m = 0;
};

/// As far as this look tells: with its luminances and the mean extinction of its line. Legend and
/// ground lose contrast by Beer's law; the ground and the veil before it keep their luminances.
/// Irritant smoke ends reading where judge_sight ends it.
Reach reach_of(const Sign& sign, const SignView& view, const SignLook& look,
               const SightRules& rules);

/// Mean extinction of the line from which irritant smoke makes reading impossible at the distance
/// of a view, whatever the light [1/m]; infinite if the smoke is not irritant.
double stinging_extinction(const Sign& sign, const SignView& view, const SightRules& rules);

/// Whether the sign is read, or the verdict is undecided and it may be read.
bool may_be_read(const Sight& sight);

/// Standard error of the difference of a view's reading levels in two lights, `other` minus
/// `first`, both of which were estimated from the same paths. `beyond`: what arrives in the other
/// light minus what arrives in the first, with the errors of that difference.
double error_of_level_beyond(const SignLook& first, const SignLook& other, const SignLook& beyond,
                             const SignView& view, const Eye& eye);

/// Whether verdict `a` counts rather than `b`, of two verdicts on one view in two lights: the worse
/// one counts. An undecided view counts as possibly invisible, unless the face is certainly seen;
/// then it is either legible or visible.
bool is_worse(const Sight& a, const Sight& b);

}  // namespace luxodus
