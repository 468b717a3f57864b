// Rules for glare of luminaires, and for luminaires near points of emphasis.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/emergency/far_field.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

using namespace rule_limit;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int directions_azimuth = 72, directions_polar = 90;

double glare_limit(double height_m) {
  for (const GlareStep& step : glare_steps)
    if (height_m < step.below_m) return step.candela;
  return max_glare_cd;
}

/// Whether a luminaire is over a level escape route, where glare counts only in the zone of E8.
bool over_level_route(const SceneDescription& scene, const glm::dvec3& place) {
  const auto floor = floor_below(scene, place);
  return floor && std::any_of(scene.routes.begin(), scene.routes.end(), [&](const auto& route) {
           return is_level(route) && std::abs(route.path.front().z - *floor) < 1e-6;
         });
}

/// The directions in which glare counts, by their angle from straight down.
struct Zone {
  double low_deg = 0, high_deg = 180;
  double distance_deg(double polar_deg) const {
    return std::max({0.0, low_deg - polar_deg, polar_deg - high_deg});
  }
};

/// Smallest angle between the axis of a spot or beam and the directions of a zone.
double off_axis_deg(const Emitter& e, const Zone& zone) {
  return zone.distance_deg(std::acos(std::clamp(e.frame.axes[2].z, -1.0, 1.0)) * 180 / pi);
}

/// Largest intensity in a zone [cd]; none if a beam of parallel light points into the zone.
std::optional<double> glaring(const Emitter& e, double flux, const Zone& zone) {
  if (e.distribution == Distribution::spot) return flux * spot_per_lm(e, off_axis_deg(e, zone));
  if (e.distribution == Distribution::collimated)
    return off_axis_deg(e, zone) > 0 ? std::optional(0.0) : std::nullopt;
  double most = 0;
  for (int p = 0; p <= directions_polar; ++p) {
    const double polar = zone.low_deg + (zone.high_deg - zone.low_deg) * p / directions_polar;
    for (int a = 0; a < directions_azimuth; ++a) {
      const double azimuth = 2 * pi * a / directions_azimuth, from_down = polar * pi / 180;
      const glm::dvec3 world(std::sin(from_down) * std::cos(azimuth),
                             std::sin(from_down) * std::sin(azimuth), -std::cos(from_down));
      most = std::max(most, flux * intensity_per_lm(e, world));
    }
  }
  return most;
}

double in_plan(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(glm::dvec2(a - b));
}

bool is_equipment(EmphasisKind kind) {
  return kind == EmphasisKind::first_aid || kind == EmphasisKind::fire_equipment ||
         kind == EmphasisKind::call_point || kind == EmphasisKind::alarm_panel;
}

}  // namespace

std::optional<double> floor_of(const SceneDescription& scene, const FloorUnder& floor_under,
                               const glm::dvec3& place) {
  return floor_under ? floor_under(place) : floor_below(scene, place);
}

std::vector<Check> checks_of_height(const SceneDescription& scene, const CodeChoice& codes,
                                    const FloorUnder& floor_under) {
  std::vector<Check> out;
  if (!codes.european()) return out;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    const Subject subject = subject_of(e);
    const auto floor = floor_of(scene, floor_under, e.frame.origin);
    out.push_back(floor ? judged(rule_of(RuleId::E14, codes), subject, e.frame.origin.z - *floor,
                                 e.frame.origin)
                        : not_assessed(rule_of(RuleId::E14, codes), subject,
                                       remark(RemarkId::height_unknown)));
  }
  return out;
}

std::vector<Check> checks_of_glare(const SceneDescription& scene, const CodeChoice& codes,
                                   const FloorUnder& floor_under) {
  std::vector<Check> out;
  if (!codes.european()) return out;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    const Subject subject = subject_of(e);
    const auto floor = floor_of(scene, floor_under, e.frame.origin);
    const double lumens =
        e.radiometric ? e.emergency_flux * efficacy_lm_per_w(e.spectrum) : e.emergency_flux;
    const bool zone_alone = over_level_route(scene, e.frame.origin);
    const Zone zone = zone_alone ? Zone{zone_low_deg, zone_high_deg} : Zone{};
    const auto candela = glaring(e, lumens / e.emergency_ageing, zone);
    if (!floor) {
      out.push_back(
          not_assessed(rule_of(RuleId::E8, codes), subject, remark(RemarkId::height_unknown)));
    } else if (!candela) {
      out.push_back(
          not_assessed(rule_of(RuleId::E8, codes), subject, remark(RemarkId::parallel_beam)));
    } else {
      Check check = judged(rule_of(RuleId::E8, codes), subject, *candela,
                           Limit{glare_limit(e.frame.origin.z - *floor), false}, e.frame.origin);
      if (e.shape == EmitterShape::mesh && check.verdict == CheckVerdict::fail)
        check.reasons = {remark(RemarkId::mesh_unhidden)};
      check.conditions = {remark(zone_alone ? RemarkId::glare_zone : RemarkId::all_directions)};
      // A new luminaire gives more than its rated flux: what glares with that glares, the rest is
      // not known.
      if (!e.initial_flux_known && check.verdict != CheckVerdict::fail)
        check = not_assessed(rule_of(RuleId::E8, codes), subject,
                             remark(RemarkId::initial_flux_unknown));
      out.push_back(std::move(check));
    }
  }
  return out;
}

std::vector<EmphasisPoint> emphasis_of(const SceneDescription& scene) {
  std::vector<EmphasisPoint> out = scene.emphasis;
  for (const EscapeRoute& route : scene.routes)
    for (size_t i = 1; i + 1 < route.path.size(); ++i) {
      const glm::dvec2 in = glm::normalize(glm::dvec2(route.path[i] - route.path[i - 1]));
      const glm::dvec2 on = glm::normalize(glm::dvec2(route.path[i + 1] - route.path[i]));
      if (glm::dot(in, on) > std::cos(bend_deg * pi / 180)) continue;
      EmphasisPoint bend;
      bend.name = "bend " + std::to_string(i) + " of route " + route.name;
      bend.place = route.place;
      bend.kind = EmphasisKind::direction_change;
      bend.position = route.path[i];
      out.push_back(std::move(bend));
    }
  return out;
}

Check luminaire_near(const Rule& rule, const SceneDescription& scene, const Subject& subject,
                     const glm::dvec3& place, bool above, const LinesOfSight& seen,
                     const FedLuminaires& fed, const StoreyFloors& floors) {
  constexpr double none = std::numeric_limits<double>::infinity();
  struct Near {
    double distance_m = none;
    std::string name;
  } open, hidden, upstairs, exhausted;
  const bool by_rays = !floors.luminaires.empty();
  const auto floor = by_rays ? floors.place : floor_below(scene, place);
  const auto luminaires = emergency_luminaires(scene);
  for (size_t i = 0; i < luminaires.size(); ++i) {
    const Emitter& e = scene.emitters[luminaires[i]];
    const double distance = in_plan(e.frame.origin, place);
    const auto its_floor = by_rays ? floors.luminaires[i] : floor_below(scene, e.frame.origin);
    const bool here = !floor || !its_floor || std::abs(*floor - *its_floor) < storey_m;
    Near& nearest = !here                        ? upstairs
                    : !(fed.empty() || fed[i])   ? exhausted
                    : !(seen.empty() || seen[i]) ? hidden
                                                 : open;
    if ((!above || e.frame.origin.z >= place.z) && distance < nearest.distance_m)
      nearest = {distance, e.name};
  }
  Check check = judged(rule, subject, open.distance_m, place);
  if (!open.name.empty())
    check.reasons = {remark(RemarkId::nearest_luminaire, open.name)};
  else if (hidden.name.empty() && upstairs.name.empty() && exhausted.name.empty())
    check.reasons = {remark(above ? RemarkId::none_above : RemarkId::none_there)};
  else
    check.reasons = {remark(above ? RemarkId::none_above_in_sight : RemarkId::none_in_sight)};
  if (hidden.distance_m < open.distance_m)
    check.reasons.push_back(remark(RemarkId::behind_something, hidden.name, hidden.distance_m));
  if (exhausted.distance_m < open.distance_m)
    check.reasons.push_back(
        remark(RemarkId::supply_exhausted, exhausted.name, exhausted.distance_m));
  if (upstairs.distance_m < std::min(open.distance_m, limit_of(rule.id)))
    check.reasons.push_back(remark(RemarkId::other_storey, upstairs.name, upstairs.distance_m));
  return check;
}

std::vector<Check> checks_of_emphasis(const SceneDescription& scene, const EmphasisPoint& point,
                                      const LinesOfSight& seen, std::optional<double> vertical_lx,
                                      const CodeChoice& codes, const FedLuminaires& fed,
                                      const StoreyFloors& floors) {
  if (!codes.european()) return {};
  const Subject subject = subject_of(point);
  std::vector<Check> out = {luminaire_near(rule_of(RuleId::E12, codes), scene, subject,
                                           point.position, true, seen, fed, floors)};
  if (!is_equipment(point.kind)) return out;
  out.push_back(
      vertical_lx
          ? judged(rule_of(RuleId::E13, codes), subject, *vertical_lx, point.position)
          : not_assessed(rule_of(RuleId::E13, codes), subject, remark(RemarkId::facing_unsaid)));
  return out;
}

}  // namespace luxodus
