// Glare of the eye in a picture: light that scatters within the eye veils what is seen beside it.
// After Ward Larson, Rushmeier and Piatko 1997, section 5.1, who take it from Moon and Spencer 1945
// (Holladay's law). Pure functions; any thread. Verdicts on signs use another law, from luminance
// data (scenes/emergency).
#pragma once

#include "scenes/light/vision/picture.hpp"

namespace luxodus {

/// Share of what an eye receives at a place that comes from elsewhere in the view; the rest, 0.913,
/// comes from where it looks.
inline constexpr double veil_share = 0.087;

/// The picture with the veil of each place: 0.913 of its own light, and 0.087 of the mean over all
/// other degrees of view, weighted by cos(a) / a^2, where a is the angle between both. An even
/// picture stays as it is. Light from beyond the picture's edges is taken to be as within.
/// `degrees_per_pixel`: in the middle of a perspective picture. Requires: degrees_per_pixel > 0;
/// xyz.size() == 3 * width * height; scotopic empty or width * height long.
XyzPicture with_eye_glare(const XyzPicture& picture, double degrees_per_pixel);

}  // namespace luxodus
