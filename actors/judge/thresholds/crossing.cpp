#include "actors/judge/thresholds/crossing.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

/// Stands for a level of 0, whose logarithm is not finite.
constexpr double least_level = 1e-12;
/// Points farther from the limit do not bend the curve there: their levels lie in another regime,
/// or in their noise.
constexpr double near_excess = 6;

/// The bracket of a crossing and its neighbours, if they bend the curve there; else null.
struct Bracket {
  const LevelPoint &a, &b;
  const LevelPoint *before, *after;
};

double slope_between(const LevelPoint& a, const LevelPoint& b) {
  return (b.excess - a.excess) / (b.at - a.at);
}

/// The step from the crossing of the straight line to that of the parabola through a third point.
double bend(const Bracket& bracket, double linear) {
  const auto& [a, b, before, after] = bracket;
  const LevelPoint* third = before;
  if (before == nullptr || (after != nullptr && after->at - b.at < a.at - before->at))
    third = after;
  if (third == nullptr) return 0;
  const double slope = slope_between(a, b);
  const double curvature = (slope_between(b, *third) - slope) / (third->at - a.at);
  return -curvature * (linear - a.at) * (linear - b.at) / slope;
}

/// Standard error of the interpolation. Where the curve has a kink, as at the edge of a layer, the
/// crossing lies on one of the lines that its neighbours continue; how far those are away is taken
/// for the half width of a uniform distribution.
double error_of_interpolation(const Bracket& bracket, double at) {
  const auto& [a, b, before, after] = bracket;
  double farthest = 0;
  const auto consider = [&](const LevelPoint& end, const LevelPoint& neighbour) {
    const auto crosses = line_crosses(end, neighbour);
    if (crosses) farthest = std::max(farthest, std::abs(std::clamp(*crosses, a.at, b.at) - at));
  };
  if (before != nullptr) consider(a, *before);
  if (after != nullptr) consider(b, *after);
  return farthest / std::sqrt(3.0);
}

/// Requires: a bracket whose points are on different sides of the limit.
Crossing crossing_in(const Bracket& bracket) {
  const auto& [a, b, before, after] = bracket;
  const double width = b.at - a.at;
  if (!a.possible || !b.possible) return {{(a.at + b.at) / 2, width / std::sqrt(12.0)}, b.holds()};
  const double share = a.excess / (a.excess - b.excess);
  const double linear = a.at + share * width;
  const double noise =
      std::hypot((1 - share) * a.error, share * b.error) * width / std::abs(b.excess - a.excess);
  const double at = std::clamp(linear + bend(bracket, linear), a.at, b.at);
  return {{at, std::hypot(noise, error_of_interpolation(bracket, at))}, b.holds()};
}

}  // namespace

LevelPoint level_point(double at, const Uncertain& level, double limit) {
  const double value = std::max(level.value, least_level);
  return {at, std::log(value / limit), level.error / value, true};
}

LevelPoint impossible_point(double at) {
  return {at, std::log(least_level), 0, false};
}

std::vector<Crossing> crossings(const std::vector<LevelPoint>& points) {
  const auto neighbour = [&](size_t i) {  // also one below 0, which wraps round
    const bool bends =
        i < points.size() && points[i].possible && std::abs(points[i].excess) < near_excess;
    return bends ? &points[i] : nullptr;
  };
  std::vector<Crossing> out;
  for (size_t i = 0; i + 1 < points.size(); ++i)
    if (points[i].holds() != points[i + 1].holds())
      out.push_back(crossing_in({points[i], points[i + 1], neighbour(i - 1), neighbour(i + 2)}));
  return out;
}

std::optional<double> line_crosses(const LevelPoint& a, const LevelPoint& b) {
  const double slope = slope_between(a, b);
  if (!(std::abs(slope) > 0)) return std::nullopt;
  return a.at - a.excess / slope;
}

}  // namespace luxodus
