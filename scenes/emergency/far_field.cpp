#include "scenes/emergency/far_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxodus {

namespace {

constexpr int tube_steps = 360;

/// Share of its light per steradian that a surface point emits at an angle to its normal.
double density(const Emitter& e, double cosine) {
  const double c = std::max(0.0, cosine);
  switch (e.distribution) {
    case Distribution::isotropic:
      return 1 / (4 * std::numbers::pi);
    case Distribution::lambertian:
      return c / std::numbers::pi;
    case Distribution::cosine_power:
      return (e.cosine_power + 1) / (2 * std::numbers::pi) * std::pow(c, e.cosine_power);
    case Distribution::spot:
    case Distribution::collimated:
    case Distribution::web:
      return 0;
  }
  return 0;
}

/// A mesh: over all its triangles, as if none hid another.
double mesh_density(const Emitter& e, const glm::dvec3& world) {
  double area = 0, sum = 0;
  for (const auto& t : e.mesh.triangles) {
    const glm::dvec3 a(e.mesh.positions[t[0]]), b(e.mesh.positions[t[1]]),
        c(e.mesh.positions[t[2]]);
    const glm::dvec3 doubled = glm::cross(b - a, c - a);
    const double size = glm::length(doubled);
    if (!(size > 0)) continue;
    area += size;
    sum += size * density(e, glm::dot(doubled / size, world));
  }
  return area > 0 ? sum / area : 0;
}

/// Side of a cylinder along local x: mean over its circumference.
double tube_density(const Emitter& e, const glm::dvec3& local) {
  const double aside = std::sqrt(std::max(0.0, 1 - local.x * local.x));
  double sum = 0;
  for (int i = 0; i < tube_steps; ++i)
    sum += density(e, aside * std::cos(2 * std::numbers::pi * (i + 0.5) / tube_steps));
  return sum / tube_steps;
}

/// A sphere: the same in all directions.
double sphere_density() {
  return 1 / (4 * std::numbers::pi);
}

}  // namespace

glm::dvec3 centre_of(const Emitter& e) {
  if (e.shape != EmitterShape::mesh || e.mesh.positions.empty()) return e.frame.origin;
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : e.mesh.positions) sum += p;
  return sum / static_cast<double>(e.mesh.positions.size());
}

double intensity_per_lm(const Emitter& e, const glm::dvec3& world) {
  const glm::dvec3 local = glm::transpose(e.frame.axes) * world;
  if (e.distribution == Distribution::web) return e.web->pdf(local);
  switch (e.shape) {
    case EmitterShape::point:
    case EmitterShape::rectangle:
    case EmitterShape::disc:
      return density(e, -local.z);
    case EmitterShape::sphere:
      return sphere_density();
    case EmitterShape::tube:
      return tube_density(e, local);
    case EmitterShape::mesh:
      return mesh_density(e, world);
  }
  return 0;
}

double spot_per_lm(const Emitter& e, double off_axis_deg) {
  const auto one_minus_cos = [](double degrees) {
    return 2 * std::pow(std::sin(degrees * std::numbers::pi / 360), 2);
  };
  const double inner = one_minus_cos(e.spot_inner_deg), outer = one_minus_cos(e.spot_outer_deg);
  const double x = one_minus_cos(off_axis_deg);
  const double full = 1 / (std::numbers::pi * (inner + outer));
  if (x <= inner) return full;
  if (x >= outer) return 0;
  const double t = (outer - x) / (outer - inner);
  return full * t * t * (3 - 2 * t);
}

}  // namespace luxodus
