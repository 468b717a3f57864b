// Path guiding towards the glow around emitters in smoke. Near an emitter smoke is bright; a path
// that samples only the phase function or the surface rarely goes there, but contributes much when
// it does. So a part of the directions is sampled towards spheres around emitters. The caller
// weights both sampling techniques by the balance heuristic: `density` is that of the mixture. What
// is known of emitters at a place (emitter_sight.hpp) decides which are worth guiding to. In smoke,
// paths are also guided to mirror images of emitters (emitter_images.hpp). Not here: light straight
// from emitters (next_event.hpp). One thread or fiber at a time.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/radiance_cache.hpp"

namespace luxodus {

namespace limits {
/// Emitters that paths are guided to, those with the most glow: each costs time at every event.
inline constexpr size_t glows = 16;
/// Largest guided share of the directions at a place.
inline constexpr double max_aimed = 0.9;
/// Tangent of the largest half angle of a guiding cone, also from within a sphere.
inline constexpr Real widest_slope = 3;
/// Number of a path's first events that may be guided.
inline constexpr int aimed_events = 8;
/// Least share of an emitter's light that its glow scatters, to be guided to. The brightest
/// outliers are unguided paths that pass an emitter in thin smoke.
inline constexpr double min_glow = 0.02;
/// Rays from an emitter that estimate what surfaces beside it reflect.
inline constexpr int glow_rays = 64;
/// Least share of the light at a place that an emitter must have, to be guided to.
inline constexpr double min_glow_seen = 0.01;
}  // namespace limits

struct CellSight;
struct EmitterImage;

/// A sphere around an emitter, and the strength of its glow.
struct Glow {
  Vec3 centre{0};
  Real radius = 0;
  double power = 0;  // of the emitter, in all bands, weighted by luminance and colour
  /// Shares of its light that smoke and surfaces in the sphere scatter, and that surfaces alone
  /// reflect; 0: not worth guiding to.
  double share = 0, reflected = 0;
  Real body = 0;  // radius of the emitter itself
};

class GlowGuide {
 public:
  GlowGuide() = default;
  /// `glows`: of all emitters, by number; none if there is no smoke. `mirrors`: whether paths are
  /// guided to mirror images, too.
  explicit GlowGuide(std::vector<Glow> glows, bool mirrors = false);

  /// Whether no direction is guided.
  bool empty() const { return brightest_.empty() && !mirrors_; }

  /// Events after limits::aimed_events are not guided: the weights of many guided ones would
  /// multiply.
  void start_event(int event) { aims_ = event < limits::aimed_events; }
  /// Sets the place of an event until the next call. `seen`: what is known of emitters there; if
  /// null, they are weighted by power and distance, without regard to walls. `cached`: if scattered
  /// light is in the radiance cache, only reflected glow is guided to.
  void stand_at(const Vec3& place, const CellSight* seen, CachedLight cached);
  /// Guided share of the directions there.
  double aimed() const { return aimed_; }
  /// Samples a guided direction from uniform numbers; `choice` in [0, aimed()).
  Vec3 direction(double choice, Real u, Real v) const;
  /// Density [1/sr] of the mixture of both techniques, where the event alone has the density `own`.
  double density(const Vec3& direction, double own) const;

 private:
  struct Cone {
    Vec3 axis{0};
    Real slope = 0;    // tangent of its half angle
    double share = 0;  // of the directions
  };
  /// Adds a cone for an emitter's glow, by the light `arriving` at the place per watt without the
  /// inverse square. Returns the emitter's light there.
  double weigh(const Glow& glow, const Vec3& place, double arriving, CachedLight cached);
  /// Likewise for a mirror image of an emitter.
  double weigh(const EmitterImage& image, const Vec3& place);

  std::vector<Glow> by_emitter_;
  std::vector<uint32_t> brightest_;  // numbers of those with the most glow
  std::vector<Cone> cones_;
  double aimed_ = 0;
  bool aims_ = true, mirrors_ = false;
};

/// Whether paths are guided to mirror images: in smoke, if there is any specular surface.
inline bool aims_at_mirrors(const CompiledScene& scene) {
  return scene.features.media != MediaNeed::none && scene.features.surfaces;
}

/// Radius around an emitter within which smoke counts as its glow: the range that voxels do not
/// resolve.
Real glow_reach_m(const CompiledScene& scene);
/// The point in front of an emitter where its glow is brightest; its face may itself bound the
/// smoke.
Vec3 before_face(const CompiledScene& scene, uint32_t emitter, Real glow_radius);
/// Power in all bands, weighted by luminance and colour.
double power_seen(const CompiledScene& scene, const CompiledEmitter& emitter);

/// Share of a flame's light that surfaces within its glow reflect. 0 for luminaires: they light
/// surfaces beside them little, or so evenly that guiding gains nothing.
template <class Resolver>
double reflected_beside(const CompiledScene& scene, uint32_t emitter, const Glow& glow,
                        Resolver& resolver) {
  const CompiledEmitter& e = scene.emitters[emitter];
  if (e.kind != EmitterKind::volume) return 0;
  Random random(0, RandomStream::picture, 2);
  double sum = 0;
  for (int i = 0; i < limits::glow_rays; ++i) {
    random.start(uint64_t{emitter} * limits::glow_rays + static_cast<uint64_t>(i));
    const EmissionPoint point = emission_point(scene, e, random, resolver);
    Ray ray;
    ray.direction = emission_direction(e, point, random, resolver);
    ray.origin = point.position;
    ray.length = 2 * glow.radius;
    const Hit hit = resolver.nearest(ray);
    if (!hit.found()) continue;
    const TriangleRecord& t = *hit.triangle;
    if (glm::length(t.at(hit.u, hit.v) - glow.centre) > glow.radius) continue;
    const size_t met = glm::dot(t.unit_normal(), ray.direction) < 0 ? 0 : 1;
    const auto band = static_cast<size_t>(scene.bands.count() / 2);
    sum += static_cast<double>(scene.lambert_fraction[(t.surface * 2 + met) *
                                                          static_cast<size_t>(scene.bands.count()) +
                                                      band]) *
           0x1p-32;
  }
  return sum / limits::glow_rays;
}

/// The glows of a scene's emitters, by number; none if there is no smoke. Suspends: where the
/// resolver does.
template <class Resolver>
std::vector<Glow> glows_of(const CompiledScene& scene, Resolver& resolver) {
  std::vector<Glow> out;
  if (scene.features.media == MediaNeed::none) return out;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const CompiledEmitter& e = scene.emitters[i];
    const EmitterBound bound = emitter_bound(scene, i);
    Glow glow{bound.centre, bound.radius + glow_reach_m(scene), 0, 0, 0, bound.radius};
    if (e.distribution != Distribution::collimated) glow.power = power_seen(scene, e);
    const Vec3 before = before_face(scene, i, glow.radius);
    double scattering = 0;
    for_each_medium_at(
        scene.media, scene.bands.count() / 2, before, resolver,
        [&](int, int, double sigma, double albedo) { scattering += sigma * albedo; });
    const double reflected = reflected_beside(scene, i, glow, resolver);
    const double share = reflected - std::expm1(-scattering * static_cast<double>(glow.radius));
    if (glow.power > 0 && share > limits::min_glow) glow.share = share;
    if (glow.power > 0 && reflected > limits::min_glow) glow.reflected = reflected;
    out.push_back(glow);
  }
  return out;
}

}  // namespace luxodus
