// Emitter hits: emitting faces, faces of signs and flames that an eye path hits, each weighted
// against next-event estimation by the balance heuristic (next_event.hpp). One thread or fiber at a
// time; suspends where the resolver does.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/flame_boxes.hpp"
#include "scenes/light/transport/flame_line.hpp"
#include "scenes/light/transport/flame_moment.hpp"
#include "scenes/light/transport/group_light.hpp"
#include "scenes/light/transport/next_event.hpp"
#include "scenes/light/transport/textures.hpp"

namespace luxodus {

namespace limits {
inline constexpr int emitters_per_line = 16;  // emitting faces that one straight line may cross
/// Largest length of a segment on which points are sampled near emitters, relative to the scene's
/// size.
inline constexpr Real longest_line = 4;
}  // namespace limits

/// Length of a segment that is used for sampling near emitters.
inline Real line_end(const CompiledScene& scene, Real length) {
  return std::min(length, limits::longest_line * scene.diagonal_m);
}

/// Which emitter hits a path counts.
enum class EmitterHits {
  none,      // direct light of this place is computed elsewhere
  weighted,  // emitters were sampled, too: balance heuristic
  all,       // no emitter was sampled
};

/// Share of the power that passes a pane or an open surface undeviated.
inline double straight_transmittance(const SurfaceModel& model, Real cos_theta) {
  return model.kind == SurfaceKind::glass_pane
             ? static_cast<double>(pane_transmittance(model, cos_theta))
             : 1;
}

/// A surface of a luminaire's body that a path has met since its last event, or at it.
struct BodyMet {
  int body = 0;
  bool passed = false;         // straight on: a pane or an open surface
  BandValues transmittance{};  // if passed, by the path's bands
};

/// An eye path: its next ray and what it carries.
struct EyePath {
  Ray ray;
  PathBands bands;
  EmitterHits counted;
  double weight;
  GroupLight& into;
  ScatteringVertex vertex{};      // the last scattering event; valid if `counted` is weighted
  Real travelled = 0;             // from the last event to the ray's origin, through panes
  bool diffused = false;          // a surface or a medium has scattered it diffusely
  bool scattered_cached = false;  // in-scattered light is from the cache
  std::vector<BodyMet> bodies{};  // empty in scenes without bodies

  /// Factor on the light of an emitter hit, in the band in place `i`; `body`: the emitter's own.
  /// The emitter's intensities were measured with its body. So its light neither lights the body
  /// nor is dimmed by it, as in the particle tracer. Sampling an emitter passes its body, too, and
  /// counts alone.
  double share_past_body(int body, size_t i) const {
    double share = 1;
    for (const BodyMet& met : bodies) {
      if (met.body != body) continue;
      if (!met.passed || counted == EmitterHits::weighted || !(met.transmittance[i] > 0)) return 0;
      share /= met.transmittance[i];
    }
    return share;
  }

  /// Adds light of the band in place `i`.
  void add(size_t i, const SourceLight& light) {
    into.add(light.group, bands.band(i), weight * bands.light(i) * light.radiance);
  }
};

template <class Resolver>
class EmittersMet {
 public:
  /// Requires: all references outlive this.
  EmittersMet(const CompiledScene& scene, Resolver& resolver, Random& random,
              NextEvent<Resolver>& next_event)
      : scene_(scene),
        resolver_(resolver),
        random_(random),
        next_event_(next_event),
        flames_(flame_boxes(scene)) {}

  /// Adds the expected radiance of all emitters along the ray up to the surface it hits: emitting
  /// faces, the sign that was hit, flames; each multiplied by the transmittance of the media before
  /// it.
  void add_along(EyePath& p, const Hit& hit) {
    moment_of_path_ = shows_moment(p) ? moment_ : nullptr;
    if (moment_of_path_ != nullptr)
      moment_of_path_->meet(p.ray, line_end(scene_, hit.distance), p.bands);
    add_faces(p, hit.distance * face_slack);  // an emitter's body is as far away as its face
    add_emitted_by_sign(p, hit);
    add_flames_met(p, hit.distance);
  }

  /// Rays that no diffuse event has scattered show steady flames at a moment; null: their mean.
  /// Requires: it outlives its use.
  void show(FlameMoment* moment) { moment_ = moment; }
  FlameMoment* moment() const { return moment_; }

  /// Of these, emitting faces within `reach`.
  void add_faces(EyePath& p, Real reach) {
    Ray rest = p.ray;
    Real before = 0;
    for (int k = 0; k < limits::emitters_per_line; ++k) {
      const EmitterHit e = nearest_emitter(scene_, rest, reach);
      if (e.emitter == none_index) break;
      const CompiledEmitter& emitter = scene_.emitters[e.emitter];
      const Real distance = before + e.distance;
      const double weight = weight_of_face(p, e.emitter, e.point, distance);
      next_event_.media().transmittances(p.ray, distance, p.bands, through_, resolver_);
      for (size_t i = 0; i < p.bands.count(); ++i) {
        const double sent =
            emitted_radiance(emitter, e.point, -p.ray.direction, p.bands.band(i), resolver_);
        const double past_body = p.bodies.empty() ? 1 : p.share_past_body(emitter.body, i);
        p.add(i, {emitter.group, weight * sent * through_[i] * past_body * of_moment(i, distance)});
      }
      // Continue past it by more than rounding, or the same face would be hit again.
      const Real step = e.distance * face_slack + scene_.min_offset_m;
      rest.origin += rest.direction * step;
      before += step;
      reach -= step;
      if (!(reach > 0)) break;
    }
  }

  /// Light that a point of a sign's face emits towards an eye, without media and reflected light.
  SourceLight texel_light(const CompiledSign& sign, const Vec2& uv, const Vec3& to_eye,
                          int band) const {
    const Sign& d = scene_.description->signs[sign.sign];
    const ColourIndex index = d.face.colour[texel_at(d.face, uv)];
    if (index == other_colour) return {};
    const CompiledFaceColour& colour = sign.colours[index];
    const double cosine = std::max(0.0, static_cast<double>(glm::dot(sign.axes[2], to_eye)));
    const double angular = d.angular_exponent == 0 ? 1 : std::pow(cosine, d.angular_exponent);
    return {colour.group,
            colour.radiance[static_cast<size_t>(band)] * angular * face_relative(d.face, uv)};
  }

  /// Adds `weight` times the emission of flames along `length` of the ray, for one medium or all
  /// (-1). False if the ray passes through none of them.
  bool add_flames(const Ray& ray, Real length, int band, int medium, double weight,
                  GroupLight& into) {
    return add_flames_by(
        ray, length, band, medium, [&](int) { return weight; }, into);
  }

 private:
  static constexpr Real face_slack = 1 + 1e-5_r;

  static bool shows_moment(const EyePath& p) {
    return p.counted == EmitterHits::all && !p.diffused;
  }

  /// Factor on light from a place of the path's ray, in the band in place `i`.
  double of_moment(size_t i, Real distance) const {
    return moment_of_path_ == nullptr
               ? 1
               : moment_of_path_->on_light_from(static_cast<double>(distance), i);
  }

  /// `weight_of(medium)`: of its flame.
  template <class WeightOf>
  bool add_flames_by(const Ray& ray, Real length, int band, int medium, const WeightOf& weight_of,
                     GroupLight& into) {
    double depth = 0;
    bool met = false;
    for_each_segment(
        scene_.media, band, ray.origin, ray.direction, std::min(length, 4 * scene_.diagonal_m),
        resolver_, [&](const MediaSegment& s) {
          const double tau = s.sigma_t * s.length;
          const double through = s.sigma_t > 0 ? -std::expm1(-tau) / s.sigma_t : s.length;
          for (const EmissionPart& part : s.emission) {
            if (medium >= 0 && part.medium != medium) continue;
            met = true;
            const CompiledEmitter* flame = flame_of(part.medium);
            if (flame == nullptr) continue;  // the scenario removes it
            const double power = flame->power_w[static_cast<size_t>(band)] * part.density;
            into.add(flame->group, band,
                     weight_of(part.medium) * power * std::exp(-depth) * through /
                         (4 * static_cast<double>(pi_f)));
          }
          depth += tau;
          return depth < 50;
        });
    return met || depth >= 50;
  }

  /// Balance-heuristic weight of hitting an emitting face, `distance` along the path's ray.
  double weight_of_face(const EyePath& p, uint32_t emitter, const EmissionPoint& point,
                        Real distance) {
    if (p.counted == EmitterHits::all) return 1;
    const double apparent_sr =
        apparent_face(scene_.emitters[emitter], point, -p.ray.direction, p.travelled + distance);
    return next_event_.weight_of_hit(p.vertex, emitter, point.position, apparent_sr, p.bands);
  }

  void add_emitted_by_sign(EyePath& p, const Hit& hit) {
    if (!hit.found()) return;
    const uint32_t index = scene_.surfaces[hit.triangle->surface].sign;
    if (index == none_index || glm::dot(hit.triangle->unit_normal(), p.ray.direction) >= 0) return;
    const CompiledSign& sign = scene_.signs[index];
    const Vec2 uv = texture_uv(*hit.cell, hit);
    const int group = texel_light(sign, uv, -p.ray.direction, p.bands.hero()).group;
    const EmissionPoint point{hit.triangle->at(hit.u, hit.v), sign.axes[2]};
    double weight = -1;  // not known yet
    for (size_t i = 0; i < p.bands.count(); ++i) {
      const SourceLight own = texel_light(sign, uv, -p.ray.direction, p.bands.band(i));
      if (own.radiance <= 0) continue;
      if (weight < 0) {
        weight = weight_of_sign(p, index, group, point, hit.distance);
        next_event_.media().transmittances(p.ray, hit.distance, p.bands, through_, resolver_);
      }
      p.add(i, {group, weight * own.radiance * through_[i] * of_moment(i, hit.distance)});
    }
  }

  /// Weight of hitting a sign's face, where each colour is an emitter of its own.
  double weight_of_sign(const EyePath& p, uint32_t sign, int group, const EmissionPoint& point,
                        Real distance) {
    for (uint32_t i = 0; i < scene_.emitters.size(); ++i) {
      const CompiledEmitter& e = scene_.emitters[i];
      if (e.kind == EmitterKind::sign_face && e.sign == sign && e.group == group &&
          sampled_area_m2(e, point.position) > 0)
        return weight_of_face(p, i, point, distance);
    }
    return 1;  // not sampled by next-event estimation: hits count fully
  }

  /// Flames on the ray up to the surface, at full or balance-heuristic weight.
  void add_flames_met(const EyePath& p, Real length) {
    if (scene_.volume_points.empty()) return;
    if (p.counted == EmitterHits::all) {
      bool met = true;
      for (size_t i = 0; i < p.bands.count() && met; ++i)
        met = add_flames_by(
            p.ray, length, p.bands.band(i), -1,
            [&](int medium) {
              const double weight = p.weight * p.bands.light(i);
              return moment_of_path_ == nullptr ? weight
                                                : weight * moment_of_path_->on_emission(medium, i);
            },
            p.into);
      return;
    }
    for (const FlameBox& flame : flames_) add_flame_hit(p, flame, length);
  }

  void add_flame_hit(const EyePath& p, const FlameBox& box, Real length) {
    const uint32_t emitter = box.emitter;
    const CompiledEmitter& flame = scene_.emitters[emitter];
    const auto power = [&](size_t i) {
      return flame.power_w[static_cast<size_t>(p.bands.band(i))];
    };
    const size_t hero = p.bands.hero_place();
    if (!p.bands.many() && !(power(hero) > 0)) return;
    const double u = random_.uniform_double();
    if (!box.may_meet(p.ray, length)) return;
    const auto place_of = [&](int band) {
      return place_in_flame(scene_, p.ray, line_end(scene_, length), band, flame.medium, u,
                            resolver_);
    };
    const FlamePlace place = place_of(p.bands.hero());
    if (place.missed) return;
    for (size_t i = 0; i < p.bands.count(); ++i) {
      if (!(power(i) > 0)) continue;
      // Bands have different optical depths of smoke up to the flame.
      const bool same = i == hero || next_event_.media().grey();
      add_flame_place(p, i, emitter, power(i), same ? place : place_of(p.bands.band(i)));
    }
  }

  void add_flame_place(const EyePath& p, size_t i, uint32_t emitter, double power,
                       const FlamePlace& place) {
    if (!(place.light > 0)) return;
    const CompiledEmitter& flame = scene_.emitters[emitter];
    const EmissionPoint point{p.ray.origin + p.ray.direction * place.t, Vec3(0, 0, -1)};
    const double density =
        scene_.media.emission_density(static_cast<int>(flame.medium), point.position, resolver_);
    const double apparent_sr =
        next_event_.apparent_solid_angle(flame, point, -p.ray.direction, p.travelled + place.t);
    const double weight =
        next_event_.weight_of_hit(p.vertex, emitter, point.position, apparent_sr, p.bands);
    p.into.add(flame.group, p.bands.band(i),
               p.weight * p.bands.light(i) * weight * power * place.light *
                   (density / place.density) / (4 * static_cast<double>(pi_f)));
  }

  /// The emitter for a medium's glow; null if the scenario removes it.
  const CompiledEmitter* flame_of(int medium) const {
    for (const CompiledEmitter& e : scene_.emitters) {
      if (e.kind == EmitterKind::volume && e.medium == static_cast<uint32_t>(medium)) return &e;
    }
    return nullptr;
  }

  static double face_relative(const SignFace& face, const Vec2& uv) {
    if (face.relative_luminance.empty()) return 1;
    return static_cast<double>(face.relative_luminance[texel_at(face, uv)]);
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random& random_;
  NextEvent<Resolver>& next_event_;
  std::vector<FlameBox> flames_;
  BandValues through_;
  FlameMoment* moment_ = nullptr;
  FlameMoment* moment_of_path_ = nullptr;  // null where the path shows the mean
};

}  // namespace luxodus
