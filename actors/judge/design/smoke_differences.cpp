#include "actors/judge/design/smoke_differences.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace luxodus {

namespace {

/// Share of a normal distribution that lies sure_errors_of_races below its mean.
constexpr double unsure_share = 0.02275;

double normal_below(double a) {
  return std::erfc(-a / std::numbers::sqrt2) / 2;
}

/// Distance of the limit for reading above the level of a view, in standard errors; none if its
/// verdict is certain.
std::optional<double> open_distance(const SightRow& row) {
  if (!may_be_read(row) || row.sight.verdict == SightVerdict::legible) return std::nullopt;
  const Uncertain& level = row.sight.reading_level;
  return (level_read - level.value) / level.error;
}

/// Probabilities that a sign is not read.
struct Unread {
  double first = 1, other = 1, both = 1;
};

/// One view with both layouts. Without `error` the two are independent, since different paths
/// decided them.
Unread unread(const SightRow& first, const SightRow& other, std::optional<double> error) {
  const auto a = open_distance(first), b = open_distance(other);
  const auto alone = [](const SightRow& row, const std::optional<double>& open) {
    if (open) return normal_below(*open);
    return row.sight.verdict == SightVerdict::legible ? 0.0 : 1.0;
  };
  Unread out{alone(first, a), alone(other, b), 0};
  out.both = out.first * out.other;
  if (!a || !b || !error) return out;
  const double x = first.sight.reading_level.error, y = other.sight.reading_level.error;
  const double correlation = std::clamp((x * x + y * y - *error * *error) / (2 * x * y), -1.0, 1.0);
  out.both = chance_below(*a, *b, correlation);
  return out;
}

/// A length of the routes, with the probabilities that the other layout wins or loses it.
struct OpenPlace {
  double length = 0, won = 0, lost = 0;
};

/// Logarithm of the mean of exp(-t times the length won).
double log_mean_exp(const std::vector<OpenPlace>& places, double t) {
  double out = 0;
  for (const OpenPlace& p : places)
    out += std::log1p(p.won * std::expm1(-t * p.length) + p.lost * std::expm1(t * p.length));
  return out;
}

/// Length that is certainly won: two standard errors below the mean, or less by Chernoff's bound
/// (Annals of Mathematical Statistics 23, 1952), which matters if few places decide.
double surely_won(const std::vector<OpenPlace>& places) {
  double mean = 0, variance = 0, longest = 0, all = 0;
  for (const OpenPlace& p : places) {
    const double expected = p.won - p.lost;
    const double chance = std::max(0.0, p.won + p.lost - expected * expected);
    mean += p.length * expected;
    variance += p.length * p.length * chance;
    if (chance > 0) longest = std::max(longest, p.length);
    all += p.length;
  }
  const double error = std::sqrt(variance);
  if (error >= longest) return mean - sure_errors_of_races * error;
  double out = -all;
  constexpr double finer = 1.1, largest = 20;
  for (double t = 1 / all; t < largest / longest; t *= finer)
    out = std::max(out, -(log_mean_exp(places, t) - std::log(unsure_share)) / t);
  return std::min(out, mean);
}

using UnreadPlaces = std::map<RoutePlace, Unread>;

RoutePlace place_of(const SightRow& row) {
  return {row.from, row.along_m, row.height_m};
}

/// A place is unread if none of its signs is read.
UnreadPlaces unread_by_the_same_paths(const std::vector<SightRow>& first,
                                      const std::vector<SightRow>& other,
                                      const ErrorOfDifference& error_of) {
  UnreadPlaces out;
  for (size_t row = 0; row < first.size(); ++row) {
    if (!is_ahead(first[row])) continue;
    const Unread view = unread(first[row], other[row], error_of(row));
    Unread& place = out[place_of(first[row])];
    place = {place.first * view.first, place.other * view.other, place.both * view.both};
  }
  return out;
}

UnreadPlaces unread_by_other_paths(const std::vector<SightRow>& first,
                                   const std::vector<SightRow>& other) {
  UnreadPlaces out;
  for (const SightRow& row : first)
    if (is_ahead(row)) out[place_of(row)].first *= unread(row, row, {}).first;
  for (const SightRow& row : other)
    if (is_ahead(row)) out[place_of(row)].other *= unread(row, row, {}).other;
  for (auto& [place, chances] : out) chances.both = chances.first * chances.other;
  return out;
}

}  // namespace

ShareDifference both_of(const ShareDifference& a, const ShareDifference& b) {
  return {std::max(a.least, b.least), std::min(a.most, b.most)};
}

ShareDifference chained(const ShareDifference& second, const ShareDifference& third) {
  return {third.least - second.most, third.most - second.least};
}

ShareDifference by_ranges(const LegibleShare& first, const LegibleShare& other) {
  return {other.least - first.most, other.most - first.least};
}

ShareDifference difference_of(const LayoutViews& first, const LayoutViews& other,
                              const ErrorOfDifference& error_of) {
  const UnreadPlaces unread = error_of ? unread_by_the_same_paths(first.rows, other.rows, error_of)
                                       : unread_by_other_paths(first.rows, other.rows);
  double length = 0;
  std::vector<OpenPlace> places;
  for (const auto& [place, seen] : first.places) {
    length += seen.stands_for;
    const auto at = unread.find(place);
    if (at == unread.end()) continue;
    const Unread& chances = at->second;
    places.push_back({seen.stands_for, std::max(0.0, chances.first - chances.both),
                      std::max(0.0, chances.other - chances.both)});
  }
  if (!(length > 0)) return {0, 0};
  const double least = surely_won(places);
  for (OpenPlace& place : places) std::swap(place.won, place.lost);
  const double most = -surely_won(places);
  const auto all = [](const RoutePlace&) { return true; };
  return both_of({least / length, most / length},
                 by_ranges(share_of(first.places, all), share_of(other.places, all)));
}

/// Plackett's formula (Biometrika 41, 1954): an integral over correlations up to this one.
/// Integrated over the arcsine of the correlation, in which the integrand is smooth.
double chance_below(double a, double b, double correlation) {
  const double of_a = normal_below(a), of_b = normal_below(b);
  constexpr double all_but_one = 1 - 1e-12;
  if (correlation > all_but_one) return std::min(of_a, of_b);
  if (correlation < -all_but_one) return std::max(0.0, of_a + of_b - 1);
  const double end = std::asin(correlation);
  const auto density = [&](double angle) {
    const double s = std::sin(angle);
    return std::exp((a * b * s - (a * a + b * b) / 2) / (1 - s * s)) / (2 * std::numbers::pi);
  };
  constexpr int steps = 400;  // of Simpson's rule; even
  double sum = density(0) + density(end);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * density(end * i / steps);
  return std::clamp(of_a * of_b + sum * end / steps / 3, 0.0, std::min(of_a, of_b));
}

}  // namespace luxodus
