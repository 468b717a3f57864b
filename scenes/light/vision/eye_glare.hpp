// Glare in a picture: light scattered within the eye adds a veil to its surroundings. After Ward
// Larson, Rushmeier and Piatko 1997, section 5.1, based on Moon and Spencer 1945 (Holladay's law).
// Pure functions; any thread. Verdicts on signs use another law, from luminance data
// (scenes/emergency).
#pragma once

#include "scenes/light/vision/picture.hpp"

namespace luxodus {

/// Share of an eye's light at a place that is scattered from elsewhere in the view; the rest,
/// 0.913, comes from the line of sight.
inline constexpr double veil_share = 0.087;

/// The picture with the veil of each place: 0.913 of its own light, and 0.087 of the mean over all
/// other degrees of view, weighted by cos(a) / a^2 for the angle a between both. A uniform picture
/// does not change. Light beyond the picture's edges is taken to be as within. `degrees_per_pixel`
/// holds in the middle of a perspective picture. Requires: degrees_per_pixel > 0; xyz.size() == 3 *
/// width * height; scotopic empty or width * height long.
XyzPicture with_eye_glare(const XyzPicture& picture, double degrees_per_pixel);

}  // namespace luxodus
