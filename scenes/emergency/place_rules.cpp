// Glare of luminaires, and what they must be near to.
#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"

namespace luxodus {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double near_m = 2;                             // E12, S6
constexpr double equipment_lx = 5;                       // E13
constexpr double bend_deg = 30;                          // a change of direction, ours
constexpr double zone_low_deg = 60, zone_high_deg = 90;  // E8, from straight down
constexpr int directions_azimuth = 72, directions_polar = 90;

/// Largest intensity of a luminaire by its height above the floor (E8).
struct GlareStep {
  double below_m;
  double candela;
};
constexpr std::array glare_steps{GlareStep{2.5, 500}, GlareStep{3, 900}, GlareStep{3.5, 1600},
                                 GlareStep{4, 2500}, GlareStep{4.5, 3500}};
constexpr double glare_highest_cd = 5000;

double glare_limit(double height_m) {
  for (const GlareStep& step : glare_steps)
    if (height_m < step.below_m) return step.candela;
  return glare_highest_cd;
}

/// Intensity far away [cd] of `flux` lumens, in a direction of the luminaire's own frame; none for
/// shapes that have no simple law.
std::optional<double> intensity(const Emitter& e, double flux, const glm::dvec3& direction) {
  const double down = std::max(0.0, -direction.z);
  switch (e.distribution) {
    case Distribution::web:
      return flux * e.web->pdf(direction);
    case Distribution::isotropic:
      return flux / (4 * pi);
    case Distribution::cosine_power:
      return flux * (e.cosine_power + 1) / (2 * pi) * std::pow(down, e.cosine_power);
    case Distribution::lambertian:
      if (e.shape == EmitterShape::rectangle || e.shape == EmitterShape::disc)
        return flux / pi * down;
      if (e.shape == EmitterShape::sphere) return flux / (4 * pi);
      return std::nullopt;
    case Distribution::spot:
    case Distribution::collimated:
      return std::nullopt;
  }
  return std::nullopt;
}

/// Whether the way below a luminaire is a level escape route: then glare counts in a zone alone.
bool over_level_route(const SceneDescription& scene, const glm::dvec3& place) {
  const auto floor = floor_below(scene, place);
  return floor && std::any_of(scene.routes.begin(), scene.routes.end(), [&](const auto& route) {
           return is_level(route) && std::abs(route.path.front().z - *floor) < 1e-6;
         });
}

/// The largest intensity in the directions that count, none where there is no law for it.
std::optional<double> glaring(const Emitter& e, double flux, bool zone_alone) {
  double most = 0;
  for (int p = 0; p <= directions_polar; ++p) {
    const double polar = (zone_alone ? zone_low_deg : 0.0) + ((zone_alone ? zone_high_deg : 180.0) -
                                                              (zone_alone ? zone_low_deg : 0.0)) *
                                                                 p / directions_polar;
    for (int a = 0; a < directions_azimuth; ++a) {
      const double azimuth = 2 * pi * a / directions_azimuth, from_down = polar * pi / 180;
      const glm::dvec3 world(std::sin(from_down) * std::cos(azimuth),
                             std::sin(from_down) * std::sin(azimuth), -std::cos(from_down));
      const auto candela = intensity(e, flux, glm::transpose(e.frame.axes) * world);
      if (!candela) return std::nullopt;
      most = std::max(most, *candela);
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

std::vector<Check> checks_of_glare(const SceneDescription& scene, const CodeChoice& codes) {
  std::vector<Check> out;
  if (!codes.en_2013 && !codes.en_2024) return out;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    const std::string subject = "luminaire \"" + e.name + "\"";
    const auto floor = floor_below(scene, e.frame.origin);
    const double lumens =
        e.radiometric ? e.emergency_flux * efficacy_lm_per_w(e.spectrum) : e.emergency_flux;
    const bool zone_alone = over_level_route(scene, e.frame.origin);
    const auto candela = glaring(e, lumens / e.emergency_ageing, zone_alone);
    if (!floor) {
      out.push_back(not_assessed(rule_of("E8"), subject,
                                 "no route or open area lies below it: its height is not known"));
    } else if (!candela) {
      out.push_back(not_assessed(rule_of("E8"), subject,
                                 "spots, beams, tubes and meshes have no intensity table"));
    } else {
      Check check = judged(rule_of("E8"), subject, *candela, glare_limit(e.frame.origin.z - *floor),
                           false, "cd", e.frame.origin);
      check.condition = zone_alone ? "60 to 90 degrees from straight down" : "all directions";
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

std::vector<Check> checks_of_emphasis(const SceneDescription& scene, const EmphasisPoint& point,
                                      std::optional<double> vertical_lx, const CodeChoice& codes) {
  if (!codes.en_2013 && !codes.en_2024) return {};
  const std::string subject = "\"" + point.name + "\" (" +
                              std::string(emphasis_words[static_cast<size_t>(point.kind)]) + ")";
  std::vector<Check> out;
  double nearest = std::numeric_limits<double>::infinity();
  std::string whose;
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    const double distance = in_plan(e.frame.origin, point.position);
    if (e.frame.origin.z < point.position.z || distance >= nearest) continue;
    nearest = distance;
    whose = "the nearest is \"" + e.name + "\"";
  }
  out.push_back(judged(rule_of("E12"), subject, nearest, near_m, false, "m", point.position));
  out.back().reason = whose.empty() ? "no emergency luminaire is above it" : whose;
  if (!is_equipment(point.kind)) return out;
  out.push_back(vertical_lx ? judged(rule_of("E13"), subject, *vertical_lx, equipment_lx, true,
                                     "lx", point.position)
                            : not_assessed(rule_of("E13"), subject, "'facing' is not given"));
  return out;
}

}  // namespace luxodus
