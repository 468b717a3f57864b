// Next-event estimation for paths from the eye: light of emitters that a surface or a medium turns
// into a path, by sampling a point of one emitter. A path may also hit an emitter by its own
// direction, and in smoke a place near an emitter may be drawn first (equiangular.hpp). The balance
// heuristic (E. Veach, L. Guibas, "Optimally combining sampling techniques", SIGGRAPH 1995) weights
// these ways against each other, so that every pair of places counts once and none is left to a
// way that seldom finds it: sampling alone has no bounded variance near an emitter (1/r2), hits
// alone are rare far from it. Not here: the path itself (path_tracer.hpp) and which emitter is
// chosen (emitter_choice.hpp). Thread rule: one NextEvent per thread or fiber.
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
#include "scenes/light/transport/known_radiance.hpp"
#include "scenes/light/transport/media_bands.hpp"
#include "scenes/light/transport/path_bands.hpp"

namespace luxodus {

/// A straight part of a path, on which it may collide with the medium.
struct Stretch {
  Ray ray;
  Real end = 0;      // places near emitters are drawn up to here
  double share = 1;  // collisions have the density sigma_t exp(-depth) / share: 1 if the flight was
                     // free, less if a collision was forced
  PathBands bands;   // before it
};

/// The last event that spread a path over directions, and how densely it drew the one taken.
struct PathTurn {
  Vec3 place{0};
  double pdf = 0;          // [1/sr]
  Vec3 normal{0};          // of a surface
  bool in_medium = false;  // then the place is `t` along the stretch
  Stretch stretch{{}, 0, 1, PathBands::one(0)};
  Real t = 0;
};

template <class Resolver>
class NextEvent {
 public:
  /// `aimed`: whether paths are also turned towards the glow around emitters.
  /// `sight`: what emitters are chosen by; null: by power and distance alone.
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
  /// The guide for turns at a place, where of the light so much is known: a path need not find
  /// that. Suspends: where the resolver does, unless emitters have been weighed there before.
  const GlowGuide& guide_at(const Vec3& place, const Vec3& normal, Known known) {
    if (!guide_.empty()) guide_.stand_at(place, seen_at(place, normal), known);
    return guide_;
  }

  /// Before an event of a path. Glows are found at the first: only then may the resolver wait.
  void start_event(int event) {
    if (aimed_ && !knows_glows_) {
      guide_ = GlowGuide(glows_of(scene_, resolver_), aims_at_mirrors(scene_));
      knows_glows_ = true;
    }
    guide_.start_event(event);
  }

  /// Adds `weight` times the light of an emitter that a surface sends against `direction`. One
  /// emitter is sampled. `models`: of the path's bands.
  void add_reflected(const Vec3& place, const Vec3& direction, const Vec3& normal,
                     std::span<const SurfaceModel> models, const PathBands& bands, double weight,
                     GroupLight& into) {
    if (!weigh_at(place, normal, bands)) return;
    const EmitterSample sampled = choice_.choose_at(random_.uniform_double());
    if (sampled.probability <= 0) return;
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    if (!arrive(e, point, place, bands)) return;
    const Vec3& towards = arriving_.direction;
    const Real cosine = glm::dot(towards, normal);
    if (cosine <= 0) return;
    const double hit = bands.mixed([&](size_t i) {
      return static_cast<double>(surface_pdf(models[i], -direction, towards, normal));
    });
    const double turned = models[0].kind == SurfaceKind::lambertian && !guide_.empty()
                              ? turned_at(place, normal, Known::nothing, towards, hit)
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

  /// Adds `weight` times the radiance [W/(m2 sr)] that emitters send to the stretch and the medium
  /// there turns against its ray, once; but for places where all light is known (`ends`). `flight`
  /// is one along it, and `passed` is what its collision lets go on of the light of each band.
  /// Suspends: where the resolver does.
  void add_scattered(const Stretch& s, const FreeFlight& flight, const BandValues& passed,
                     double weight, GroupLight& into, const PathEnds& ends = {}) {
    const bool emitters_near = weigh_along(s, s.bands);
    if (flight.collided) add_collided(s, flight, emitters_near, passed, weight, into, ends);
    if (emitters_near) add_near_emitter(s, ends, weight, into);
  }

  // The same in two, for a stretch of several flights. Each of them counts by the stretch's share.

  /// Of places that are drawn near an emitter. Returns whether any emitter is near.
  bool add_near(const Stretch& s, double weight, GroupLight& into, const PathEnds& ends) {
    const bool emitters_near = weigh_along(s, s.bands);
    if (emitters_near) add_near_emitter(s, ends, weight, into);
    return emitters_near;
  }
  /// Of the place where a flight has collided. Requires: the last add_near was of this stretch.
  void add_collided(const Stretch& s, const FreeFlight& flight, bool emitters_near,
                    const BandValues& passed, double weight, GroupLight& into,
                    const PathEnds& ends) {
    const Known known = ends.in_medium(s.ray.origin + s.ray.direction * flight.t);
    if (known == Known::all) return;
    // A band may be scattered where the hero's is not.
    if (std::any_of(passed.begin(), passed.begin() + s.bands.count(),
                    [](double light) { return light > 0; }))
      add_at_collision(s, flight, emitters_near, passed, weight, into, known);
  }

  /// Weight of light that a path of such bands meets at a point of an emitter by its own direction.
  /// `apparent_sr`: as of `apparent_solid_angle`, from the place of the turn. Callers hold a hit,
  /// so no cell of space may be learned here: that asks the resolver, which may drop what the hit
  /// is of. None is new: emitters were sampled at the place of the turn, and add_scattered or
  /// add_near of its stretch has asked the cells along that before.
  double weight_of_hit(const PathTurn& turn, size_t emitter, const Vec3& point, double apparent_sr,
                       const PathBands& bands) {
    const double hit = turn.pdf * apparent_sr;
    if (!(hit > 0)) return 0;
    double sampled = weigh_at(turn.place, turn.normal, bands) ? choice_.probability_at(emitter) : 0;
    if (turn.in_medium && weigh_along(turn.stretch, bands))
      sampled += drawn_near(turn.stretch, turn.place, turn.t, emitter, point);
    return hit / (hit + sampled);
  }

  /// The solid angle [sr] at a place that an emitter would fill if it all looked as at the point:
  /// the ratio in which hits and samples of the point are spread. 0 where rays cannot hit it.
  double apparent_solid_angle(const CompiledEmitter& e, const EmissionPoint& point,
                              const Vec3& to_place, Real distance) {
    if (e.kind != EmitterKind::volume) return apparent_face(e, point, to_place, distance);
    // Of a flame, hits find lines. Any density along them serves as weight: one over its size.
    const double density =
        scene_.media.emission_density(static_cast<int>(e.medium), point.position, resolver_);
    const auto size = static_cast<double>(std::max({e.size.x, e.size.y, e.size.z}));
    const auto d = static_cast<double>(distance);
    return density > 0 && size > 0 ? 1 / (density * size * d * d) : 0;
  }

 private:
  /// Weighs emitters as seen from a place. `normal`: of a surface; zero in a medium.
  bool weigh_at(const Vec3& place, const Vec3& normal, const PathBands& bands) {
    return choice_.weigh_at(place, normal, chosen_by(bands), seen_at(place, normal));
  }
  /// Weighs emitters that are near a stretch. False where none is.
  bool weigh_along(const Stretch& s, const PathBands& bands) {
    if (sight_ == nullptr) return choice_.weigh_along(s.ray, s.end, chosen_by(bands));
    return choice_.weigh_near(
        s.ray, s.end, chosen_by(bands),
        [&](const Vec3& place) -> const CellSight& { return *seen_at(place, Vec3(0)); });
  }
  const CellSight* seen_at(const Vec3& place, const Vec3& normal) {
    return sight_ != nullptr ? &sight_->at(place, normal, resolver_) : nullptr;
  }

  /// Irradiance [W/m2] of a point of an emitter, normal to the line between, by the path's bands.
  struct Arriving {
    Vec3 direction{0};  // towards the emitter
    double apparent_sr = 0;
    BandValues irradiance;
  };

  /// Density [1/sr] of turns at a place, where the phase function or the surface alone has `own`.
  double turned_at(const Vec3& place, const Vec3& normal, Known known, const Vec3& direction,
                   double own) {
    if (guide_.empty()) return own;
    return guide_at(place, normal, known).density(direction, own);
  }

  /// Emitters are chosen for all bands of a path at once.
  static int chosen_by(const PathBands& bands) { return bands.many() ? all_bands : bands.hero(); }

  /// Into `arriving_`. False: none of any band.
  bool arrive(const CompiledEmitter& e, const EmissionPoint& point, const Vec3& place,
              const PathBands& bands) {
    const ShadowRay c =
        connect(scene_, place, point.position, point.axis, e.kind != EmitterKind::volume);
    if (!(c.distance > 0)) return false;
    const auto density =
        static_cast<double>(directional_density(e, point, -c.ray.direction, resolver_));
    if (density <= 0) return false;
    std::fill_n(solid_.begin(), bands.count(), 1.0);
    const bool passes = passes_solids(
        scene_, c.ray, c.ray.length, resolver_, [&](const CompiledMaterial& pane, Real cosine) {
          for (size_t i = 0; i < bands.count(); ++i)
            solid_[i] *= static_cast<double>(
                pane_transmittance(pane.by_band[static_cast<size_t>(bands.band(i))], cosine));
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
    arriving_.apparent_sr = apparent_solid_angle(e, point, -c.ray.direction, c.distance);
    return true;
  }

  // ---- light scattered into a stretch of a path
  // -------------------------------------------------------------------------

  /// Extinction of each band at a place, into `sigma_`. False: none.
  bool may_collide_at(const Stretch& s, const Vec3& place) {
    media_.extinctions(place, s.bands, sigma_, resolver_);
    return std::any_of(sigma_.begin(), sigma_.begin() + s.bands.count(),
                       [](double sigma) { return sigma > 0; });
  }

  /// Density [1/m] of collisions of each band at a place of the stretch, into `here_`. Returns that
  /// of its heroes together. Requires: may_collide_at was of this place.
  double density_of_collisions(const Stretch& s, Real t) {
    media_.transmittances(s.ray, t, s.bands, through_, resolver_);
    for (size_t i = 0; i < s.bands.count(); ++i) here_[i] = sigma_[i] * through_[i] / s.share;
    return s.bands.mixed([&](size_t i) { return here_[i]; });
  }

  /// Places on a stretch as a point of an emitter sees them.
  static EquiangularLine seen_from(const Vec3& point, const Stretch& s) {
    return {glm::dvec3(s.ray.origin), glm::dvec3(s.ray.direction), static_cast<double>(s.end),
            glm::dvec3(point)};
  }

  /// How densely `add_near_emitter` draws a place with a point of the emitter, per density of
  /// collisions at that place. Requires: the last weigh_along was of this stretch.
  double drawn_near(const Stretch& s, const Vec3& place, Real t, size_t emitter,
                    const Vec3& point) {
    const double share = choice_.probability_along(emitter);
    if (!(share > 0)) return 0;
    const double here = may_collide_at(s, place) ? density_of_collisions(s, t) : 0;
    if (!(here > 0)) return std::numeric_limits<double>::infinity();
    return share * seen_from(point, s).density(static_cast<double>(t)) / here;
  }

  /// The place is where a flight has collided; an emitter is sampled there.
  void add_at_collision(const Stretch& s, const FreeFlight& flight, bool emitters_near,
                        const BandValues& passed, double weight, GroupLight& into, Known known) {
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
        turned_at(place, Vec3(0), known, arriving_.direction, turned) * arriving_.apparent_sr;
    if (emitters_near)
      probability += drawn_near(s, place, flight.t, sampled.emitter, point.position);
    for (size_t i = 0; i < s.bands.count(); ++i) {
      const double arrived = weight * s.bands.light(i) * s.share * passed[i];
      into.add(e.group, s.bands.band(i), arrived * turned * arriving_.irradiance[i] / probability);
    }
  }

  /// The emitter is chosen first, and the place as its light falls on the stretch.
  void add_near_emitter(const Stretch& s, const PathEnds& ends, double weight, GroupLight& into) {
    const auto [chosen, share] = choice_.choose_along(random_.uniform_double());
    if (!(share > 0)) return;
    const CompiledEmitter& e = scene_.emitters[chosen];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const EquiangularLine line = seen_from(point.position, s);
    const auto t = static_cast<Real>(line.sample(random_.uniform_double()));
    const Vec3 place = s.ray.origin + s.ray.direction * t;
    const Known known = ends.in_medium(place);
    if (known == Known::all) return;
    if (!may_collide_at(s, place) || !arrive(e, point, place, s.bands)) return;
    const double here = density_of_collisions(s, t);
    if (!(here > 0)) return;
    weigh_at(place, Vec3(0), s.bands);
    const double drawn = share * line.density(static_cast<double>(t));
    const double sampled = choice_.probability_at(chosen);
    const Real cosine = glm::dot(arriving_.direction, s.ray.direction);
    guide_at(place, Vec3(0), known);
    for (size_t i = 0; i < s.bands.count(); ++i) {
      if (!(sigma_[i] > 0)) continue;
      double scattered = 0;  // of each medium here, since each turns a path in its own way
      for_each_medium_at(scene_.media, s.bands.band(i), place, resolver_,
                         [&](int, int phase, double sigma, double albedo) {
                           const auto turned = static_cast<double>(
                               evaluate(scene_.phases[static_cast<size_t>(phase)], cosine));
                           const double hit = guide_.density(arriving_.direction, turned);
                           scattered += sigma * albedo * turned /
                                        (drawn + here * (sampled + hit * arriving_.apparent_sr));
                         });
      // What passes up to here is in the density of collisions already.
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

  // Of the last call that has filled them, by the path's bands.
  Arriving arriving_;
  BandValues solid_, through_, sigma_, here_;
};

}  // namespace luxodus
