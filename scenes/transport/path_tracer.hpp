// A path tracer: radiance along a ray, traced from where it is seen, the eye or a probe. Paths run
// backwards (all laws are reciprocal). At every event one emitter is sampled directly (next-event
// estimation, emitter_choice.hpp), so that a path need not hit it by chance. Close to an emitter
// that estimate has no bounded variance (1/r2). So light from points nearer than the emitter's half
// size counts only where a path hits it, and light from farther points only where it is sampled:
// each pair of places once. In smoke a second place is drawn as the light of a near, small emitter
// falls on the stretch of the path (equiangular.hpp). The balance heuristic weights the two.
// Unbiased, except where pictures end a path in the patches' flux (final gather). eye_paths.hpp
// estimates signs and probes with it. Not seen: point emitters and caustics through mirrors and
// refracting solids; the forward tracer counts those. Thread rule: one PathTracer per thread or
// fiber.
#pragma once

#include <cmath>

#include "runtime/core/random.hpp"
#include "scenes/geometry/real.hpp"
#include "scenes/optics/equiangular.hpp"
#include "scenes/tally/batch_scores.hpp"
#include "scenes/transport/connect.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/emitter_choice.hpp"
#include "scenes/transport/patch_radiance.hpp"
#include "scenes/transport/textures.hpp"

namespace luxodus {

namespace limits {
inline constexpr int eye_events = 10'000;
inline constexpr int emitters_per_line = 16;  // emitting faces that one straight line may cross
/// Of the size of a scene: where a stretch ends on which places are drawn by an emitter's light.
inline constexpr Real longest_line = 4;
}  // namespace limits

/// Light of one source group on its way to an eye [W/(m2 sr)].
struct SourceLight {
  int group = 0;
  double radiance = 0;
};

/// Light that arrives at a place, by source group: what an eye path adds up.
class GroupLight {
 public:
  explicit GroupLight(size_t groups) : by_group_(groups, 0.0) {}

  void clear() {
    std::fill(by_group_.begin(), by_group_.end(), 0.0);
    total_ = 0;
  }
  void add(int group, double amount) {
    by_group_[static_cast<size_t>(group)] += amount;
    total_ += amount;
  }
  /// Light of which nobody knows the source, as of a patch that all groups have lit.
  void add_of_all(double amount) { total_ += amount; }

  void add_scaled(const GroupLight& light, double factor) {
    for (size_t g = 0; g < by_group_.size(); ++g) by_group_[g] += factor * light.by_group_[g];
    total_ += factor * light.total_;
  }

  double total() const { return total_; }
  double of(size_t group) const { return by_group_[group]; }

 private:
  std::vector<double> by_group_;
  double total_ = 0;
};

/// Which emitters count when a path meets them on its way.
enum class EmitterHits {
  none,  // somebody else holds all direct light of this place
  near,  // those closer than their half size; the others were sampled
  all,   // none was sampled
};

template <class Resolver>
class PathTracer {
 public:
  PathTracer(const CompiledScene& scene, Resolver& resolver, uint64_t seed, RandomStream stream)
      : scene_(scene), resolver_(resolver), random_(seed, stream), choice_(scene) {
    // A picture shows colours, an estimate of luminance needs few.
    const double colour = stream == RandomStream::picture ? 1.0 : 0.05;
    double total = 0;
    for (int b = 0; b < scene.bands.count(); ++b) {
      double power = 0;
      for (const Group& g : scene.groups) power += g.power_w[static_cast<size_t>(b)];
      const Band& band = scene.bands[b];
      total += power * (band.lm_per_w + colour * (band.x_per_w + band.z_per_w));
      band_cdf_.push_back(total);
    }
    for (double& c : band_cdf_) c /= total;
  }

  Random& random() { return random_; }

  /// A band for a path, from a uniform number; and the probability of it.
  int choose_band(double u) const {
    const auto it = std::upper_bound(band_cdf_.begin(), band_cdf_.end(), u);
    return static_cast<int>(std::min<std::ptrdiff_t>(
        it - band_cdf_.begin(), static_cast<std::ptrdiff_t>(band_cdf_.size()) - 1));
  }
  double band_probability(int b) const {
    return band_cdf_[static_cast<size_t>(b)] - (b > 0 ? band_cdf_[static_cast<size_t>(b - 1)] : 0);
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] in `band` that arrives against `ray.direction`,
  /// from one path. `counted`: which emitters count before the first event. `gather`: where paths
  /// may end after their first diffuse event; null traces them to their end.
  void radiance(const Ray& ray, int band, EmitterHits counted, double weight, GroupLight& into,
                const PatchRadiance* gather = nullptr) {
    trace({ray, band, counted, weight, into}, gather);
  }

  /// The same of a path that a medium has turned to `ray`, somewhere on the first `length` of a ray
  /// for which `add_single_scattering` has sampled emitters.
  void radiance_after_scattering(const Ray& ray, Real length, int band, double weight,
                                 GroupLight& into) {
    Path path{ray, band, EmitterHits::near, weight, into};
    path.small_sampled = limits::small_emitter * line_end(length);
    trace(path, nullptr);
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] that emitters send to the first `length` of the
  /// ray and the medium there turns against it, once. `flight` is one along it whose collisions
  /// have the density sigma_t exp(-depth) / `share`: 1 if it was free, less if a collision was
  /// forced.
  void add_single_scattering(const Ray& ray, Real length, const FreeFlight& flight, double share,
                             int band, double weight, GroupLight& into) {
    if (scene_.features.media == MediaNeed::none) return;
    const Real end = line_end(length);
    const Stretch stretch{ray, end, share, band, choice_.weigh_along(ray, end, band)};
    if (flight.collided && flight.albedo > 0)
      add_at_collision(stretch, flight, weight * share * flight.albedo, into);
    if (stretch.emitters_near) add_near_emitter(stretch, weight, into);
  }

  /// Light of an emitter that a surface sends against `direction`; one emitter is sampled, and
  /// divided by the probability of asking it.
  SourceLight reflected_light(const Vec3& place, const Vec3& direction, const Vec3& normal,
                              const SurfaceModel& model, int band) {
    const EmitterSample sampled = sample_emitter(place, band);
    if (sampled.probability <= 0) return {};
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const Arriving a = light_from(e, point, place, e.near_m, band);
    const Real cosine = glm::dot(a.direction, normal);
    if (a.irradiance <= 0 || cosine <= 0) return {};
    return {e.group,
            a.irradiance / sampled.probability * static_cast<double>(cosine) *
                static_cast<double>(evaluate_surface(model, -direction, a.direction, normal))};
  }

  /// Own light of a point of a sign's face towards an eye, without path or room light.
  SourceLight texel_light(const CompiledSign& sign, const Vec2& uv, const Vec3& to_eye,
                          int band) const {
    const Sign& d = scene_.description->signs[sign.sign];
    const SignColour colour = d.face.colour[texel_at(d.face, uv)];
    if (colour == SignColour::other) return {};
    const bool white = colour == SignColour::white;
    const auto& radiance = white ? sign.white_radiance : sign.green_radiance;
    const double cosine = std::max(0.0, static_cast<double>(glm::dot(sign.axes[2], to_eye)));
    const double angular = d.angular_exponent == 0 ? 1 : std::pow(cosine, d.angular_exponent);
    return {white ? sign.white_group : sign.green_group,
            radiance[static_cast<size_t>(band)] * angular * face_relative(d.face, uv)};
  }

  /// Adds `weight` times the emission of flames along `length` of the ray, of one medium or of all
  /// (-1).
  void add_flames(const Ray& ray, Real length, int band, int medium, double weight,
                  GroupLight& into) {
    double depth = 0;
    for_each_segment(
        scene_.media, band, ray.origin, ray.direction, std::min(length, 4 * scene_.diagonal_m),
        resolver_, [&](const MediaSegment& s) {
          const double tau = s.sigma_t * s.length;
          const double through = s.sigma_t > 0 ? -std::expm1(-tau) / s.sigma_t : s.length;
          for (const EmissionPart& part : s.emission) {
            if (medium >= 0 && part.medium != medium) continue;
            const CompiledEmitter* flame = flame_of(part.medium);
            if (flame == nullptr) continue;  // the scenario has put it out
            const double power = flame->power_w[static_cast<size_t>(band)] * part.density;
            into.add(flame->group,
                     weight * power * std::exp(-depth) * through / (4 * static_cast<double>(pi_f)));
          }
          depth += tau;
          return depth < 50;
        });
  }

 private:
  struct Path {
    Ray ray;
    int band;
    EmitterHits counted;
    double weight;
    GroupLight& into;
    double throughput = 1;
    Real travelled = 0;      // from the last event to the ray's origin, through panes
    Real small_sampled = 0;  // emitters of a smaller half size were sampled there at any distance
    bool diffused = false;   // a surface or a medium has spread it

    void add(const SourceLight& light) {
      into.add(light.group, weight * throughput * light.radiance);
    }
  };

  // ---- events
  // ------------------------------------------------------------------------------------

  void trace(Path path, const PatchRadiance* gather) {
    for (int event = 0; event < limits::eye_events; ++event) {
      const Hit hit = resolver_.nearest(path.ray);
      if (path.counted != EmitterHits::none) add_emitted_along(path, hit);
      const Ray stretch = path.ray;
      const double weight = path.weight * path.throughput;
      const FreeFlight flight = fly(stretch, hit.distance, path.band);
      const bool alive =
          flight.collided ? scatter(path, flight, hit.distance) : meet_surface(path, hit, gather);
      // Last, since asking may drop the cell that the hit is of.
      add_single_scattering(stretch, hit.distance, flight, 1, path.band, weight, path.into);
      if (!alive || (event >= 2 && !survives_roulette(path.throughput))) return;
    }
  }

  /// Where a stretch of that length ends for emitters that are near it.
  Real line_end(Real length) const {
    return std::min(length, limits::longest_line * scene_.diagonal_m);
  }

  FreeFlight fly(const Ray& ray, Real length, int band) {
    if (scene_.features.media == MediaNeed::none) return {};
    const uint32_t r = random_.bits();
    const double tau = -std::log((4294967296.0 - static_cast<double>(r)) * 0x1p-32);
    const Real choice = random_.uniform();
    return free_flight<MediaNeed::general>(scene_.media, band, ray.origin, ray.direction, length,
                                           tau, choice, resolver_);
  }

  const CompiledMaterial& material_at(const Hit& hit, bool front) const {
    return scene_.materials[scene_.surfaces[hit.triangle->surface].material[front ? 0 : 1]];
  }

  bool reflects_diffusely(const Hit& hit, const Ray& ray) const {
    const bool front = glm::dot(hit.triangle->unit_normal(), ray.direction) < 0;
    const MaterialKind kind = material_at(hit, front).kind;
    return kind == MaterialKind::lambertian || kind == MaterialKind::glossy;
  }

  /// Medium event: a new direction. Light sampled from emitters is `add_single_scattering`'s. False
  /// ends the path.
  bool scatter(Path& p, const FreeFlight& flight, Real length) {
    p.throughput *= flight.albedo;
    if (p.throughput <= 0) return false;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    p.ray.origin += p.ray.direction * flight.t;
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    p.ray.direction = sample(phase, p.ray.direction, u, v);
    p.counted = EmitterHits::near;
    p.travelled = 0;
    p.small_sampled = limits::small_emitter * line_end(length);
    p.diffused = true;
    return true;
  }

  /// Surface event, where a gather may end the path. False ends it.
  bool meet_surface(Path& p, const Hit& hit, const PatchRadiance* gather) {
    if (!hit.found()) return false;
    if (gather == nullptr || !p.diffused || !reflects_diffusely(hit, p.ray)) return bounce(p, hit);
    const bool front = glm::dot(hit.triangle->unit_normal(), p.ray.direction) < 0;
    p.into.add_of_all(p.weight * p.throughput * gather->radiance(hit, front, p.band));
    return false;
  }

  /// Surface event: light sampled from an emitter, then a new direction. False ends the path.
  bool bounce(Path& p, const Hit& hit) {
    const TriangleRecord& t = *hit.triangle;
    const bool front = glm::dot(t.unit_normal(), p.ray.direction) < 0;
    const SurfaceModel model =
        surface_at(scene_, hit, front, p.band, material_at(hit, front), resolver_);
    const Vec3 normal = front ? t.unit_normal() : -t.unit_normal();
    const Vec3 place = t.at(hit.u, hit.v);
    if (model.kind == SurfaceKind::lambertian || model.kind == SurfaceKind::glossy) {
      p.add(reflected_light(offset_ray(place, normal, scene_.min_offset_m), p.ray.direction, normal,
                            model, p.band));
    }
    const Real lobe = random_.uniform();
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    const SurfaceSample s = sample_surface(model, p.ray.direction, normal, front, lobe, u, v);
    p.throughput *= static_cast<double>(s.weight);
    if (p.throughput <= 0) return false;
    // Straight through a pane nothing has happened that asking does not know of.
    const bool straight = s.specular && s.transmitted && model.kind != SurfaceKind::dielectric;
    if (straight) {
      p.travelled += hit.distance;
    } else {
      p.counted = s.specular ? EmitterHits::all : EmitterHits::near;
      p.travelled = 0;
      p.small_sampled = 0;
    }
    if (!s.specular) p.diffused = true;
    p.ray.direction = s.direction;
    p.ray.origin = offset_ray(place, s.transmitted ? -normal : normal, scene_.min_offset_m);
    return true;
  }

  bool survives_roulette(double& throughput) {
    if (throughput >= 0.2) return true;
    const double survival = throughput / 0.4;
    const auto u = static_cast<double>(random_.uniform());
    if (u >= survival) return false;
    throughput /= survival;
    return true;
  }

  // ---- emitters seen directly
  // --------------------------------------------------------------------

  /// Expected radiance of what emits along the ray up to the surface it hits: emitting faces, the
  /// sign that was hit, flames; each weighted by what passes the media before it.
  void add_emitted_along(Path& p, const Hit& hit) {
    const Real slack = 1 + 1e-5_r;  // a body's own face lies as far as the emitter on it
    Real reach = hit.distance * slack;
    Ray rest = p.ray;
    Real before = 0;
    for (int k = 0; k < limits::emitters_per_line; ++k) {
      const EmitterHit e = nearest_emitter(scene_, rest, reach);
      if (e.emitter == none_index) break;
      const CompiledEmitter& emitter = scene_.emitters[e.emitter];
      const Real distance = before + e.distance;
      if (counts(p, distance, emitter.near_m)) {
        p.add({emitter.group,
               emitted_radiance(emitter, e.point, -p.ray.direction, p.band, resolver_) *
                   medium_transmittance(scene_, p.ray, distance, p.band, resolver_)});
      }
      const Real step = std::nextafter(e.distance * slack, std::numeric_limits<Real>::infinity());
      rest.origin += rest.direction * step;
      before += step;
      reach -= step;
      if (!(reach > 0)) break;
    }
    add_emitted_by_sign(p, hit);
    add_flames_met(p, hit.distance);
  }

  static bool counts(const Path& p, Real distance, Real near) {
    return p.counted == EmitterHits::all ||
           (near >= p.small_sampled && p.travelled + distance < near);
  }

  void add_emitted_by_sign(Path& p, const Hit& hit) {
    if (!hit.found()) return;
    const uint32_t index = scene_.surfaces[hit.triangle->surface].sign;
    if (index == none_index || glm::dot(hit.triangle->unit_normal(), p.ray.direction) >= 0) return;
    const CompiledSign& sign = scene_.signs[index];
    if (!counts(p, hit.distance, sign.near_m)) return;
    const SourceLight own = texel_light(sign, texture_uv(*hit.cell, hit), -p.ray.direction, p.band);
    if (own.radiance <= 0) return;
    p.add({own.group,
           own.radiance * medium_transmittance(scene_, p.ray, hit.distance, p.band, resolver_)});
  }

  /// Flames that count: all along the line, or the part of each that is near.
  void add_flames_met(const Path& p, Real length) {
    if (scene_.volume_points.empty()) return;
    const double weight = p.weight * p.throughput;
    if (p.counted == EmitterHits::all) return add_flames(p.ray, length, p.band, -1, weight, p.into);
    for (const CompiledEmitter& e : scene_.emitters) {
      if (e.kind != EmitterKind::volume) continue;
      const Real rest = e.near_m - p.travelled;
      if (rest > 0 && e.near_m >= p.small_sampled) {
        add_flames(p.ray, std::min(length, rest), p.band, static_cast<int>(e.medium), weight,
                   p.into);
      }
    }
  }

  /// The emitter that stands for a medium's glow; null where the scenario has put it out.
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

  // ---- next-event estimation
  // -------------------------------------------------------------------------

  EmitterSample sample_emitter(const Vec3& place, int band) {
    if (!choice_.weigh_at(place, band)) return {};
    return choice_.choose_at(random_.uniform_double());
  }

  /// Irradiance [W/m2] of a point of an emitter, normal to the line between.
  struct Arriving {
    Vec3 direction{0};  // towards the emitter
    double irradiance = 0;
  };

  /// Nothing from points that are not farther than `min_distance`: paths hit them.
  Arriving light_from(const CompiledEmitter& e, const EmissionPoint& point, const Vec3& place,
                      Real min_distance, int band) {
    const ShadowRay c =
        connect(scene_, place, point.position, point.axis, e.kind != EmitterKind::volume);
    if (!(c.distance > min_distance)) return {};
    const auto density =
        static_cast<double>(directional_density(e, point, -c.ray.direction, resolver_));
    if (density <= 0) return {};
    const double solid = solid_transmittance(scene_, c.ray, c.ray.length, band, resolver_);
    if (solid <= 0) return {};
    const double medium = medium_transmittance(scene_, c.ray, c.distance, band, resolver_);
    const auto d = static_cast<double>(c.distance);
    return {c.ray.direction,
            e.power_w[static_cast<size_t>(band)] * density * solid * medium / (d * d)};
  }

  // ---- light scattered into a stretch of a path
  // -------------------------------------------------------------------------

  struct Stretch {
    Ray ray;
    Real end;      // places near emitters are drawn up to here
    double share;  // see add_single_scattering
    int band;
    bool emitters_near;  // of EmitterChoice::weigh_along

    /// Places on it as a point of an emitter sees them.
    EquiangularLine seen_from(const EmissionPoint& point) const {
      return {glm::dvec3(ray.origin), glm::dvec3(ray.direction), static_cast<double>(end),
              glm::dvec3(point.position)};
    }
    /// Up to which distance points of an emitter count only where a path hits them.
    Real hit_only_within(const CompiledEmitter& e) const {
      return EmitterChoice::is_small(e, end) ? 0 : e.near_m;
    }
  };

  double collision_density(const Stretch& s, Real t, double sigma_t) {
    return sigma_t * medium_transmittance(scene_, s.ray, t, s.band, resolver_) / s.share;
  }

  /// The place is where a flight has collided; an emitter is sampled there.
  void add_at_collision(const Stretch& s, const FreeFlight& flight, double weight,
                        GroupLight& into) {
    const Vec3 place = s.ray.origin + s.ray.direction * flight.t;
    const EmitterSample sampled = sample_emitter(place, s.band);
    if (sampled.probability <= 0) return;
    const CompiledEmitter& e = scene_.emitters[sampled.emitter];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const Arriving a = light_from(e, point, place, s.hit_only_within(e), s.band);
    if (a.irradiance <= 0) return;
    double probability = sampled.probability;
    if (s.emitters_near) {
      const double sigma_t = extinction_at(scene_.media, s.band, place, resolver_);
      const double here = collision_density(s, flight.t, sigma_t);
      if (!(here > 0)) return;
      probability += choice_.probability_along(sampled.emitter) *
                     s.seen_from(point).density(static_cast<double>(flight.t)) / here;
    }
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const auto turned =
        static_cast<double>(evaluate(phase, glm::dot(a.direction, s.ray.direction)));
    into.add(e.group, weight * turned * a.irradiance / probability);
  }

  /// The emitter is chosen first, and the place as its light falls on the stretch.
  void add_near_emitter(const Stretch& s, double weight, GroupLight& into) {
    const auto [chosen, share] = choice_.choose_along(random_.uniform_double());
    if (!(share > 0)) return;
    const CompiledEmitter& e = scene_.emitters[chosen];
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const EquiangularLine line = s.seen_from(point);
    const auto t = static_cast<Real>(line.sample(random_.uniform_double()));
    const Vec3 place = s.ray.origin + s.ray.direction * t;
    const double sigma_t = extinction_at(scene_.media, s.band, place, resolver_);
    if (!(sigma_t > 0)) return;
    const Arriving a = light_from(e, point, place, s.hit_only_within(e), s.band);
    if (a.irradiance <= 0) return;
    const Real cosine = glm::dot(a.direction, s.ray.direction);
    double turned = 0;
    for_each_medium_at(
        scene_.media, s.band, place, resolver_, [&](int, int phase, double sigma, double albedo) {
          turned +=
              sigma * albedo *
              static_cast<double>(evaluate(scene_.phases[static_cast<size_t>(phase)], cosine));
        });
    if (turned <= 0) return;
    const double here = collision_density(s, t, sigma_t);
    choice_.weigh_at(place, s.band);
    const double probability =
        share * line.density(static_cast<double>(t)) + choice_.probability_at(chosen) * here;
    // What passes up to here is in the density of collisions already.
    into.add(e.group, weight * s.share * (here / sigma_t) * turned * a.irradiance / probability);
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random random_;
  std::vector<double> band_cdf_;
  EmitterChoice choice_;
};

}  // namespace luxodus
