// Factors on the luminance or the size of signs at which they are just read and just seen.
#include <algorithm>
#include <cmath>
#include <functional>

#include "actors/judge/assess/sights_in_lights.hpp"
#include "actors/judge/thresholds/thresholds.hpp"
#include "scenes/light/signs/sign_light.hpp"

namespace luxodus {

namespace {

/// Factors between which thresholds are searched, and the ratio of neighbours on the way there.
struct FactorRange {
  double largest, ratio;
};
constexpr FactorRange luminances{1000, 1.1}, sizes{20, 1.05};
constexpr int halvings = 50;
/// Relative step by which the slope at a threshold is taken.
constexpr double slope_step = 0.01;

using PointAt = std::function<LevelPoint(double factor)>;

/// The first factor at which the limit is passed on the way from 1 to the end of the range, with
/// the error that follows from the level's.
std::optional<Crossing> nearest_crossing(const PointAt& at, const FactorRange& range) {
  const bool held = at(1).holds();
  // What is read stays so in brighter or larger signs, or is lost in darker or smaller ones.
  const double ratio = held ? 1 / range.ratio : range.ratio;
  double before = 1, behind = ratio;
  while (at(behind).holds() == held) {
    before = behind;
    behind *= ratio;
    if (behind > range.largest || behind < 1 / range.largest) return std::nullopt;
  }
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(before * behind);
    (at(middle).holds() == held ? before : behind) = middle;
  }
  const double slope =
      (at(behind * (1 + slope_step)).excess - at(behind / (1 + slope_step)).excess) /
      (2 * std::log1p(slope_step));
  const double error = std::abs(slope) > 0 ? at(behind).error / std::abs(slope) : 0;
  return Crossing{{behind, behind * error}, true};
}

/// What a factor is of a sign.
QuantityRecord amount_of(const ThresholdSearch& search, Sought sought, const Sign& sign,
                         double factor) {
  if (sought == Sought::size) return {1000 * factor * sign.smallest_detail_m, "mm"};
  const auto luminance = [&](ColourIndex colour) {
    return sign_luminance(sign, colour, search.scenario.operation,
                          search.assessed.state.seconds_after_failure.value_or(0), 1);
  };
  const double brighter = std::max(luminance(sign.face.legend), luminance(sign.face.ground));
  return {factor * brighter, "cd/m2"};
}

void add_records(const ThresholdSearch& search, const SightsInLights& sights, size_t number,
                 Sought sought, ThresholdRows& out) {
  const SightRow& row = sights.rows(0)[number];
  const Sign& sign = sign_of(search.scene, row);
  const auto eyes = eyes_of(search.scene);
  const bool own_light = sign.lighting != SignLighting::external;
  const bool searched = !sights_of(row).empty() && (sought == Sought::size || own_light) &&
                        !sights.sights_if(number, {}).empty();
  for (size_t e = 0; e < eyes.size(); ++e)
    for (const bool read : {true, false}) {
      ThresholdRecord& record = out.emplace_back(record_for(sought, row, eyes[e], read));
      if (!searched) continue;
      const PointAt at = [&](double factor) {
        SignsChanged changed;
        (sought == Sought::size ? changed.size : changed.luminance) = factor;
        return point_of(factor, sights.sights_if(number, changed)[e], read);
      };
      const auto found = nearest_crossing(at, sought == Sought::size ? sizes : luminances);
      record.end = found           ? ThresholdEnd::found
                   : at(1).holds() ? ThresholdEnd::everywhere
                                   : ThresholdEnd::nowhere;
      if (!found) continue;
      record.at = value_of(*found);
      record.above = found->above;
      record.amounts_to = amount_of(search, sought, sign, found->at.value);
    }
}

}  // namespace

Result<ThresholdRows> find_faces(const ThresholdSearch& search, const std::vector<Sought>& sought) {
  const auto judged = judged_with_signs_apart(search.scene, search.scenario);
  if (!judged) return judged.problem();
  AssessOptions options = search.options;
  options.enough = known_enough;
  SightsInLights sights(judged.value(), search.scene.observers, {}, options);
  if (auto ok = sights.look_for_lines(search.progress); !ok) return ok.problem();
  for (int round = 0; round < threshold_rounds && sights.is_open(0); ++round)
    if (auto ok = sights.trace(round, {true, false}, search.interrupt, search.progress); !ok)
      return ok.problem();
  ThresholdRows out;
  for (const Sought one : sought)
    for (size_t row = 0; row < sights.rows(0).size(); ++row)
      add_records(search, sights, row, one, out);
  return out;
}

}  // namespace luxodus
