#include "actors/judge/design/place_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "actors/judge/design/wall_probe.hpp"

namespace luxodus {

namespace {

/// Number of directions in which a luminaire may be off.
constexpr int off_directions = 8;
/// Points of a demand that get rows at a time, and the distance between them [m].
constexpr size_t asked_at_once = 40;
constexpr double broken_apart_m = 0.5;
/// Shares this close to 1 hold: rounding.
constexpr double share_rounding = 1e-6;

/// Horizontal on a ceiling; along and up the wall on a wall.
glm::dvec3 off_way(const LuminaireCandidate& one, double azimuth) {
  const glm::dvec3 level(std::cos(azimuth), std::sin(azimuth), 0);
  if (!one.outward) return level;
  const glm::dvec3 along(-one.outward->y, one.outward->x, 0);
  return along * level.x + glm::dvec3(0, 0, level.y);
}

/// A luminaire at its planned place and at the places where it may be instead, as options of one
/// place.
std::vector<LuminaireCandidate> with_places_off(const Building& building,
                                                const std::vector<LuminaireCandidate>& chosen,
                                                double distance_m) {
  std::vector<LuminaireCandidate> out;
  building.each(1, [&](const GeometryAccess& access, size_t) {
    for (uint32_t i = 0; i < chosen.size(); ++i) {
      LuminaireCandidate one = chosen[i];
      one.place = i;
      out.push_back(one);
      if (one.type == LuminaireCandidate::existing && !one.moved) continue;  // stays where it is
      for (int d = 0; d < off_directions; ++d) {
        const double azimuth = 2 * std::numbers::pi * d / off_directions;
        const glm::dvec3 way = off_way(chosen[i], azimuth);
        one.position = chosen[i].position + way * distance_m;
        const auto between = wall_distance(building, access, chosen[i].position, way, distance_m);
        if (!between && !building.in_solid(access, one.position)) out.push_back(one);
      }
    }
  });
  return out;
}

/// For each place the least light that it may give, and the sum of these.
class LeastLight {
 public:
  explicit LeastLight(const LayoutProblem& problem) : problem_(problem) {
    for (const LayoutOption& option : problem.options) ++variants_[option.place];
  }

  struct Sum {
    double all = 0, largest = 0;
  };
  Sum of(const std::vector<Term>& terms) const {
    Sum sum;
    for (size_t i = 0; i < terms.size();) {
      const uint32_t place = problem_.options[terms[i].option].place;
      double least = std::numeric_limits<double>::infinity();
      size_t given = 0;
      for (; i < terms.size() && problem_.options[terms[i].option].place == place; ++i, ++given)
        least = std::min(least, static_cast<double>(terms[i].value));
      // A variant without a term gives no light, so the least of this place is zero.
      if (given < variants_.at(place)) continue;
      sum.all += least;
      sum.largest = std::max(sum.largest, least);
    }
    return sum;
  }

 private:
  const LayoutProblem& problem_;
  std::map<uint32_t, size_t> variants_;
};

/// The tightest place of each demand.
class Tightest {
 public:
  void offer(const ConstraintGroup& group, double share, double least, const glm::dvec3& place) {
    ShareOffPlace& one = of(group);
    const bool breaks = share < 1 - share_rounding;
    if (breaks) one.broken.emplace_back(share, place);
    if (share >= one.share) return;
    one.share = share;
    one.place = place;
    one.least = least;
    one.missing = breaks ? (1 - share) * least : 0;
  }
  std::vector<ShareOffPlace> take() {
    std::stable_sort(all_.begin(), all_.end(), [](const ShareOffPlace& a, const ShareOffPlace& b) {
      return a.share < b.share;
    });
    return std::move(all_);
  }

 private:
  ShareOffPlace& of(const ConstraintGroup& group) {
    for (ShareOffPlace& one : all_)
      if (one.kind == group.kind && one.rule == group.rule && one.subject == group.subject)
        return one;
    return all_.emplace_back(ShareOffPlace{group.kind, group.rule, group.subject,
                                           std::numeric_limits<double>::infinity()});
  }

  std::vector<ShareOffPlace> all_;
};

}  // namespace

Result<std::vector<LuminaireCandidate>> displaced_copies(
    const OffPlaceScene& of, const std::vector<LuminaireCandidate>& candidates) {
  const SceneDescription lit = scene_of(of.scene, of.design, candidates);
  const auto building =
      Building::make(code_scene(lit, true), code_scenario(lit, of.doors), of.threads);
  if (!building) return building.problem();
  return with_places_off(*building.value(), candidates, of.design.place_tolerance_m);
}

std::vector<PointOffPlace> broken_points(const PlaceTolerance& tolerance) {
  std::vector<PointOffPlace> out;
  for (const ShareOffPlace& one : tolerance.demands) {
    auto worst_first = one.broken;
    std::stable_sort(worst_first.begin(), worst_first.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const size_t before = out.size();
    for (const auto& [share, place] : worst_first) {
      if (out.size() >= before + asked_at_once) break;
      const bool near = std::any_of(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
                                    [&](const PointOffPlace& other) {
                                      return glm::length(other.place - place) < broken_apart_m;
                                    });
      if (!near) out.push_back({one.kind, one.rule, one.subject, place, one.least});
    }
  }
  return out;
}

Result<PlaceTolerance> tolerance_of(const SceneDescription& scene, const DesignSettings& design,
                                    const std::vector<LuminaireCandidate>& chosen,
                                    const std::vector<CodeChoice>& codes, const Scenario& doors,
                                    int threads) {
  PlaceTolerance out;
  out.distance_m = design.place_tolerance_m;
  const auto copies = displaced_copies({scene, design, doors, threads}, chosen);
  if (!copies) return copies.problem();
  // The limits of the rules themselves: the planning margin is meant to cover such deviations.
  DesignSettings bare_limits = design;
  bare_limits.margin = 1;
  const auto demands = Demands::make(scene, bare_limits, copies.value(), codes, doors, threads);
  if (!demands) return demands.problem();
  const LayoutProblem& problem = demands.value()->problem();
  const LeastLight least(problem);
  Tightest tightest;
  for (const CoverRow& row : problem.covers)
    if (const DemandKind kind = problem.groups[row.group].kind;
        is_minimum(kind) || kind == DemandKind::failed)
      tightest.offer(problem.groups[row.group], least.of(*row.terms).all / row.least, row.least,
                     row.place);
  for (const FailureRows& rows : problem.failures)
    for (const uint32_t p : rows.points) {
      const auto sum = least.of(*problem.points[p].light);
      tightest.offer(problem.groups[rows.group], (sum.all - sum.largest) / rows.least, rows.least,
                     problem.points[p].place);
    }
  out.demands = tightest.take();
  return out;
}

}  // namespace luxodus
