#include "scenes/light/vision/mesopic.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {
namespace {

// V'(555 nm): ratio of the two luminous efficacies, which puts both luminances on one scale at 555
// nm.
constexpr double scotopic_at_555 = 683.0 / 1699.0;
// CIE 191: m = a + b log10(L_mes), which is 1 at 5 cd/m2 and 0 at 0.005 cd/m2 to rounding.
constexpr double offset = 0.7670;
constexpr double slope = 0.3334;
// The published start value. Strong red light with nearly no scotopic part has several fixed
// points; the start value selects the one that the recommendation means.
constexpr double first_adaptation = 0.5;
constexpr int max_steps = 500;
constexpr double settled = 1e-12;

double usable(double v) {
  return v > 0 && std::isfinite(v) ? v : 0;
}

}  // namespace

double mesopic_luminance_adapted(double photopic_cd_m2, double scotopic_cd_m2, double adaptation) {
  const double m = adaptation;
  return (m * usable(photopic_cd_m2) + (1 - m) * usable(scotopic_cd_m2) * scotopic_at_555) /
         (m + (1 - m) * scotopic_at_555);
}

MesopicLuminance mesopic_luminance(double photopic_cd_m2, double scotopic_cd_m2) {
  double m = first_adaptation;
  for (int step = 0; step < max_steps; ++step) {
    const double l = mesopic_luminance_adapted(photopic_cd_m2, scotopic_cd_m2, m);
    const double next = l > 0 ? std::clamp(offset + slope * std::log10(l), 0.0, 1.0) : 0.0;
    const bool done = std::abs(next - m) < settled;
    m = next;
    if (done) break;
  }
  return {mesopic_luminance_adapted(photopic_cd_m2, scotopic_cd_m2, m), m};
}

double scotopic_from_xyz(double x, double y, double z) {
  y = usable(y);
  if (!(x > 0)) return 2.3 * y;  // the ratio of white light, for lack of a better estimate
  const double ratio = 1.33 * (1 + (y + usable(z)) / x) - 1.68;
  return y * std::clamp(ratio, 0.0, 10.0);
}

}  // namespace luxodus
