// The estimate of a luminaire's light at a place in a gap is its intensity towards the place, times
// the cosine over the square of the distance, times a share that corners of the gap give: there the
// same formula is compared with the computed light, so the share holds shadows and near fields. The
// smallest share of the corners is taken for minima, the largest for maxima.
#include "actors/judge/assess/between_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "scenes/emergency/far_field.hpp"

namespace luxodus {

namespace {

/// Places in a gap are so far apart, as seen from a luminaire [rad]: two of them lie in a ring of 3
/// degrees, or in a beam of that width.
constexpr double place_angle = 1.5 * std::numbers::pi / 180;
constexpr int max_places = 16;
/// The search within a gap ends with steps of this share of it.
constexpr double finest_share = 1.0 / 256;
/// Gaps are looked into whose darkest corner is within this factor of the smallest illuminance.
constexpr double near_min = 1.25;
/// An estimate must be beyond the extreme by this share, or its place is not tried.
constexpr double gain_share = 1e-3;

/// An emergency luminaire, and the middle of its luminous opening.
struct Lamp {
  const Emitter* emitter = nullptr;
  glm::dvec3 centre{0};
};

/// Light of a luminaire at a place, up to a factor: on a surface that faces up.
double shape_of_light(const Lamp& lamp, const glm::dvec3& place) {
  const Emitter& e = *lamp.emitter;
  const glm::dvec3 way = place - lamp.centre;
  const double square = glm::dot(way, way);
  if (!(square > 0) || !(way.z < 0)) return 0;
  const double distance = std::sqrt(square);
  const glm::dvec3 direction = way / distance;
  const double cosine = -direction.z;
  double intensity = 1;  // of bodies whose intensity hardly varies within a gap
  switch (e.distribution) {
    case Distribution::web:
      intensity = intensity_per_lm(e, direction);
      break;
    case Distribution::spot: {
      const double along = std::clamp(-glm::dot(e.frame.axes[2], direction), -1.0, 1.0);
      intensity = spot_per_lm(e, std::acos(along) * 180 / std::numbers::pi);
      break;
    }
    case Distribution::collimated:
      return 0;
    case Distribution::isotropic:
    case Distribution::lambertian:
    case Distribution::cosine_power:
      if (e.shape != EmitterShape::tube && e.shape != EmitterShape::mesh)
        intensity = intensity_per_lm(e, direction);
      break;
  }
  return intensity * cosine / square;
}

/// An upper bound on shape_of_light within a gap.
double most_shape(const Lamp& lamp, const GridGap& gap) {
  const Emitter& e = *lamp.emitter;
  if (e.distribution != Distribution::web) return std::numeric_limits<double>::infinity();
  const glm::dvec3 side = 0.5 * (gap.along + gap.across);
  const glm::dvec3 middle = gap.from + side;
  const double radius =
      std::max(glm::length(side), 0.5 * glm::length(gap.along - gap.across)) + floor_plane_m;
  const double above = lamp.centre.z - middle.z + radius;
  const double nearest = glm::length(lamp.centre - middle) - radius;
  if (!(above > 0)) return 0;
  if (!(nearest > 0)) return std::numeric_limits<double>::infinity();
  return e.web->peak_cd() / e.web->flux_lm() * above / (nearest * nearest * nearest);
}

/// A luminaire that lights a corner of a gap, with the shares of its unhidden light at corners.
struct GapLuminaire {
  Lamp lamp;
  double factor = 1, least = std::numeric_limits<double>::infinity(), most = 0;
  double rest = 0;  // upper bound on the estimate of this one and those that follow in the gap
};

enum class Extreme { least, most };

/// The place in a gap with the smallest or largest estimate.
struct Guess {
  double lux = 0;
  glm::dvec3 place{0};
};

class GapSearch {
 public:
  GapSearch(const SceneDescription& scene, const CodeLight& light, const CalculationGrid& grid,
            const std::vector<LitPoint>& lit)
      : light_(light), grid_(grid), lit_(lit) {
    for (const uint32_t number : emergency_luminaires(scene))
      lamps_.push_back({&scene.emitters[number], centre_of(scene.emitters[number])});
    for (uint32_t i = 0; i < lamps_.size(); ++i)
      if (std::any_of(lit.begin(), lit.end(), [&](const LitPoint& p) { return p.lux[i] > 0; }))
        lighting_.push_back(i);
  }

  std::vector<LitPoint> found() && { return std::move(found_); }

  /// The places of the grid nearest to each luminaire and to where it aims.
  void look_below_luminaires();
  /// The middles of gaps beside the darkest points.
  void look_into_shadows(const LuminaireFactors& factors);
  void look_for(Extreme extreme, const LuminaireFactors& factors);

 private:
  std::vector<GapLuminaire> luminaires_of(const GridGap& gap,
                                          const LuminaireFactors& factors) const;
  Guess guess(const GridGap& gap, Extreme extreme, const LuminaireFactors& factors) const;
  static bool is_beyond(const std::vector<GapLuminaire>& luminaires, const glm::dvec3& place,
                        Extreme extreme, std::optional<double>& best);
  /// Computes the light at places outside bodies.
  void look_at(const std::vector<glm::dvec3>& places);
  double lux_of(const LitPoint& point, const LuminaireFactors& factors) const {
    return std::inner_product(point.lux.begin(), point.lux.end(), factors.begin(), 0.0);
  }
  double extreme_of(Extreme extreme, const LuminaireFactors& factors) const;

  const CodeLight& light_;
  const CalculationGrid& grid_;
  const std::vector<LitPoint>& lit_;
  std::vector<Lamp> lamps_;
  std::vector<uint32_t> lighting_;  // those of them that light any point of the grid
  std::vector<LitPoint> found_;
};

void GapSearch::look_at(const std::vector<glm::dvec3>& places) {
  for (LitPoint& point : light_.lit_off_bodies(places)) found_.push_back(std::move(point));
}

double GapSearch::extreme_of(Extreme extreme, const LuminaireFactors& factors) const {
  double out = extreme == Extreme::least ? std::numeric_limits<double>::infinity() : 0;
  for (const auto* points : {&lit_, &found_})
    for (const LitPoint& point : *points) {
      const double lux = lux_of(point, factors);
      out = extreme == Extreme::least ? std::min(out, lux) : std::max(out, lux);
    }
  return out;
}

std::vector<GapLuminaire> GapSearch::luminaires_of(const GridGap& gap,
                                                   const LuminaireFactors& factors) const {
  std::vector<GapLuminaire> out;
  for (const uint32_t i : lighting_) {
    if (!(factors[i] > 0)) continue;
    const bool lights = std::any_of(gap.corners.begin(), gap.corners.end(),
                                    [&](uint32_t corner) { return lit_[corner].lux[i] > 0; });
    if (!lights) continue;
    GapLuminaire one{lamps_[i], factors[i]};
    for (const uint32_t corner : gap.corners) {
      const double shape = shape_of_light(one.lamp, lit_[corner].place);
      if (!(shape > 0)) continue;  // outside its beam: nothing is known of shadows there
      one.least = std::min(one.least, lit_[corner].lux[i] / shape);
      one.most = std::max(one.most, lit_[corner].lux[i] / shape);
    }
    if (one.most > 0) out.push_back(one);
  }
  double rest = 0;
  for (auto one = out.rbegin(); one != out.rend(); ++one)
    one->rest = rest += one->factor * one->most * most_shape(one->lamp, gap);
  return out;
}

/// Whether the estimate at a place is beyond the best one, which it then becomes. Most places are
/// not, and known not to be before all luminaires are summed: their light is never negative, and
/// what the others add at most is known.
bool GapSearch::is_beyond(const std::vector<GapLuminaire>& luminaires, const glm::dvec3& place,
                          Extreme extreme, std::optional<double>& best) {
  constexpr double rounding = 1 + 1e-9;
  const bool least = extreme == Extreme::least;
  double lux = 0;
  for (const GapLuminaire& one : luminaires) {
    if (best && (least ? lux >= *best : rounding * (lux + one.rest) <= *best)) return false;
    lux += one.factor * (least ? one.least : one.most) * shape_of_light(one.lamp, place);
  }
  if (best && (least ? lux >= *best : lux <= *best)) return false;
  best = lux;
  return true;
}

Guess GapSearch::guess(const GridGap& gap, Extreme extreme, const LuminaireFactors& factors) const {
  const std::vector<GapLuminaire> luminaires = luminaires_of(gap, factors);
  const glm::dvec3 lift(0, 0, floor_plane_m);
  const auto at = [&](const glm::dvec2& uv) {
    return gap.from + gap.along * uv.x + gap.across * uv.y;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const GapLuminaire& one : luminaires)
    nearest = std::min(nearest, glm::length(one.lamp.centre - at({0.5, 0.5})));
  const auto count = [&](const glm::dvec3& side) {
    const double length = glm::length(side);
    if (!(length > 0) || !std::isfinite(nearest)) return 1;
    return std::clamp(static_cast<int>(std::ceil(length / (nearest * place_angle))), 2, max_places);
  };
  const int nu = count(gap.along), nv = count(gap.across);
  glm::dvec2 best(0.5);
  std::optional<double> best_lux;
  const auto offer = [&](const glm::dvec2& uv) {
    if (!is_beyond(luminaires, at(uv) + lift, extreme, best_lux)) return false;
    best = uv;
    return true;
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) offer({(i + 0.5) / nu, nv > 1 ? (j + 0.5) / nv : 0.0});
  // Pattern search around the best of these places.
  glm::dvec2 step(0.5 / nu, nv > 1 ? 0.5 / nv : 0.0);
  while (step.x > finest_share) {
    bool any = false;
    const glm::dvec2 centre = best;
    for (const double u : {-1.0, 0.0, 1.0})
      for (const double v : {-1.0, 0.0, 1.0})
        if (u != 0 || v != 0)
          any = offer(glm::clamp(centre + step * glm::dvec2(u, v), 0.0, 1.0)) || any;
    if (!any) step /= 2.0;
  }
  return {best_lux.value_or(0), at(best)};
}

void GapSearch::look_for(Extreme extreme, const LuminaireFactors& factors) {
  std::vector<Guess> guesses(grid_.gaps.size());
  light_.building().each(guesses.size(), [&](const GeometryAccess&, size_t i) {
    guesses[i] = guess(grid_.gaps[i], extreme, factors);
  });
  std::stable_sort(guesses.begin(), guesses.end(), [&](const Guess& a, const Guess& b) {
    return extreme == Extreme::least ? a.lux < b.lux : a.lux > b.lux;
  });
  constexpr size_t at_once = 8;
  for (size_t i = 0; i < std::min(guesses.size(), limits::extremes_tried); i += at_once) {
    const double known = extreme_of(extreme, factors);
    std::vector<glm::dvec3> places;
    for (size_t k = i; k < std::min(i + at_once, guesses.size()); ++k) {
      const bool gains = extreme == Extreme::least ? guesses[k].lux < known * (1 - gain_share)
                                                   : guesses[k].lux > known * (1 + gain_share);
      if (gains) places.push_back(guesses[k].place);
    }
    if (places.empty()) return;
    look_at(places);
  }
}

void GapSearch::look_into_shadows(const LuminaireFactors& factors) {
  std::vector<double> lux;
  for (const LitPoint& point : lit_) lux.push_back(lux_of(point, factors));
  const double limit = near_min * *std::min_element(lux.begin(), lux.end());
  std::vector<std::pair<double, const GridGap*>> dark;
  for (const GridGap& gap : grid_.gaps) {
    double least = std::numeric_limits<double>::infinity();
    for (const uint32_t corner : gap.corners) least = std::min(least, lux[corner]);
    if (least <= limit) dark.emplace_back(least, &gap);
  }
  std::stable_sort(dark.begin(), dark.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<glm::dvec3> places;
  for (size_t i = 0; i < std::min(dark.size(), limits::shadows_tried); ++i) {
    const GridGap& gap = *dark[i].second;
    places.push_back(gap.from + 0.5 * (gap.along + gap.across));
  }
  look_at(places);
}

void GapSearch::look_below_luminaires() {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& place : grid_.places) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  const auto is_over = [&](const glm::dvec2& p) {
    return p.x >= low.x - area_grid_m && p.y >= low.y - area_grid_m &&
           p.x <= high.x + area_grid_m && p.y <= high.y + area_grid_m;
  };
  const auto nearest = [&](const glm::dvec2& p) {
    glm::dvec3 best(0);
    double least = std::numeric_limits<double>::infinity();
    for (const GridGap& gap : grid_.gaps) {
      const auto share = [&](const glm::dvec3& side) {
        const glm::dvec2 way(side);
        const double square = glm::dot(way, way);
        return square > 0 ? std::clamp(glm::dot(p - glm::dvec2(gap.from), way) / square, 0.0, 1.0)
                          : 0.0;
      };
      const glm::dvec3 at =
          gap.from + gap.along * share(gap.along) + gap.across * share(gap.across);
      const double away = glm::length(glm::dvec2(at) - p);
      if (away >= least) continue;
      least = away;
      best = at;
    }
    return best;
  };
  // A floor slab hides those of other storeys.
  const auto may_light = [&](uint32_t lamp, const glm::dvec3& place) {
    const auto all = light_.in_question(place + glm::dvec3(0, 0, floor_plane_m));
    return std::binary_search(all.begin(), all.end(), lamp);
  };
  std::vector<glm::dvec3> places;
  for (uint32_t i = 0; i < lamps_.size(); ++i) {
    const glm::dvec3 &from = lamps_[i].centre, aim = -lamps_[i].emitter->frame.axes[2];
    if (from.z <= low.z) continue;
    std::vector<glm::dvec2> targets{glm::dvec2(from)};
    if (aim.z < 0) targets.emplace_back(from + aim * ((low.z - from.z) / aim.z));
    for (const glm::dvec2& target : targets) {
      if (!is_over(target)) continue;
      const glm::dvec3 place = nearest(target);
      if (may_light(i, place)) places.push_back(place);
    }
  }
  look_at(places);
}

}  // namespace

std::vector<LitPoint> lit_between(const SceneDescription& scene, const CodeLight& light,
                                  const CalculationGrid& grid, const std::vector<LitPoint>& lit,
                                  const std::vector<LuminaireFactors>& factors) {
  if (grid.gaps.empty() || lit.empty()) return {};
  GapSearch search(scene, light, grid, lit);
  search.look_below_luminaires();
  for (const LuminaireFactors& some : factors) {
    search.look_into_shadows(some);
    for (const Extreme extreme : {Extreme::least, Extreme::most}) search.look_for(extreme, some);
  }
  return std::move(search).found();
}

}  // namespace luxodus
