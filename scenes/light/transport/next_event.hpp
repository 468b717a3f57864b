// Next-event estimation for eye paths: adds the light of an emitter that a surface or a medium
// scatters into a path, by sampling a point of one emitter. A path may also hit an emitter by its
// own direction, and in smoke a point near an emitter may be sampled first (equiangular.hpp). The
// balance heuristic (E. Veach, L. Guibas, "Optimally combining sampling techniques", SIGGRAPH 1995)
// combines these techniques: sampling emitters alone has unbounded variance near one (1/r2), and
// hits alone are rare far from it. Not here: the path itself (path_tracer.hpp) and the choice of
// the emitter (emitter_choice.hpp). Thread rule: one NextEvent per thread or fiber.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/equiangular.hpp"
#include "scenes/light/transport/connect.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/emitter_choice.hpp"
#include "scenes/light/transport/glow_guide.hpp"
#include "scenes/light/transport/group_light.hpp"
#include "scenes/light/transport/media_bands.hpp"
#include "scenes/light/transport/path_bands.hpp"
#include "scenes/light/transport/radiance_cache.hpp"

namespace luxodus {

/// A ray segment of a path on which it may collide with the medium.
struct RaySegment {
  Ray ray;
  Real end = 0;      // points near emitters are sampled up to here
  double share = 1;  // collisions have the density sigma_t exp(-depth) / share: 1 for a free
                     // flight, less if a collision was forced
  PathBands bands;   // at its start
};

/// The last diffuse scattering event of a path, and the density of the direction sampled there.
struct ScatteringVertex {
  Vec3 place{0};
  double pdf = 0;          // [1/sr]
  Vec3 normal{0};          // of a surface; zero in a medium
  bool in_medium = false;  // the place is `t` along the segment
  RaySegment segment{{}, 0, 1, PathBands::one(0)};
  Real t = 0;
};

template <class Resolver>
class NextEvent {
 public:
  /// `aimed`: whether paths are guided towards the glow around emitters, too. `sight`: data for the
  /// light sampler; null: emitters are chosen by power and distance alone.
  NextEvent(const CompiledScene& scene, Resolver& resolver, Random& random, bool aimed,
            const EmitterSight* sight)
      : scene_(scene),
        resolver_(resolver),
        random_(random),
        choice_(scene),
        media_(scene),
        sight_(sight),
        aimed_(aimed) {}

  const MediaBands& media() const { return media_; }
  const GlowGuide& guide() const { return guide_; }
  /// The guide for directions at a place; the path need not find light that is in the cache
  /// (`cached`). Suspends: where the resolver does, unless emitters were weighted there before.
  const GlowGuide& guide_at(const Vec3& place, const Vec3& normal, CachedLight cached) {
    if (!guide_.empty()) guide_.stand_at(place, seen_at(place, normal), cached);
    return guide_;
  }

  /// Call before each event of a path. Glows are computed at the first: only then may the resolver
  /// wait.
  void start_event(int event) {
    if (aimed_ && !knows_glows_) {
      guide_ = GlowGuide(glows_of(scene_, resolver_), aims_at_mirrors(scene_));
      knows_glows_ = true;
    }
    guide_.start_event(event);
  }

  /// Adds `weight` times the emitted light that a surface reflects against `direction`, by sampling
  /// one emitter. `models`: for the path's bands. `body`: of which the surface is a part, or 0. An
  /// emitter does not light its own body: its intensities were measured with it.
  void add_reflected(const Vec3& place, const Vec3& direction, const Vec3& normal,
                     std::span<const SurfaceModel> models, int body, const PathBands& bands,
                     double weight, GroupLight& into) {
    if (!weigh_at(place, normal, bands)) return;
    const EmitterSample sampled = choice_.choose_at(random_.uniform_double());
    if (sampled.probability <= 0) return;
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    if (body != 0 && body == e.body) return;
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    if (!arrive(e, point, place, bands)) return;
    const Vec3& towards = arriving_.direction;
    const Real cosine = glm::dot(towards, normal);
    if (cosine <= 0) return;
    const double hit = bands.mixed([&](size_t i) {
      return static_cast<double>(surface_pdf(models[i], -direction, towards, normal));
    });
    const double turned = models[0].kind == SurfaceKind::lambertian && !guide_.empty()
                              ? turned_at(place, normal, CachedLight::nothing, towards, hit)
                              : hit;
    const double density = sampled.probability + turned * arriving_.apparent_sr;
    for (size_t i = 0; i < bands.count(); ++i) {
      if (arriving_.irradiance[i] <= 0) continue;
      const double sent =
          arriving_.irradiance[i] / density * static_cast<double>(cosine) *
          static_cast<double>(evaluate_surface(models[i], -direction, towards, normal));
      into.add(e.group, bands.band(i), weight * bands.light(i) * sent);
    }
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] of emitters that the medium on the segment
  /// scatters once against its ray, except where all light is in the cache (`ends`). `flight` was
  /// sampled along the segment, and `passed` is the light of each band after its collision.
  /// Suspends: where the resolver does.
  void add_scattered(const RaySegment& s, const FreeFlight& flight, const BandValues& passed,
                     double weight, GroupLight& into, const PathEnds& ends = {}) {
    const bool emitters_near = weigh_along(s, s.bands);
    if (flight.collided) add_collided(s, flight, emitters_near, passed, weight, into, ends);
    if (emitters_near) add_near_emitter(s, ends, weight, into);
  }

  // add_scattered in two steps, for a segment on which several free flights are sampled: `share` of
  // the segment is one over their number.

  /// Points sampled near an emitter. Returns whether any emitter is near.
  bool add_near(const RaySegment& s, double weight, GroupLight& into, const PathEnds& ends) {
    const bool emitters_near = weigh_along(s, s.bands);
    if (emitters_near) add_near_emitter(s, ends, weight, into);
    return emitters_near;
  }
  /// The collision of a flight. Requires: the last add_near was for this segment.
  void add_collided(const RaySegment& s, const FreeFlight& flight, bool emitters_near,
                    const BandValues& passed, double weight, GroupLight& into,
                    const PathEnds& ends) {
    const CachedLight cached = ends.in_medium(s.ray.origin + s.ray.direction * flight.t);
    if (cached == CachedLight::all) return;
    // A band may scatter even if the hero's band does not.
    if (std::any_of(passed.begin(), passed.begin() + s.bands.count(),
                    [](double light) { return light > 0; }))
      add_at_collision(s, flight, emitters_near, passed, weight, into, cached);
  }

  /// Balance-heuristic weight of an emitter hit at `point` by the path's own direction.
  /// `apparent_sr`: from `apparent_solid_angle`, at the place of the last scattering. Callers hold
  /// a hit, so no cell of space may be learned here: learning uses the resolver, which may drop the
  /// hit's cell. None is new: emitters were sampled at that place, and add_scattered or add_near
  /// has already used the cells along its segment.
  double weight_of_hit(const ScatteringVertex& vertex, size_t emitter, const Vec3& point,
                       double apparent_sr, const PathBands& bands) {
    const double hit = vertex.pdf * apparent_sr;
    if (!(hit > 0)) return 0;
    // A medium may scatter on the very face: no sample of the emitter connects over no distance.
    if (std::isinf(hit)) return 1;
    double sampled =
        weigh_at(vertex.place, vertex.normal, bands) ? choice_.probability_at(emitter) : 0;
    if (vertex.in_medium && weigh_along(vertex.segment, bands))
      sampled += drawn_near(vertex.segment, vertex.place, vertex.t, emitter, point);
    return hit / (hit + sampled);
  }

  /// Solid angle [sr] that an emitter would subtend at a place if all of it were seen as the given
  /// point: the ratio of the densities of hits and of samples of the point. 0 if rays cannot hit
  /// it.
  double apparent_solid_angle(const CompiledEmitter& e, const EmissionPoint& point,
                              const Vec3& to_place, Real distance) {
    if (e.kind != EmitterKind::volume) return apparent_face(e, point, to_place, distance);
    // Hits of a flame select lines. Any density along them can serve as weight: one over its size.
    const double density =
        scene_.media.emission_density(static_cast<int>(e.medium), point.position, resolver_);
    const auto size = static_cast<double>(std::max({e.size.x, e.size.y, e.size.z}));
    const auto d = static_cast<double>(distance);
    return density > 0 && size > 0 ? 1 / (density * size * d * d) : 0;
  }

 private:
  /// Weights emitters as seen from a place. `normal`: of a surface; zero in a medium.
  bool weigh_at(const Vec3& place, const Vec3& normal, const PathBands& bands) {
    return choice_.weigh_at(place, normal, chosen_by(bands), seen_at(place, normal));
  }
  /// Weights emitters near a segment. False if there is none.
  bool weigh_along(const RaySegment& s, const PathBands& bands) {
    if (sight_ == nullptr) return choice_.weigh_along(s.ray, s.end, chosen_by(bands));
    return choice_.weigh_near(
        s.ray, s.end, chosen_by(bands),
        [&](const Vec3& place) -> const CellSight& { return *seen_at(place, Vec3(0)); });
  }
  const CellSight* seen_at(const Vec3& place, const Vec3& normal) {
    return sight_ != nullptr ? &sight_->at(place, normal, resolver_) : nullptr;
  }

  /// Irradiance [W/m2] from a sampled point of an emitter, normal to the connection, by the path's
  /// bands.
  struct LightSample {
    Vec3 direction{0};  // towards the emitter
    double apparent_sr = 0;
    BandValues irradiance;
  };

  /// Density [1/sr] of directions at a place, guided ones included; the phase function or surface
  /// alone has `own`.
  double turned_at(const Vec3& place, const Vec3& normal, CachedLight cached, const Vec3& direction,
                   double own) {
    if (guide_.empty()) return own;
    return guide_at(place, normal, cached).density(direction, own);
  }

  /// Emitters are chosen for all bands of a path together.
  static int chosen_by(const PathBands& bands) { return bands.many() ? all_bands : bands.hero(); }

  /// Evaluates the connection into `arriving_`. False if no band receives light.
  bool arrive(const CompiledEmitter& e, const EmissionPoint& point, const Vec3& place,
              const PathBands& bands) {
    const ShadowRay c =
        connect(scene_, place, point.position, point.axis, e.kind != EmitterKind::volume);
    if (!(c.distance > 0)) return false;
    const auto density =
        static_cast<double>(directional_density(e, point, -c.ray.direction, resolver_));
    if (density <= 0) return false;
    std::fill_n(solid_.begin(), bands.count(), 1.0);
    OwnBody own{e.body};
    const bool passes =
        passes_solids(scene_, c.ray, c.ray.length, resolver_, own,
                      [&](const CompiledMaterial& pane, Real cosine) {
                        for (size_t i = 0; i < bands.count(); ++i)
                          solid_[i] *= static_cast<double>(pane_transmittance(
                              pane.by_band[static_cast<size_t>(bands.band(i))], cosine));
                      });
    if (!passes) return false;
    media_.transmittances(c.ray, c.distance, bands, through_, resolver_);
    const auto d = static_cast<double>(c.distance);
    bool any = false;
    for (size_t i = 0; i < bands.count(); ++i) {
      const double power = e.power_w[static_cast<size_t>(bands.band(i))];
      arriving_.irradiance[i] = power * density * solid_[i] * through_[i] / (d * d);
      any |= arriving_.irradiance[i] > 0;
    }
    if (!any) return false;
    arriving_.direction = c.ray.direction;
    // Paths that meet the body do not count hits of the emitter behind it: sampling counts alone.
    arriving_.apparent_sr =
        own.surfaces_met > 0 ? 0 : apparent_solid_angle(e, point, -c.ray.direction, c.distance);
    return true;
  }

  // ---- light scattered into a segment of a path -----------------------------------------------

  /// Writes the extinction of each band at a place to `sigma_`. False if all are zero.
  bool may_collide_at(const RaySegment& s, const Vec3& place) {
    media_.extinctions(place, s.bands, sigma_, resolver_);
    return std::any_of(sigma_.begin(), sigma_.begin() + s.bands.count(),
                       [](double sigma) { return sigma > 0; });
  }

  /// Writes the density [1/m] of collisions of each band at a point of the segment to `here_`.
  /// Returns that of the hero mixture. Requires: may_collide_at was called for this point.
  double density_of_collisions(const RaySegment& s, Real t) {
    media_.transmittances(s.ray, t, s.bands, through_, resolver_);
    for (size_t i = 0; i < s.bands.count(); ++i) here_[i] = sigma_[i] * through_[i] / s.share;
    return s.bands.mixed([&](size_t i) { return here_[i]; });
  }

  /// Equiangular sampling of a segment with respect to a point of an emitter.
  static EquiangularLine seen_from(const Vec3& point, const RaySegment& s) {
    return {glm::dvec3(s.ray.origin), glm::dvec3(s.ray.direction), static_cast<double>(s.end),
            glm::dvec3(point)};
  }

  /// Density with which `add_near_emitter` samples a place with a point of the emitter, relative to
  /// the density of collisions there. Requires: the last weigh_along was for this segment.
  double drawn_near(const RaySegment& s, const Vec3& place, Real t, size_t emitter,
                    const Vec3& point) {
    const double share = choice_.probability_along(emitter);
    if (!(share > 0)) return 0;
    const double here = may_collide_at(s, place) ? density_of_collisions(s, t) : 0;
    if (!(here > 0)) return std::numeric_limits<double>::infinity();
    return share * seen_from(point, s).density(static_cast<double>(t)) / here;
  }

  /// Samples an emitter at the collision of a flight.
  void add_at_collision(const RaySegment& s, const FreeFlight& flight, bool emitters_near,
                        const BandValues& passed, double weight, GroupLight& into,
                        CachedLight cached) {
    const Vec3 place = s.ray.origin + s.ray.direction * flight.t;
    if (!weigh_at(place, Vec3(0), s.bands)) return;
    const EmitterSample sampled = choice_.choose_at(random_.uniform_double());
    if (sampled.probability <= 0) return;
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    if (!arrive(e, point, place, s.bands)) return;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const auto turned =
        static_cast<double>(evaluate(phase, glm::dot(arriving_.direction, s.ray.direction)));
    double probability =
        sampled.probability +
        turned_at(place, Vec3(0), cached, arriving_.direction, turned) * arriving_.apparent_sr;
    if (emitters_near)
      probability += drawn_near(s, place, flight.t, sampled.emitter, point.position);
    for (size_t i = 0; i < s.bands.count(); ++i) {
      const double arrived = weight * s.bands.light(i) * s.share * passed[i];
      into.add(e.group, s.bands.band(i), arrived * turned * arriving_.irradiance[i] / probability);
    }
  }

  /// Chooses the emitter first, then a point of the segment by equiangular sampling.
  void add_near_emitter(const RaySegment& s, const PathEnds& ends, double weight,
                        GroupLight& into) {
    const auto [chosen, share] = choice_.choose_along(random_.uniform_double());
    if (!(share > 0)) return;
    const CompiledEmitter& e = scene_.emitters[chosen];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const EquiangularLine line = seen_from(point.position, s);
    const auto t = static_cast<Real>(line.sample(random_.uniform_double()));
    const Vec3 place = s.ray.origin + s.ray.direction * t;
    const CachedLight cached = ends.in_medium(place);
    if (cached == CachedLight::all) return;
    if (!may_collide_at(s, place) || !arrive(e, point, place, s.bands)) return;
    const double here = density_of_collisions(s, t);
    if (!(here > 0)) return;
    weigh_at(place, Vec3(0), s.bands);
    const double drawn = share * line.density(static_cast<double>(t));
    const double sampled = choice_.probability_at(chosen);
    const Real cosine = glm::dot(arriving_.direction, s.ray.direction);
    guide_at(place, Vec3(0), cached);
    for (size_t i = 0; i < s.bands.count(); ++i) {
      if (!(sigma_[i] > 0)) continue;
      double scattered = 0;  // per medium, since each has its own phase function
      for_each_medium_at(scene_.media, s.bands.band(i), place, resolver_,
                         [&](int, int phase, double sigma, double albedo) {
                           const auto turned = static_cast<double>(
                               evaluate(scene_.phases[static_cast<size_t>(phase)], cosine));
                           const double hit = guide_.density(arriving_.direction, turned);
                           scattered += sigma * albedo * turned /
                                        (drawn + here * (sampled + hit * arriving_.apparent_sr));
                         });
      // The transmittance up to here is already part of the density of collisions.
      const double arrived = weight * s.bands.light(i) * s.share * (here_[i] / sigma_[i]);
      into.add(e.group, s.bands.band(i), arrived * scattered * arriving_.irradiance[i]);
    }
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random& random_;
  EmitterChoice choice_;
  MediaBands media_;
  const EmitterSight* sight_;
  bool aimed_, knows_glows_ = false;
  GlowGuide guide_;

  // Results of the last call, by the path's bands.
  LightSample arriving_;
  BandValues solid_, through_, sigma_, here_;
};

}  // namespace luxodus
