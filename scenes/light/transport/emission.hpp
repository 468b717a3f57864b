// Emission: every emitter is described by two functions, a point drawn in proportion to emitted
// power over its surface or volume, and the density of directions [1/sr] there. The particle tracer
// samples both; direct light and eye paths evaluate the second one toward a place. Pure; webs come
// from the caller's resolver. Any thread.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct EmissionPoint {
  Vec3 position;  // local coordinates
  Vec3 axis;      // axis of the distribution: the surface normal, or local -Z
};

/// A point drawn in proportion to emitted power; u, v, w uniform in [0, 1). Not for volumes.
EmissionPoint emission_point(const CompiledEmitter& emitter, Real u, Real v, double w);

/// A point of any emitter, volumes included, with a variable number of draws.
template <class Resolver>
EmissionPoint emission_point(const CompiledScene& scene, const CompiledEmitter& emitter,
                             Random& random, Resolver& resolver) {
  if (emitter.kind == EmitterKind::volume) {
    const auto uniform = [&] { return random.uniform_double(); };
    return {scene.media.sample_emission_point(emitter.medium, uniform, resolver), Vec3(0, 0, -1)};
  }
  if (emitter.kind == EmitterKind::point) return {emitter.origin, -emitter.axes[2]};
  const Real u = random.uniform();
  const Real v = random.uniform();
  const double w = emitter.texel_cdf.empty() ? 0.0 : random.uniform_double();
  return emission_point(emitter, u, v, w);
}

/// Area [m2] that a point of an emitting face represents: one over the density with which
/// `emission_point` samples it; 0 if it does not.
double sampled_area_m2(const CompiledEmitter& emitter, const Vec3& point);

/// Solid angle [sr] that the face would subtend at a place if all of it were seen as the given
/// point, whose direction to the place and distance are given. 0 if a ray from there cannot hit the
/// point.
double apparent_face(const CompiledEmitter& emitter, const EmissionPoint& point,
                     const Vec3& to_place, Real distance);

/// Density [1/sr] of directions at a point of the emitter; 0 for collimated light, a delta
/// distribution.
template <class Resolver>
Real directional_density(const CompiledEmitter& emitter, const EmissionPoint& point,
                         const Vec3& direction, Resolver& resolver) {
  const Real cosine = glm::dot(point.axis, direction);
  switch (emitter.distribution) {
    case Distribution::isotropic:
      return 1 / (4 * pi_f);
    case Distribution::lambertian:
      return std::max(0.0_r, cosine) / pi_f;
    case Distribution::cosine_power:
      return cosine_power_pdf(emitter.exponent, one_minus_cosine(point.axis, direction));
    case Distribution::spot:
      return emitter.spot.relative_intensity(one_minus_cosine(point.axis, direction)) /
             emitter.spot.solid_angle();
    case Distribution::collimated:
      return 0;
    case Distribution::web: {
      const glm::dvec3 local(glm::dot(emitter.axes[0], direction),
                             glm::dot(emitter.axes[1], direction),
                             glm::dot(emitter.axes[2], direction));
      return static_cast<Real>(resolver.web(emitter.web).pdf(local));
    }
  }
  return 0;
}

/// A direction drawn from that density.
template <class Resolver>
Vec3 emission_direction(const CompiledEmitter& emitter, const EmissionPoint& point, Random& random,
                        Resolver& resolver) {
  if (emitter.distribution == Distribution::collimated) return point.axis;
  if (emitter.distribution == Distribution::web) {
    const double u = random.uniform_double();
    const double v = random.uniform_double();
    const auto sample = resolver.web(emitter.web).sample(u, v);
    return glm::normalize(emitter.axes * Vec3(sample.direction));
  }
  const Real u = random.uniform();
  const Real v = random.uniform();
  if (emitter.distribution == Distribution::isotropic) return uniform_sphere(u, v);
  if (emitter.distribution == Distribution::spot)
    return to_world(point.axis, emitter.spot.sample(u, v));
  if (emitter.distribution == Distribution::cosine_power)
    return to_world(point.axis, cosine_power(emitter.exponent, u, v));
  return to_world(point.axis, cosine_hemisphere(u, v));
}

/// The nearest point of an emitter's surface on an eye ray.
struct EmitterHit {
  Real distance = 0;
  uint32_t emitter = none_index;
  EmissionPoint point;
};

/// Whether rays can hit the emitter itself: points and volumes have no face, and faces of signs are
/// surfaces of the scene.
bool has_own_face(const CompiledEmitter& emitter);
/// A sphere that holds all of its faces.
EmitterBound emitter_bound(const CompiledScene& scene, uint32_t emitter);

/// Nearest emitting surface along the ray within `length` whose emitting side faces it. Sign faces
/// are surfaces of the scene and not considered here.
EmitterHit nearest_emitter(const CompiledScene& scene, const Ray& ray, Real length);

/// Radiance [W/(m2 sr)] that leaves the point toward `direction` in a band. Not for points and
/// volumes.
template <class Resolver>
double emitted_radiance(const CompiledEmitter& emitter, const EmissionPoint& point,
                        const Vec3& direction, int band, Resolver& resolver) {
  const Real cosine = std::abs(glm::dot(point.axis, direction));
  if (emitter.area_m2 <= 0 || cosine < 1e-6_r) return 0;
  return emitter.power_w[static_cast<size_t>(band)] *
         static_cast<double>(directional_density(emitter, point, direction, resolver)) /
         (emitter.area_m2 * static_cast<double>(cosine));
}

}  // namespace luxodus
