// Illuminance below a point source scales with the square of the height: E drop^2 depends on
// u = distance / drop alone. So one profile p(u) for each side of a plane, sampled in equal steps
// of u, serves all heights, levels and factors.
//
// The distance to a wall ends at the first sample below the level. The distance between two
// luminaires ends at the first distance at which any point between them is below it: distances are
// whole numbers of steps n, and the points between are the steps i with p(i) + q(n - i). Both are
// then interpolated between two steps. Every smaller distance meets the level, too, so a dark ring
// ends the distance even where it is bright beyond.
#include "scenes/emergency/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxodus {

namespace {

/// Steps of u: 0.14 degrees straight down and less farther out, below the steps of measured tables.
/// At 40 drops, 1.4 degrees below the horizon, a luminaire would need 64 000 cd for 1 lx at 1 m.
constexpr double step = 0.0025;
constexpr double farthest = 40;
constexpr size_t steps = static_cast<size_t>(farthest / step) + 1;

using Profile = std::vector<double>;

Profile profile(const Intensity& intensity, double c_deg) {
  Profile out(steps);
  for (size_t i = 0; i < steps; ++i)
    out[i] = illuminance_beside(intensity, c_deg, 1, static_cast<double>(i) * step);
  return out;
}

/// Where a line from `before` (at least the level) to `after` (below it) meets the level, in steps.
double crossing(size_t before_step, double before, double after, double level) {
  return static_cast<double>(before_step) + (before - level) / (before - after);
}

/// Steps until the profile is first below the level; none if it begins below.
std::optional<double> reach(const Profile& p, double level) {
  if (p.front() < level) return std::nullopt;
  const auto below = std::find_if(p.begin(), p.end(), [&](double e) { return e < level; });
  if (below == p.end()) return static_cast<double>(p.size() - 1);
  const auto i = static_cast<size_t>(below - p.begin());
  return crossing(i - 1, p[i - 1], p[i], level);
}

/// Smallest sum at a point between two luminaires that are n steps apart.
double darkest_between(const Profile& p, const Profile& q, size_t n) {
  double least = p[0] + q[n];
  for (size_t i = 1; i <= n; ++i) least = std::min(least, p[i] + q[n - i]);
  return least;
}

/// Steps between two luminaires. Requires: one alone meets the level below it. Up to the reach of
/// one of them the distance need not be tried.
double apart(const Profile& p, const Profile& q, double level, double reach_steps) {
  auto n = static_cast<size_t>(reach_steps);
  double before = darkest_between(p, q, n);
  while (n + 1 < p.size()) {
    const double after = darkest_between(p, q, n + 1);
    if (after < level) return crossing(n, before, after, level);
    before = after;
    ++n;
  }
  return static_cast<double>(n);
}

/// The profiles of a plane, on its side C and on the opposite side.
struct Plane {
  Profile front, back;
  Plane(const Intensity& intensity, double c_deg)
      : front(profile(intensity, c_deg)), back(profile(intensity, c_deg + 180)) {}

  /// `level`: illuminance times the square of the drop, over the factor.
  std::optional<RowSpacing> spacing(double level, double drop_m) const {
    const auto ahead = reach(front, level), behind = reach(back, level);
    if (!ahead || !behind) return std::nullopt;
    const double metres = step * drop_m;
    return RowSpacing{std::min(*ahead, *behind) * metres,
                      apart(front, back, level, std::max(*ahead, *behind)) * metres};
  }
};

}  // namespace

double illuminance_beside(const Intensity& intensity, double c_deg, double drop_m,
                          double distance_m) {
  const double c = c_deg * std::numbers::pi / 180;
  const double r = std::hypot(distance_m, drop_m);
  const double sine = distance_m / r, cosine = drop_m / r;
  return intensity({sine * std::cos(c), sine * std::sin(c), -cosine}) * cosine / (r * r);
}

std::vector<SpacingRow> spacing_table(const Intensity& intensity, const SpacingRequest& request) {
  const Plane along(intensity, 0), across(intensity, 90);
  std::vector<SpacingRow> out;
  for (const double height : request.heights_m)
    for (const double factor : request.factors)
      for (const double level : request.levels_lx) {
        const double drop = height - request.plane_m;
        const double scaled = level * drop * drop / factor;
        out.push_back(
            {height, level, factor, along.spacing(scaled, drop), across.spacing(scaled, drop)});
      }
  return out;
}

}  // namespace luxodus
