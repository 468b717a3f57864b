// Directions towards the glow around emitters in smoke. Near an emitter smoke is bright, and a path
// that is turned by a phase function or a surface alone seldom goes there, but brings much when it
// does. So a part of the turns are aimed at spheres around emitters. Whoever turns a path weights
// both ways by the balance heuristic: `density` is that of aimed turns. What is known of emitters
// at a place (emitter_sight.hpp) says which are worth it there. In smoke turns are aimed at
// emitters in mirrors, too (emitter_images.hpp). Not here: light that emitters send straight
// (next_event.hpp). One thread or fiber at a time.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/known_radiance.hpp"

namespace luxodus {

namespace limits {
/// Emitters that are aimed at, those of the most glow: each costs time at every turn of a path.
inline constexpr size_t glows = 16;
/// Of the turns at a place, those that are aimed at most.
inline constexpr double max_aimed = 0.9;
/// Tangent of the half angle of what is aimed at, from within a sphere as well.
inline constexpr Real widest_slope = 3;
/// Events of a path that may be aimed.
inline constexpr int aimed_events = 8;
/// Share of an emitter's light that its glow sends on: less is left to chance. The brightest single
/// paths are those that pass an emitter in thin smoke which nobody aims at.
inline constexpr double min_glow = 0.02;
/// From an emitter, for what surfaces beside it reflect.
inline constexpr int glow_rays = 64;
/// Of the light at a place, what a glow's emitter has at least where that is aimed at.
inline constexpr double min_glow_seen = 0.01;
}  // namespace limits

struct CellSight;
struct EmitterImage;

/// A sphere around an emitter, and how much it glows.
struct Glow {
  Vec3 centre{0};
  Real radius = 0;
  double power = 0;  // of the emitter, in all bands, by how they look
  /// Of its light that smoke and surfaces in the sphere send on, and surfaces alone; 0: not worth
  /// aiming at.
  double share = 0, reflected = 0;
  Real body = 0;  // radius of the emitter itself
};

class GlowGuide {
 public:
  GlowGuide() = default;
  /// Of all emitters, by number; none where there is no smoke. `mirrors`: whether emitters may be
  /// seen in mirrors, which are aimed at as well.
  explicit GlowGuide(std::vector<Glow> glows, bool mirrors = false);

  /// Nothing glows or is mirrored: every turn is as it was.
  bool empty() const { return brightest_.empty() && !mirrors_; }

  /// Turns after so many events are left as they are: weights of many aimed ones would multiply.
  void start_event(int event) { aims_ = event < limits::aimed_events; }
  /// For turns at a place: until the next call. `seen`: what is known of emitters there; null: they
  /// are weighed by power and distance, wherever walls are. `known`: where scattered light is
  /// known, smoke does not count.
  void stand_at(const Vec3& place, const CellSight* seen, Known known);
  /// Share of the turns there that are aimed.
  double aimed() const { return aimed_; }
  /// A direction of an aimed turn, by uniform numbers; `choice` in [0, aimed()).
  Vec3 direction(double choice, Real u, Real v) const;
  /// Density [1/sr] of directions drawn by both ways, where a turn has `own` alone.
  double density(const Vec3& direction, double own) const;

 private:
  struct Cone {
    Vec3 axis{0};
    Real slope = 0;    // tangent of its half angle
    double share = 0;  // of the turns
  };
  /// Returns the light of an emitter at the place, of which `arriving` arrives of a watt without
  /// the inverse square; and aims at its glow by that.
  double weigh(const Glow& glow, const Vec3& place, double arriving, Known known);
  /// The same of an emitter in a mirror.
  double weigh(const EmitterImage& image, const Vec3& place);

  std::vector<Glow> by_emitter_;
  std::vector<uint32_t> brightest_;  // numbers of those with the most glow
  std::vector<Cone> cones_;
  double aimed_ = 0;
  bool aims_ = true, mirrors_ = false;
};

/// Whether turns are aimed at emitters in mirrors: in smoke, where there is any special surface.
inline bool aims_at_mirrors(const CompiledScene& scene) {
  return scene.features.media != MediaNeed::none && scene.features.surfaces;
}

/// How far from an emitter smoke counts as its glow: as far as voxels do not know it.
Real glow_reach_m(const CompiledScene& scene);
/// Within a glow, where it is brightest: the emitter's face may itself be a boundary of the smoke.
Vec3 before_face(const CompiledScene& scene, uint32_t emitter, Real glow_radius);
/// Power of all bands, by how they look.
double power_seen(const CompiledScene& scene, const CompiledEmitter& emitter);

/// Of a flame's light, the share that surfaces within the glow reflect. Luminaires light what is
/// beside them little, or so evenly that aiming at it gains nothing.
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

/// The glows of a scene's emitters, by number; none where there is no smoke. Suspends: where the
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
