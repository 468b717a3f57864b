#include "scenes/emergency/adaptation.hpp"

#include <cmath>
#include <numbers>

namespace luxodus {

namespace {

/// Scotopic over photopic luminance of light that looks white, as of daylight. Lamps have less, so
/// rods are taken as bleached more than they are.
constexpr double scotopic_of_white = 2.26;
/// Retinal illuminance at which half of the rhodopsin is bleached [scotopic td] (Colour and Vision
/// Research Laboratory, "Bleaching").
const double half_bleach_td = std::pow(10, 4.4);
/// Regeneration, limited by the rate at which 11-cis retinal arrives: rate after a complete bleach
/// [1/s], and the bleached share at which the limit is half reached (Lamb and Pugh 2004). The tail
/// falls by 0.24 in log10 per minute, as the thresholds of people do.
constexpr double full_rate = 0.09 / 60, half_limited_at = 0.2;
/// Share of bleached rhodopsin at which rods and cones are equally sensitive: what is left 12 min
/// after a complete bleach, where curves of dark adaptation have their break.
constexpr double rods_as_cones_share = 0.12;
/// Background [cd/m2] below which cones gain nothing from more darkness: where mesopic vision ends
/// (CIE 191:2010).
constexpr double dark_of_cones_cd_m2 = 0.005;

/// Area of the pupil [mm2] of an eye adapted to a view of 60 degrees across (Stanley and Davies
/// 1995).
double pupil_mm2(double luminance_cd_m2) {
  constexpr double view_deg2 = std::numbers::pi * 30 * 30;
  const double f = std::pow(luminance_cd_m2 * view_deg2 / 846, 0.41);
  const double diameter = 7.75 - 5.75 * f / (f + 2);
  return std::numbers::pi / 4 * diameter * diameter;
}

/// Share that is left of a bleached share: the solution of
/// b + K ln b = b0 + K ln b0 - rate (1 + K) t, by Newton's method in ln b, where the left side is
/// convex: from the right the steps never pass the solution.
double share_left(double bleached, double seconds) {
  if (!(bleached > 0)) return 0;
  const double k = half_limited_at;
  const double right = bleached + k * std::log(bleached) - full_rate * (1 + k) * seconds;
  double x = std::log(bleached);
  for (int step = 0; step < 60; ++step) {
    const double change = (std::exp(x) + k * x - right) / (std::exp(x) + k);
    x -= change;
    if (std::abs(change) < 1e-12) break;
  }
  return std::exp(x);
}

}  // namespace

double bleached_rhodopsin(double before_cd_m2, double seconds) {
  const double scotopic_td = scotopic_of_white * before_cd_m2 * pupil_mm2(before_cd_m2);
  return share_left(scotopic_td / (scotopic_td + half_bleach_td), seconds);
}

double equivalent_background(double before_cd_m2, double seconds) {
  return dark_of_cones_cd_m2 * bleached_rhodopsin(before_cd_m2, seconds) / rods_as_cones_share;
}

}  // namespace luxodus
