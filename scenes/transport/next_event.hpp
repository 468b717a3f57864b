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

#include "runtime/core/random.hpp"
#include "scenes/geometry/real.hpp"
#include "scenes/optics/equiangular.hpp"
#include "scenes/transport/connect.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/emitter_choice.hpp"
#include "scenes/transport/group_light.hpp"
#include "scenes/transport/known_radiance.hpp"

namespace luxodus {

/// A straight part of a path, on which it may collide with the medium.
struct Stretch {
  Ray ray;
  Real end = 0;      // places near emitters are drawn up to here
  double share = 1;  // collisions have the density sigma_t exp(-depth) / share: 1 if the flight was
                     // free, less if a collision was forced
  int band = 0;
};

/// The last event that spread a path over directions, and how densely it drew the one taken.
struct PathTurn {
  Vec3 place{0};
  double pdf = 0;          // [1/sr]
  bool in_medium = false;  // then the place is `t` along the stretch
  Stretch stretch;
  Real t = 0;
};

template <class Resolver>
class NextEvent {
 public:
  NextEvent(const CompiledScene& scene, Resolver& resolver, Random& random)
      : scene_(scene), resolver_(resolver), random_(random), choice_(scene) {}

  /// Light of an emitter that a surface sends against `direction`. One emitter is sampled.
  SourceLight reflected(const Vec3& place, const Vec3& direction, const Vec3& normal,
                        const SurfaceModel& model, int band) {
    if (!choice_.weigh_at(place, band)) return {};
    const EmitterSample sampled = choice_.choose_at(random_.uniform_double());
    if (sampled.probability <= 0) return {};
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const Arriving a = light_from(e, point, place, band);
    const Real cosine = glm::dot(a.direction, normal);
    if (a.irradiance <= 0 || cosine <= 0) return {};
    const auto hit = static_cast<double>(surface_pdf(model, -direction, a.direction, normal));
    return {e.group,
            a.irradiance / (sampled.probability + hit * a.apparent_sr) *
                static_cast<double>(cosine) *
                static_cast<double>(evaluate_surface(model, -direction, a.direction, normal))};
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] that emitters send to the stretch and the medium
  /// there turns against its ray, once; but for places where `known` has all light. `flight` is one
  /// along it. Suspends: where the resolver does.
  void add_scattered(const Stretch& s, const FreeFlight& flight, double weight, GroupLight& into,
                     const KnownRadiance* known = nullptr) {
    const bool emitters_near = choice_.weigh_along(s.ray, s.end, s.band);
    const auto is_known = [&](Real t) {
      return known != nullptr && known->knows(s.ray.origin + s.ray.direction * t);
    };
    if (flight.collided && flight.albedo > 0 && !is_known(flight.t))
      add_at_collision(s, flight, emitters_near, weight * s.share * flight.albedo, into);
    if (emitters_near) add_near_emitter(s, is_known, weight, into);
  }

  /// Weight of light that a path meets at a point of an emitter by its own direction.
  /// `apparent_sr`: as of `apparent_solid_angle`, from the place of the turn.
  double weight_of_hit(const PathTurn& turn, size_t emitter, const Vec3& point, double apparent_sr,
                       int band) {
    const double hit = turn.pdf * apparent_sr;
    if (!(hit > 0)) return 0;
    double sampled = choice_.weigh_at(turn.place, band) ? choice_.probability_at(emitter) : 0;
    if (turn.in_medium && choice_.weigh_along(turn.stretch.ray, turn.stretch.end, band))
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
  /// Irradiance [W/m2] of a point of an emitter, normal to the line between.
  struct Arriving {
    Vec3 direction{0};  // towards the emitter
    double irradiance = 0;
    double apparent_sr = 0;
  };

  Arriving light_from(const CompiledEmitter& e, const EmissionPoint& point, const Vec3& place,
                      int band) {
    const ShadowRay c =
        connect(scene_, place, point.position, point.axis, e.kind != EmitterKind::volume);
    if (!(c.distance > 0)) return {};
    const auto density =
        static_cast<double>(directional_density(e, point, -c.ray.direction, resolver_));
    if (density <= 0) return {};
    const double solid = solid_transmittance(scene_, c.ray, c.ray.length, band, resolver_);
    if (solid <= 0) return {};
    const double medium = medium_transmittance(scene_, c.ray, c.distance, band, resolver_);
    const auto d = static_cast<double>(c.distance);
    return {c.ray.direction,
            e.power_w[static_cast<size_t>(band)] * density * solid * medium / (d * d),
            apparent_solid_angle(e, point, -c.ray.direction, c.distance)};
  }

  // ---- light scattered into a stretch of a path
  // -------------------------------------------------------------------------

  double collision_density(const Stretch& s, Real t, double sigma_t) {
    return sigma_t * medium_transmittance(scene_, s.ray, t, s.band, resolver_) / s.share;
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
    const double here =
        collision_density(s, t, extinction_at(scene_.media, s.band, place, resolver_));
    if (!(here > 0)) return std::numeric_limits<double>::infinity();
    return choice_.probability_along(emitter) *
           seen_from(point, s).density(static_cast<double>(t)) / here;
  }

  /// The place is where a flight has collided; an emitter is sampled there.
  void add_at_collision(const Stretch& s, const FreeFlight& flight, bool emitters_near,
                        double weight, GroupLight& into) {
    const Vec3 place = s.ray.origin + s.ray.direction * flight.t;
    if (!choice_.weigh_at(place, s.band)) return;
    const EmitterSample sampled = choice_.choose_at(random_.uniform_double());
    if (sampled.probability <= 0) return;
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const Arriving a = light_from(e, point, place, s.band);
    if (a.irradiance <= 0) return;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const auto turned =
        static_cast<double>(evaluate(phase, glm::dot(a.direction, s.ray.direction)));
    double probability = sampled.probability + turned * a.apparent_sr;
    if (emitters_near)
      probability += drawn_near(s, place, flight.t, sampled.emitter, point.position);
    into.add(e.group, weight * turned * a.irradiance / probability);
  }

  /// The emitter is chosen first, and the place as its light falls on the stretch.
  template <class IsKnown>
  void add_near_emitter(const Stretch& s, IsKnown&& is_known, double weight, GroupLight& into) {
    const auto [chosen, share] = choice_.choose_along(random_.uniform_double());
    if (!(share > 0)) return;
    const CompiledEmitter& e = scene_.emitters[chosen];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const EquiangularLine line = seen_from(point.position, s);
    const auto t = static_cast<Real>(line.sample(random_.uniform_double()));
    if (is_known(t)) return;
    const Vec3 place = s.ray.origin + s.ray.direction * t;
    const double sigma_t = extinction_at(scene_.media, s.band, place, resolver_);
    if (!(sigma_t > 0)) return;
    const Arriving a = light_from(e, point, place, s.band);
    if (a.irradiance <= 0) return;
    const double here = collision_density(s, t, sigma_t);
    choice_.weigh_at(place, s.band);
    const double drawn = share * line.density(static_cast<double>(t));
    const double sampled = choice_.probability_at(chosen);
    const Real cosine = glm::dot(a.direction, s.ray.direction);
    double scattered = 0;  // of each medium here, since each turns a path in its own way
    for_each_medium_at(
        scene_.media, s.band, place, resolver_, [&](int, int phase, double sigma, double albedo) {
          const auto turned =
              static_cast<double>(evaluate(scene_.phases[static_cast<size_t>(phase)], cosine));
          scattered +=
              sigma * albedo * turned / (drawn + here * (sampled + turned * a.apparent_sr));
        });
    // What passes up to here is in the density of collisions already.
    into.add(e.group, weight * s.share * (here / sigma_t) * scattered * a.irradiance);
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random& random_;
  EmitterChoice choice_;
};

}  // namespace luxodus
