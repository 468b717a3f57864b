// Regula falsi of Illinois on the logarithm of the level: by the law of Beer it falls linearly with
// the optical depth, so that few steps are needed, and the bracket keeps noise from leading astray.
#include "actors/judge/validate/threshold.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace luxodus::light {

namespace {

/// Stands for a level of 0, whose logarithm is not finite.
constexpr double least_level = 1e-12;
/// Points nearer than this many tolerances give no slope: their difference is noise.
constexpr double wide_steps = 20;

}  // namespace

Result<ThresholdFinder::Point> ThresholdFinder::point(double varied, double limit) {
  auto at = known_.find(varied);
  if (at == known_.end()) {
    const auto level = level_(varied);
    if (!level) return level.problem();
    at = known_.emplace(varied, level.value()).first;
  }
  const double level = std::max(at->second.value, least_level);
  return Point{varied, std::log(level / limit), at->second.error / level};
}

Result<Crossing> ThresholdFinder::crossing(double limit) {
  const auto low = point(searched_.low, limit), high = point(searched_.high, limit);
  if (!low) return low.problem();
  if (!high) return high.problem();
  if ((low->excess > 0) == (high->excess > 0)) return Crossing{std::nullopt, low->excess > 0};
  Point a = low.value(), b = high.value();
  Point best = std::abs(a.excess) < std::abs(b.excess) ? a : b;
  double weight_a = a.excess, weight_b = b.excess;
  double slope = (b.excess - a.excess) / (b.varied - a.varied);
  enum class Moved { neither, left, right } moved = Moved::neither;
  for (int step = 0; step < limits::threshold_steps; ++step) {
    if (std::abs(best.excess) <= tolerance_ * std::abs(slope)) break;
    if (b.varied - a.varied <= tolerance_) break;
    const double guess = (a.varied * weight_b - b.varied * weight_a) / (weight_b - weight_a);
    const auto tried = point(guess, limit);
    if (!tried) return tried.problem();
    const bool left = (tried->excess > 0) == (a.excess > 0);
    const Point& other = left ? b : a;
    slope = (tried->excess - other.excess) / (tried->varied - other.varied);
    best = tried.value();
    // The weight of an end that stays twice is halved, so that the other end moves, too.
    (left ? a : b) = best;
    (left ? weight_a : weight_b) = best.excess;
    if (left && moved == Moved::left) weight_b /= 2;
    if (!left && moved == Moved::right) weight_a /= 2;
    moved = left ? Moved::left : Moved::right;
  }
  slope = slope_at(best, limit).value_or(slope);
  const double error = slope != 0 ? best.error / std::abs(slope) : 0;
  return Crossing{Uncertain{best.varied, error}, false, slope};
}

std::optional<double> ThresholdFinder::slope_at(const Point& place, double limit) const {
  const double apart = wide_steps * tolerance_;
  std::optional<double> slope;
  double nearest = unlimited;
  for (const auto& [varied, level] : known_) {
    const double distance = std::abs(varied - place.varied);
    if (distance < apart || distance >= nearest) continue;
    nearest = distance;
    const double excess = std::log(std::max(level.value, least_level) / limit);
    slope = (excess - place.excess) / (varied - place.varied);
  }
  return slope;
}

Crossing refined(const Crossing& crossing, double limit, std::span<const Uncertain> others) {
  if (crossing.slope == 0 || others.empty()) return crossing;
  std::vector<double> places{crossing.at->value};
  for (const Uncertain& level : others)
    places.push_back(crossing.at->value -
                     std::log(std::max(level.value, least_level) / limit) / crossing.slope);
  const auto n = static_cast<double>(places.size());
  double mean = 0, squares = 0;
  for (const double place : places) mean += place / n;
  for (const double place : places) squares += (place - mean) * (place - mean);
  const double scatter = std::sqrt(squares / (n * (n - 1)));
  Crossing out = crossing;
  out.at = Uncertain{mean, std::max(scatter, crossing.at->error / std::sqrt(n))};
  return out;
}

}  // namespace luxodus::light
