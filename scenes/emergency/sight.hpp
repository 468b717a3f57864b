// Threshold of luminance difference of the eye by size, background luminance, age and time (Adrian
// 1989, as in IESNA RP-8). Photopic, since people read with the fovea. Disability glare, which is
// added to the background, is computed elsewhere (veil.hpp). Pure functions; any thread.
#pragma once

namespace luxodus {

namespace limits {
/// Range of ages of the data behind the threshold [years].
inline constexpr double min_age = 23, max_age = 75;
}  // namespace limits

struct Eye {
  double age_years = 65;
  double exposure_s = 2;  // time of looking; more than 2 s do not help further
  /// Equivalent background of pigment that earlier light has bleached [cd/m2] (adaptation.hpp): it
  /// raises the threshold as if it lay on the background.
  double bleached_cd_m2 = 0;
};

/// Ratio of the threshold of an eye to that of an eye of 23 years. Requires: an age within limits.
double age_factor(double age_years);

/// Luminance difference [cd/m2] at which a disc of this diameter on this background is detected in
/// 99.9 % of cases. `darker`: the disc is darker than the background. Requires: size > 0,
/// background >= 0.
double luminance_threshold(double background_cd_m2, double size_arcmin, bool darker,
                           const Eye& eye);

/// Luminance difference of target and background divided by the threshold: at 1 a target is just
/// seen, at 7 it is read (the design value for recognition of detail).
double visibility_level(double target_cd_m2, double background_cd_m2, double size_arcmin,
                        const Eye& eye);
inline constexpr double level_seen = 1, level_read = 7;

}  // namespace luxodus
