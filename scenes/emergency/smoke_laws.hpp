// Laws of visibility in smoke that fire engineers use: Jin's V = C / K, that of Jin and Yamada for
// irritant smoke, and the line-of-sight method. They are printed beside the traced verdict. They
// depend on the kind of the sign and the mean extinction only, not on the sign's size or the light
// in the smoke. Pure functions; any thread.
#pragma once

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Jin's constant as used by engineers: 8 for signs with light of their own, 3 for others.
double jin_constant(SignLighting lighting);

/// Distance at which a sign is legible [m]; infinite without smoke. `extinction` [1/m], >= 0.
double jin_distance_m(double constant, double extinction);

/// Extinction from which irritant smoke shortens the distance further [1/m] (Jin and Yamada 1985).
inline constexpr double irritant_from = 0.25;

/// Distance at which irritated eyes read a sign [m]: C/K (0.133 - 1.47 lg K) from 0.25/m on, at
/// least 0; below 0.25/m Jin's distance.
double irritant_distance_m(double constant, double extinction);

/// Largest distance of the line-of-sight method [m]: the limit of FDS's VISIBILITY.
inline constexpr double farthest_visibility_m = 30;

/// Distance at which a sign is seen by the line-of-sight method [m]: the smaller of C/K and 30 m,
/// times the cosine of the angle of view (Boerger, Belt and Arnold, Fire Safety Journal 150, 2024,
/// 104269: the program FDSVismap). `extinction`: mean along the horizontal line of sight [1/m], >=
/// 0.
double line_of_sight_distance_m(double constant, double extinction, double cosine);

}  // namespace luxodus
