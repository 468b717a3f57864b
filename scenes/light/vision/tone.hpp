// Tone reproduction: from the light of a picture (XYZ, cd/m2) to a monitor's bytes. `plain` is a
// camera: one exposure, one shoulder. `human` shows what an adapted eye could distinguish:
// histogram adjustment with human contrast limits (Ward Larson, Rushmeier and Piatko, "A visibility
// matching tone reproduction operator for high dynamic range scenes", IEEE TVCG 3(4), 1997), their
// glare and loss of acuity in the dark, and the loss of colour at low light (CIE 191). For display
// only: signs are judged from luminance data. Pure functions; any thread.
#pragma once

#include <optional>
#include <vector>

#include "scenes/light/vision/picture.hpp"

namespace luxodus {

// ---- plain --------------------------------------------------------------------------------------

struct PlainTone {
  /// Luminance of white light that is shown as white [cd/m2]: the picture is linear below it and
  /// burns out above it. Pictures with equal white can be compared. If absent, the picture's own
  /// log-average sets the exposure.
  std::optional<double> white_cd_m2;
  /// Display value of the log-average luminance (middle grey), when no white is given.
  double key = 0.18;
};

/// Display luminance (0 black, 1 white) for an exposed luminance: linear up to the knee, then a
/// hyperbola that leaves the knee with slope 1 and reaches 1 at `white` (white >= 1; at white == 1
/// it stays straight).
double shoulder(double exposed, double white);
inline constexpr double shoulder_knee = 0.7;

/// Pixels that are not finite or not positive are black. A colour too bright for the monitor keeps
/// hue and saturation and loses luminance: only white light burns out to white. A colour too
/// saturated keeps hue and luminance. Requires: xyz.size() == 3 * width * height.
SrgbPicture tone_plain(const XyzPicture& picture, const PlainTone& tone);

// ---- human --------------------------------------------------------------------------------------

/// The monitor: luminance of its white, and of its black with the room's light reflected in it
/// [cd/m2].
struct MonitorModel {
  double white_cd_m2 = 200;
  double black_cd_m2 = 1;
};

struct HumanTone {
  MonitorModel monitor;
  /// Angle of view of one pixel in the middle [degrees]: adaptation is taken over 1 degree, the
  /// size of the fovea. 0: unknown; then there is neither glare nor loss of acuity.
  double degrees_per_pixel = 0.1;
  bool glare = true;        // veil from light scattered within the eye
  bool lose_colour = true;  // desaturate by mesopic and scotopic adaptation
  bool lose_acuity = true;  // blur details that an eye so dark-adapted does not resolve
};

/// Highest grating frequency that an eye adapted to this luminance [cd/m2] resolves [cycles per
/// degree]: Shlaer 1937, as fitted by Ward Larson et al. 1997, eq. 15.
double visual_acuity_cycles_per_degree(double adaptation_cd_m2);

/// Smallest difference [cd/m2] that an eye adapted to this luminance [cd/m2] sees: Ferwerda et al.
/// 1996, lower envelope of rods and cones, as stated in Ward Larson et al. 1997, table 1.
double threshold_difference_cd_m2(double adaptation_cd_m2);

/// World luminance to display luminance: monotone, piecewise linear in logarithms.
struct ToneCurve {
  std::vector<double> log_world;    // ascending, natural logarithms of cd/m2
  std::vector<double> log_display;  // ascending
  bool linear = false;              // the scene fits the display: one factor for all
  double factor = 1;                // display over world luminance when linear
  double display_white_cd_m2 = 0;

  /// Display luminance [cd/m2], at most the display's white. 0 for light of 0.
  double display(double world_cd_m2) const;
};

/// The curve for a scene with these adaptation luminances (one per degree of view). At no luminance
/// does it show more contrast than an eye in the scene could see.
ToneCurve human_curve(const std::vector<double>& adaptation_cd_m2, const MonitorModel& monitor);

/// Requires: xyz.size() == 3 * width * height; scotopic empty or width * height long.
SrgbPicture tone_human(const XyzPicture& picture, const HumanTone& tone);

}  // namespace luxodus
