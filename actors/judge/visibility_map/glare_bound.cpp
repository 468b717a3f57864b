#include "actors/judge/visibility_map/glare_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/emergency/veil.hpp"
#include "scenes/light/transport/emitted_light.hpp"

namespace luxodus {

namespace {

/// Angles from the axis and around it at which intensities are taken, and points of the emitter.
constexpr int polar_steps = 36, around_steps = 24, points_of_emitter = 16;
/// Between those directions the intensity may be larger.
constexpr double between_directions = 1.25;
/// An emitter is far away if its distance is so many times its radius.
constexpr double far_radii = 1.5;

constexpr double pi = std::numbers::pi;

double lumens_of(const CompiledScene& scene, const CompiledEmitter& emitter) {
  double lumens = 0;
  for (int b = 0; b < scene.bands.count(); ++b)
    lumens += emitter.power_w[static_cast<size_t>(b)] * scene.bands[b].lm_per_w;
  return lumens;
}

}  // namespace

GlareBound::Source GlareBound::source_of(const CompiledScene& scene, const GeometryAccess& access,
                                         uint32_t emitter) {
  const CompiledEmitter& e = scene.emitters[emitter];
  const EmitterBound bound = emitter_bound(scene, emitter);
  Source out{glm::dvec3(bound.centre),
             glm::dvec3(e.axes[2]),
             static_cast<double>(bound.radius),
             static_cast<size_t>(e.group),
             none_index,
             {}};
  if (e.sign != none_index) out.sign = scene.signs[e.sign].sign;
  const auto rays = emitted_rays(scene, access, emitter, 1, points_of_emitter);
  const double scale = between_directions * lumens_of(scene, e) / points_of_emitter;
  std::vector<double> at(polar_steps + 1, 0.0);
  for (int p = 0; p <= polar_steps; ++p)
    for (int a = 0; a < around_steps; ++a) {
      const double polar = pi * p / polar_steps, around = 2 * pi * a / around_steps;
      const glm::dvec3 local(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                             std::cos(polar));
      const Vec3 direction = glm::normalize(e.axes * Vec3(local));
      double sum = 0;
      for (const EmittedRay& ray : rays)
        sum += static_cast<double>(emitted_density(scene, access, emitter, ray.point, direction));
      auto& most = at[static_cast<size_t>(p)];
      most = std::max(most, scale * sum);
    }
  for (size_t p = 0; p < polar_steps; ++p) out.intensity.push_back(std::max(at[p], at[p + 1]));
  return out;
}

GlareBound::GlareBound(const Building& building) : building_(building) {
  const CompiledScene& scene = building.scene();
  std::vector<Source> all(scene.emitters.size());
  building.each(all.size(), [&](const GeometryAccess& access, size_t i) {
    if (scene.emitters[i].distribution != Distribution::collimated)
      all[i] = source_of(scene, access, static_cast<uint32_t>(i));
  });
  for (Source& source : all) {
    const auto most = std::max_element(source.intensity.begin(), source.intensity.end());
    if (most != source.intensity.end() && *most > 0) sources_.push_back(std::move(source));
  }
}

std::vector<double> GlareBound::at(const glm::dvec3& eye, const glm::dvec3& centre, uint32_t sign,
                                   double age_years, const GroupFactors& factors) const {
  const glm::dvec3 place(building_.local(eye));
  const glm::dvec3 gaze = glm::normalize(centre - eye);
  std::vector<double> out(factors.size(), 0.0);
  for (const Source& source : sources_) {
    if (source.sign == sign) continue;
    const glm::dvec3 to = source.centre - place;
    const double distance = glm::length(to);
    if (!(distance > far_radii * source.radius_m))
      return std::vector<double>(factors.size(), std::numeric_limits<double>::infinity());
    const double half = std::asin(source.radius_m / distance);
    const double away =
        std::max(0.0, std::acos(std::clamp(glm::dot(to, gaze) / distance, -1.0, 1.0)) - half);
    if (away >= pi / 2) continue;
    const double polar = std::acos(std::clamp(-glm::dot(to, source.axis) / distance, -1.0, 1.0));
    const auto at = [&](double angle) {
      const double step = std::clamp(angle / pi * polar_steps, 0.0, polar_steps - 1.0);
      return static_cast<size_t>(step);
    };
    double intensity = 0;
    for (size_t p = at(polar - half); p <= at(polar + half); ++p)
      intensity = std::max(intensity, source.intensity[p]);
    const double near = distance - source.radius_m;
    const double veil =
        intensity / (near * near) * std::cos(away) * veil_per_lux(glm::degrees(away), age_years);
    for (size_t m = 0; m < out.size(); ++m) out[m] += veil * factors[m][source.group];
  }
  return out;
}

}  // namespace luxodus
