#include "actors/judge/visibility_map/glare_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/emergency/veil.hpp"
#include "scenes/light/optics/photometric_web.hpp"
#include "scenes/light/transport/emitted_light.hpp"

namespace luxodus {

namespace {

/// Steps of the angle from the axis.
constexpr size_t polar_steps = 36;
/// An emitter is far away if its distance is so many times its radius.
constexpr double far_radii = 1.5;

constexpr double pi = std::numbers::pi;

double lumens_of(const CompiledScene& scene, const CompiledEmitter& emitter) {
  double lumens = 0;
  for (int b = 0; b < scene.bands.count(); ++b)
    lumens += emitter.power_w[static_cast<size_t>(b)] * scene.bands[b].lm_per_w;
  return lumens;
}

/// Whether all points of an emitter look along one axis.
bool is_flat(const CompiledEmitter& emitter) {
  return emitter.kind != EmitterKind::sphere && emitter.kind != EmitterKind::tube &&
         emitter.kind != EmitterKind::mesh;
}

/// Largest density [1/sr] of a web by the angle from the luminaire's +Z, in equal steps. Intensity
/// is bilinear in the cells of the table, so it is nowhere above the largest corner of its cell.
std::vector<double> densities_of(const PhotometricWeb& web) {
  const std::vector<double>&azimuth = web.azimuth_deg(), &polar = web.polar_deg();
  // About the luminaire's axis the angle is that of the table. About others it may lie beyond the
  // corners, by half of the edges of the cell at most.
  const bool upright = std::abs(web.to_luminaire()[2].z) > 1 - 1e-9;
  const auto angle = [&](size_t a, size_t p) {
    const double theta = glm::radians(polar[p]), phi = glm::radians(azimuth[a]);
    const glm::dvec3 table(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                           std::cos(theta));
    return std::acos(std::clamp((web.to_luminaire() * table).z, -1.0, 1.0));
  };
  std::vector<double> out(polar_steps, 0.0);
  for (size_t a = 0; a + 1 < azimuth.size(); ++a)
    for (size_t p = 0; p + 1 < polar.size(); ++p) {
      double low = pi, high = 0, most = 0;
      for (const size_t i : {a, a + 1})
        for (const size_t j : {p, p + 1}) {
          low = std::min(low, angle(i, j));
          high = std::max(high, angle(i, j));
          most = std::max(most, web.candela()[i * polar.size() + j]);
        }
      const double beyond =
          upright ? 1e-9 : glm::radians(azimuth[a + 1] - azimuth[a] + polar[p + 1] - polar[p]) / 2;
      const auto step = [](double at) {
        return static_cast<size_t>(std::clamp(at / pi * polar_steps, 0.0, polar_steps - 1.0));
      };
      for (size_t k = step(low - beyond); k <= step(high + beyond); ++k)
        out[k] = std::max(out[k], most / web.flux_lm());
    }
  return out;
}

/// The same of other emitters, from their axis. Their densities fall with that angle, and points
/// that look in other directions send at most what their axis has.
std::vector<double> densities_of(const CompiledScene& scene, const GeometryAccess& access,
                                 uint32_t emitter, const EmissionPoint& point) {
  const Vec3 helper = std::abs(point.axis.z) < 0.7_r ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 across = glm::normalize(glm::cross(helper, point.axis));
  std::vector<double> out(polar_steps);
  for (size_t k = 0; k < out.size(); ++k) {
    const double angle =
        is_flat(scene.emitters[emitter]) ? pi * static_cast<double>(k) / polar_steps : 0;
    const Vec3 direction = point.axis * static_cast<Real>(std::cos(angle)) +
                           across * static_cast<Real>(std::sin(angle));
    out[k] = static_cast<double>(
        emitted_density(scene, access, emitter, point, glm::normalize(direction)));
  }
  return out;
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
  if (e.distribution == Distribution::web) {
    out.intensity = with_resolver(scene, access,
                                  [&](auto resolver) { return densities_of(resolver.web(e.web)); });
  } else {
    const EmissionPoint point = emitted_rays(scene, access, emitter, 1, 1).front().point;
    out.axis = glm::dvec3(point.axis);
    out.intensity = densities_of(scene, access, emitter, point);
  }
  constexpr double rounding = 1 + 1e-5;
  for (double& one : out.intensity) one *= rounding * lumens_of(scene, e);
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
      return static_cast<size_t>(std::clamp(angle / pi * polar_steps, 0.0, polar_steps - 1.0));
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
