// Tone reproduction: from the light of a picture (XYZ, cd/m2) to a monitor's bytes. `plain` is a
// camera: one exposure, one shoulder. `human` shows what an adapted eye could distinguish:
// histogram adjustment with human contrast limits (Ward Larson, Rushmeier and Piatko, "A visibility
// matching tone reproduction operator for high dynamic range scenes", IEEE TVCG 3(4), 1997), their
// glare and loss of acuity in the dark, and the loss of colour at low light (CIE 191). For display
// only: signs are judged from luminance data. Pure functions; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/light/vision/picture.hpp"

namespace luxodus {

// ---- plain --------------------------------------------------------------------------------------

/// The brightest face of a sign is shown no brighter than this, so that lamps stay brighter.
inline constexpr double sign_level = 0.8;

/// Display luminance (0 black, 1 white) of a luminance: monotone, with a continuous slope. As it
/// stands, a luminance of 1 is white, and all below is linear.
struct CameraCurve {
  /// Least slope in logarithms up to the knee: a ratio r of luminances is shown as at least r to
  /// this power. Legends need 0.4; the rest is for rounding to bytes.
  static constexpr double least_slope = 0.45;

  double factor = 1;  // exposed value per cd/m2
  double bend = 0;  // one over the exposed value where the slope is halfway; 0: linear to the knee
  double knee = 0.7;  // exposed value where the shoulder begins; it reaches 1 at `white`
  double white = 1;   // exposed value, >= knee
  bool film = false;  // film_contrast() of what would be shown

  double shown(double cd_m2) const;
  /// Display value of an exposed one up to the knee, and its derivative.
  double bent(double exposed) const;
  double slope_at(double exposed) const;
  /// Display value of an exposed one, without the contrast of film. Requires: exposed > 0.
  double neutral(double exposed) const;
};

/// A display value with the contrast of photographic film: deeper shadows (a toe), slightly lifted
/// middle tones. It keeps sign_level and what is brighter; below, its slope in logarithms is at
/// least 0.93, so legends keep their contrast.
double film_contrast(double shown);

/// Linear up to a knee, with a shoulder to `white_cd_m2`, if that shows a sign of this luminance at
/// no more than sign_level. Otherwise all is compressed until it does, and the shoulder begins at
/// the sign.
CameraCurve camera_curve(double factor, double white_cd_m2, double sign_cd_m2);

/// What a camera is set for [cd/m2]. Pictures of equal exposure can be compared.
struct Exposure {
  /// Display value of `grey_cd_m2` where no sign is much brighter.
  static constexpr double middle_grey = 0.18;

  double grey_cd_m2 = middle_grey;
  double white_cd_m2 = 1;
  double sign_cd_m2 = 0;  // brightest face of a sign, or steady flame; 0: none

  CameraCurve curve() const {
    return camera_curve(middle_grey / grey_cd_m2, white_cd_m2, sign_cd_m2);
  }
};

/// What the exposure of one picture, or of several together, follows from. Middle grey is the
/// log-average luminance, over the largest luminance that a monitor shows of the colours in view.
/// White and sign are the brightest of any picture.
struct LightMeter {
  double pixels = 0;           // with light
  double log_luminance = 0;    // summed over them
  double brightest_shown = 0;  // the same
  double white_cd_m2 = 0;      // one pixel in a thousand of a picture exceeds it
  double sign_cd_m2 = 0;       // brightest face of a sign, or steady flame

  void add(const LightMeter& other);
  Exposure exposure() const;
};

/// `sign_cd_m2`: the brightest face of a sign in the picture; 0: none.
LightMeter metered(const XyzPicture& picture, double sign_cd_m2);
/// The exposure of a picture of its own.
Exposure exposure_of(const XyzPicture& picture, double sign_cd_m2);

/// How a plain picture shows luminances beyond its exposure.
enum class ToneStyle : uint8_t {
  neutral,  // linear but for what the monitor cannot show
  film,     // film_contrast
};

/// Pixels that are not finite or not positive are black. Luminance alone decides how bright a pixel
/// is; a colour that the monitor cannot show so bright loses saturation (display_colour).
/// Requires: xyz.size() == 3 * width * height.
SrgbPicture tone_plain(const XyzPicture& picture, const CameraCurve& curve);

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
  /// Luminance of the brightest face of a sign in the picture [cd/m2]; 0: none.
  double sign_cd_m2 = 0;
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

  /// Display luminance [cd/m2]; where the curve is linear it may exceed the display's white. 0 for
  /// light of 0.
  double display(double world_cd_m2) const;
};

/// The curve for a scene with these adaptation luminances (one per degree of view). At no luminance
/// does it show more contrast than an eye in the scene could see.
ToneCurve human_curve(const std::vector<double>& adaptation_cd_m2, const MonitorModel& monitor);

/// Mesopic luminance, after glare and blur, decides how bright a pixel is. What exceeds the
/// monitor's white is compressed as by a camera (camera_curve).
/// Requires: xyz.size() == 3 * width * height; scotopic empty or width * height long.
SrgbPicture tone_human(const XyzPicture& picture, const HumanTone& tone);

}  // namespace luxodus
