// What an eye can tell apart: the threshold of luminance differences by size, background, age and
// time (Adrian 1989, as in IESNA RP-8). Photopic, since reading is foveal. Pure functions; any
// thread. The veil of glare that is added to the background: veil.hpp.
#pragma once

namespace luxodus {

namespace limits {
/// Ages that the threshold's data covers [years].
inline constexpr double min_age = 23, max_age = 75;
}  // namespace limits

struct Eye {
  double age_years = 65;
  double exposure_s = 2;  // how long it looks; from 2 s on more time helps no further
};

/// By how much an eye's threshold exceeds that of one of 23 years. Requires: an age within limits.
double age_factor(double age_years);

/// Difference of luminance [cd/m2] that is seen in 99.9 of 100 cases: of a disc of this diameter
/// on this background. `darker`: the disc is. Requires: size > 0, background >= 0.
double luminance_threshold(double background_cd_m2, double size_arcmin, bool darker,
                           const Eye& eye);

/// The difference between target and background over its threshold; 1 is just seen, 7 is read
/// (the design value for recognition of detail).
double visibility_level(double target_cd_m2, double background_cd_m2, double size_arcmin,
                        const Eye& eye);
inline constexpr double level_seen = 1, level_read = 7;

}  // namespace luxodus
