// The laws of visibility in smoke that fire engineers use, to be printed beside what the tracer
// finds: Jin's V = C / K, Jin and Yamada's for smoke that stings, and the line-of-sight method.
// They know a sign's kind and the mean extinction alone: neither its size nor the light in the
// smoke. Pure functions; any thread.
#pragma once

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Jin's constant as engineers take it: 8 for signs with light of their own, 3 for others.
double jin_constant(SignLighting lighting);

/// How far a sign is legible [m]; infinite without smoke. `extinction` [1/m], >= 0.
double jin_distance_m(double constant, double extinction);

/// From here on irritant smoke takes more than its extinction does [1/m] (Jin and Yamada 1985).
inline constexpr double irritant_from = 0.25;

/// How far a sign is legible to eyes that sting [m]: C/K (0.133 - 1.47 lg K) from 0.25/m on, never
/// below 0; Jin's distance below.
double irritant_distance_m(double constant, double extinction);

/// What the line-of-sight method takes where smoke is thin [m]: the limit of FDS's VISIBILITY.
inline constexpr double farthest_visibility_m = 30;

/// How far the line-of-sight method has a sign seen [m]: the smaller of C/K and 30 m, times the
/// cosine of the angle of view (Boerger, Belt and Arnold, Fire Safety Journal 150, 2024, 104269:
/// the program FDSVismap). `extinction`: mean on the level line of sight [1/m], >= 0.
double line_of_sight_distance_m(double constant, double extinction, double cosine);

}  // namespace luxodus
