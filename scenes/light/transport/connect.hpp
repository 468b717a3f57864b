// Shadow rays: the visibility and transmittance between two points. Thin panes, open surfaces and
// the emitter's own body transmit; all other solids block, refracting ones too, because the light
// that they bend does not arrive along this line. Functions without state; one thread or fiber per
// resolver; suspends where the resolver does.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Panes that one line may cross; more count as opaque.
inline constexpr int panes_per_line = 64;
/// Surfaces of an emitter's own body that one line may cross, such as fins; more count as opaque.
inline constexpr int own_surfaces_per_line = 4096;
}  // namespace limits

/// The body of the emitter at the end of a line, which does not stop its light.
struct OwnBody {
  int body = 0;  // 0: none
  int surfaces_met = 0;
};

/// False if a solid within `length` of the ray blocks light. Calls pane(material, cosine) for every
/// pane before it.
template <class Resolver, class Pane>
bool passes_solids(const CompiledScene& scene, Ray ray, Real length, Resolver& resolver,
                   OwnBody& own, Pane&& pane_met) {
  ray.length = length;
  // An emitter with a body needs the surfaces on the line; others in its scene need them no more.
  if (!scene.features.surfaces && own.body == 0) return !resolver.occluded(ray);
  for (int panes = 0;
       panes < limits::panes_per_line && own.surfaces_met < limits::own_surfaces_per_line;) {
    const Hit hit = resolver.nearest(ray);
    if (!hit.found()) return true;
    const TriangleRecord& t = *hit.triangle;
    const Real cosine = glm::dot(t.unit_normal(), ray.direction);
    const size_t side = cosine < 0 ? 0 : 1;
    const CompiledSurface& surface = scene.surfaces[t.surface];
    const CompiledMaterial& material = scene.materials[surface.material[side]];
    if (own.body != 0 && surface.body == own.body) {
      ++own.surfaces_met;
    } else if (material.kind == MaterialKind::glass_pane) {
      ++panes;
      pane_met(material, cosine);
    } else if (material.kind == MaterialKind::open) {
      ++panes;
    } else {
      return false;
    }
    const Vec3 end = ray.origin + ray.direction * ray.length;
    ray.origin = offset_ray(t.at(hit.u, hit.v), cosine < 0 ? -t.unit_normal() : t.unit_normal(),
                            scene.min_offset_m);
    ray.length = glm::dot(end - ray.origin, ray.direction);
    if (ray.length <= 0) return true;
  }
  return false;
}

/// Product of the transmittances of all panes within `length` of the ray in a band; 0 if blocked.
/// `body`: of the emitter at its end.
template <class Resolver>
double solid_transmittance(const CompiledScene& scene, const Ray& ray, Real length, int band,
                           Resolver& resolver, int body = 0) {
  double share = 1;
  OwnBody own{body};
  const bool passes = passes_solids(
      scene, ray, length, resolver, own, [&](const CompiledMaterial& material, Real cosine) {
        share *= static_cast<double>(
            pane_transmittance(material.by_band[static_cast<size_t>(band)], cosine));
      });
  return passes ? share : 0;
}

/// exp(-optical depth) along the ray.
template <class Resolver>
double medium_transmittance(const CompiledScene& scene, const Ray& ray, Real length, int band,
                            Resolver& resolver) {
  if (scene.features.media == MediaNeed::none) return 1;
  return std::exp(-optical_depth<MediaNeed::general>(scene.media, band, ray.origin, ray.direction,
                                                     length, resolver));
}

/// A straight connection from a place to a point of an emitter.
struct ShadowRay {
  Ray ray;            // ends before solids that do not block it, such as the emitter's own body
  Real distance = 0;  // between the two points: for smoke and the inverse square
};

/// `axis` is the emitting side's normal; a target on a solid face is reached just in front of it.
inline ShadowRay connect(const CompiledScene& scene, const Vec3& from, const Vec3& to,
                         const Vec3& axis, bool on_surface) {
  Vec3 target = to;
  if (on_surface) {
    const Vec3 side = glm::dot(from - to, axis) >= 0 ? axis : -axis;
    target = offset_ray(to, side, scene.min_offset_m);
  }
  const Vec3 difference = target - from;
  const Real length = glm::length(difference);
  // The last millionth is left out, since it may hit the emitter's own surface.
  return {{from, difference / length, length * (1 - 1e-6_r)}, glm::length(to - from)};
}

}  // namespace luxodus
