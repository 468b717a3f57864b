// The particle tracer: one loop over the events of a history, compiled for the features of a scene
// and for the access to its data. (S. N. Pattanaik, S. P. Mudur, "Computation of global
// illumination in a participating medium by Monte Carlo simulation", 1993.) This code is also the
// reference that every other way of running is compared with, bit for bit: a history is a pure
// function of (scene, seed, particle id). Thread rule: one ParticleTracer per thread or fiber; it
// suspends only where its resolver does.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/detectors.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/history.hpp"
#include "scenes/light/transport/textures.hpp"

namespace luxodus {

namespace defaults {
/// Russian roulette: below `roulette_below` (share of the birth weight) a particle is either ended
/// or continues with weight `roulette_to`.
inline constexpr Weight roulette_below = unit_weight / 8;
inline constexpr Weight roulette_to = unit_weight / 4;
}  // namespace defaults

/// Features of the loop; absent ones are not compiled in. `Flaws` is void except in a test, which
/// compiles the same loop with deliberate mistakes and shows that validation detects each: its
/// functions alter, in place, what the loop has just computed.
template <MediaNeed Media, bool ManyBands, bool AllSurfaces, bool Detectors, class Flaws = void>
struct Kernel {
  using flaws = Flaws;
  static constexpr MediaNeed media = Media;
  static constexpr bool many_bands = ManyBands;
  static constexpr bool all_surfaces = AllSurfaces;
  static constexpr bool detectors = Detectors;
};

template <class K, class Resolver>
class ParticleTracer {
  using Flaws = typename K::flaws;
  static constexpr bool flawed = !std::is_void_v<Flaws>;

 public:
  ParticleTracer(const CompiledScene& scene, Resolver& resolver, uint64_t seed)
      : scene_(scene),
        resolver_(resolver),
        random_(scene, seed),
        analogue_(scene.description->run.analogue),
        patches_(scene.layout.block(scene.blocks.patches).first_score) {}

  /// Traces particles [first, first + count) of a source group into the batch.
  void trace_batch(int group, uint64_t first, int64_t count, BatchScores& batch) {
    batch_ = &batch;
    group_ = &scene_.groups[static_cast<size_t>(group)];
    for (int64_t i = 0; i < count; ++i) trace(first + static_cast<uint64_t>(i));
  }

 private:
  struct State {
    Ray ray;
    Weight weight = unit_weight;
    int band = 0;
    bool direct = true;
    bool collided = false;
    bool scattered = false;  // its last event was a collision
    int body = 0;            // its emitter's own, on its way from there: the light passes it
  };

  /// Random numbers for a new direction, and the cosine-weighted direction for a Lambertian
  /// surface, about its normal.
  struct SampledDirection {
    Real u, v;
    Vec3 lambertian;
  };
  SampledDirection draw_direction() {
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    SampledDirection drawn{u, v, cosine_hemisphere(u, v)};
    if constexpr (flawed) Flaws::lambertian(drawn.lambertian);
    return drawn;
  }

  void trace(uint64_t particle) {
    if constexpr (flawed) Flaws::history(particle);
    random_.start(particle);
    State p = emit();
    EnergyBalance& balance = batch_->balance;
    ++balance.particles;
    balance.emitted += p.weight;
    const int events = balance.rays < limits::rays_per_batch ? limits::events_per_history : 0;
    for (int event = 0; event < events; ++event) {
      ++balance.rays;
      // The direction after this flight is sampled before it: that needs nothing of the hit, so it
      // can overlap with the search for the hit.
      const SampledDirection drawn = draw_direction();
      FreeFlight flight;
      if constexpr (flight_first) {
        flight = fly(p, std::numeric_limits<Real>::infinity());
        p.ray.length = flight.t + near_surface_m();
      }
      const Hit hit = resolver_.nearest(p.ray);
      if constexpr (!flight_first && K::media != MediaNeed::none) flight = fly(p, hit.distance);
      const bool alive = interact(p, hit, flight, drawn);
      if (!alive) return;
    }
    balance.lost_too_long += p.weight;
  }

  // ---- birth -----------------------------------------------------------------------------------

  State emit() {
    State p;
    p.band = choose_band();
    const CompiledEmitter& emitter = choose_emitter(p.band);
    const EmissionPoint point = emission_point(scene_, emitter, random_, resolver_);
    p.ray.direction = emission_direction(emitter, point, random_, resolver_);
    p.ray.origin = point.position;
    if constexpr (flawed) Flaws::birth(p.ray, point, emitter);
    // Light of an emitter in the plane of a wall, or on its own body, would hit that from behind,
    // so it starts off the surface. A beam starts exactly where stated, since its length may be
    // what is measured.
    if (emitter.kind != EmitterKind::volume && emitter.distribution != Distribution::collimated) {
      const Vec3 side = glm::dot(point.axis, p.ray.direction) >= 0 ? point.axis : -point.axis;
      p.ray.origin = offset_ray(p.ray.origin, side, scene_.min_offset_m);
    }
    // Collimated light has no density of directions, so the deterministic direct part excludes it.
    p.direct = emitter.distribution != Distribution::collimated;
    p.body = emitter.body;
    return p;
  }

  int choose_band() {
    if constexpr (!K::many_bands) return 0;
    const uint64_t r = random_.bits64();
    return static_cast<int>(find(group_->band_cdf, r));
  }

  const CompiledEmitter& choose_emitter(int band) {
    const auto b = static_cast<size_t>(band);
    const std::vector<uint32_t>& choices = group_->emitters[b];
    if (choices.size() == 1) return scene_.emitters[choices[0]];
    const uint64_t r = random_.bits64();
    size_t choice = find(group_->emitter_cdf[b], r);
    if constexpr (flawed) Flaws::emitter(choice, choices.size());
    return scene_.emitters[choices[choice]];
  }

  static size_t find(const std::vector<uint64_t>& cdf, uint64_t r) {
    const auto it = std::upper_bound(cdf.begin(), cdf.end(), r);
    return std::min(static_cast<size_t>(it - cdf.begin()), cdf.size() - 1);
  }

  // ---- a flight and its end --------------------------------------------------------------------

  /// With analytic media, the free flight is sampled first, and a surface is searched only up to
  /// its end. Bodies and voxels are sampled no farther than the surface.
  static constexpr bool flight_first =
      K::media == MediaNeed::homogeneous || K::media == MediaNeed::layered;

  FreeFlight fly(const State& p, Real length) {
    // -log(1 - u), u in [0, 1) with 32 bits, exact in double.
    const uint32_t r = random_.bits();
    double tau = -std::log((4294967296.0 - static_cast<double>(r)) * 0x1p-32);
    if constexpr (flawed) Flaws::depth(tau);
    const Real choice = random_.uniform();
    FreeFlight flight = free_flight<K::media>(scene_.media, p.band, p.ray.origin, p.ray.direction,
                                              length, tau, choice, resolver_);
    if constexpr (flawed) Flaws::flight(flight, p.ray, length, scene_);
    return flight;
  }

  /// The event at the end of a flight; a surface found before the collision takes precedence.
  bool interact(State& p, const Hit& hit, const FreeFlight& flight, const SampledDirection& drawn) {
    if constexpr (K::media != MediaNeed::none) {
      if (flight.collided && (!flight_first || hit.distance > flight.t)) {
        pass_detectors(p, flight.t, drawn);
        return collide(p, flight, hit, drawn);
      }
    }
    if (!hit.found()) return escape(p, drawn);
    pass_detectors(p, hit.distance, drawn);
    return meet_surface(p, hit, drawn);
  }

  /// The direction sampled for the end of a flight is independent of it, so its number can also
  /// place the voxel points.
  void pass_detectors(const State& p, Real length, const SampledDirection& drawn) {
    if constexpr (K::detectors) {
      if constexpr (flawed) Flaws::passed(length);
      score_flight(scene_,
                   {p.ray.origin, p.ray.direction, length, p.weight, p.band, p.direct, p.collided,
                    p.scattered, drawn.u},
                   *batch_);
    }
  }

  // ---- the medium ------------------------------------------------------------------------------

  /// Collisions this close to a surface are checked by collision_place. Rounding reaches this far
  /// along a ray that arrives at 1/1000 from grazing.
  Real near_surface_m() const { return 1000 * scene_.min_offset_m; }

  /// Single precision may round a collision just before a surface to behind it, and the particle
  /// would continue in the next room or outside: it is moved to the surface's near side.
  Vec3 collision_place(const Ray& ray, const FreeFlight& flight, const Hit& ahead) const {
    const Vec3 place = ray.origin + ray.direction * flight.t;
    if (ahead.distance > flight.t + near_surface_m()) return place;
    const Vec3 outward = ahead.triangle->unit_normal();
    const Vec3 normal = glm::dot(outward, ray.direction) < 0 ? outward : -outward;
    const Vec3 foot = offset_ray(ahead.triangle->at(ahead.u, ahead.v), normal, scene_.min_offset_m);
    const Real behind = glm::dot(foot - place, normal);
    return behind > 0 ? foot : place;
  }

  /// `ahead`: the surface beyond the collision, if one was found.
  bool collide(State& p, const FreeFlight& flight, const Hit& ahead,
               const SampledDirection& drawn) {
    ++batch_->balance.collisions;
    const Vec3 place = collision_place(p.ray, flight, ahead);
    const Weight before = p.weight;
    Fraction albedo = to_fraction(flight.albedo);
    if constexpr (flawed) Flaws::albedo(albedo);
    const Weight after = surviving(before, albedo);
    batch_->balance.absorbed_media += before - after;
    score_collision(scene_, place, p.band, static_cast<uint32_t>(flight.medium), before - after,
                    after, *batch_);
    p.weight = after;
    if (!survives_roulette(p)) return false;
    p.ray.origin = place;
    const Vec3 incoming = p.ray.direction;
    p.ray.direction =
        sample(scene_.phases[static_cast<size_t>(flight.phase)], incoming, drawn.u, drawn.v);
    if constexpr (flawed) Flaws::scattered(p.ray.direction, incoming);
    p.direct = false;
    p.body = 0;
    p.collided = p.scattered = true;
    return true;
  }

  // ---- surfaces
  // ----------------------------------------------------------------------------------

  bool meet_surface(State& p, const Hit& hit, const SampledDirection& drawn) {
    ++batch_->balance.hits;
    const TriangleRecord& triangle = *hit.triangle;
    const bool front = glm::dot(triangle.unit_normal(), p.ray.direction) < 0;
    if constexpr (K::all_surfaces) {
      const uint32_t side = front ? 0 : 1;
      const CompiledSurface& surface = scene_.surfaces[triangle.surface];
      if (p.body != 0 && surface.body == p.body) return pass_own_body(p, hit, front);
      const CompiledMaterial& material = scene_.materials[surface.material[side]];
      if (material.kind != MaterialKind::lambertian || material.image != none_index ||
          surface.sign != none_index) {
        return meet_any_surface(p, hit, front, material, drawn);
      }
    }
    const size_t side = front ? 0 : 1;
    const size_t bands = K::many_bands ? static_cast<size_t>(scene_.bands.count()) : 1;
    Fraction reflectance =
        scene_
            .lambert_fraction[(triangle.surface * 2 + side) * bands + static_cast<size_t>(p.band)];
    if constexpr (flawed) Flaws::reflectance(reflectance);
    const Weight before = p.weight;
    const Weight after = surviving(before, reflectance);
    int64_t* patch = patch_score(hit, front, p.band);
    patch[0] += static_cast<int64_t>(before);
    patch[1] += static_cast<int64_t>(after);
    if constexpr (flawed) Flaws::counted(patch[0], before);
    batch_->balance.absorbed_surfaces += before - after;
    p.weight = after;
    if (!survives_roulette(p)) return false;
    const Vec3 normal = front ? triangle.unit_normal() : -triangle.unit_normal();
    p.ray.direction = to_world(normal, drawn.lambertian);
    p.ray.origin = offset_ray(triangle.at(hit.u, hit.v), normal, scene_.min_offset_m);
    if constexpr (flawed) Flaws::departure(p.ray.origin, triangle.at(hit.u, hit.v));
    p.direct = p.scattered = false;
    p.body = 0;
    return true;
  }

  /// Goes on behind the surface: the intensities of the emitter lack its body's shadow already.
  bool pass_own_body(State& p, const Hit& hit, bool front) const {
    const Vec3 outward = hit.triangle->unit_normal();
    p.ray.origin =
        offset_ray(hit.triangle->at(hit.u, hit.v), front ? -outward : outward, scene_.min_offset_m);
    return true;
  }

  /// Glossy, mirror, glass, open, textured, sign faces: samples the lobe first, then applies its
  /// weight.
  bool meet_any_surface(State& p, const Hit& hit, bool front, const CompiledMaterial& material,
                        const SampledDirection& drawn) {
    const TriangleRecord& triangle = *hit.triangle;
    const Vec3 normal = front ? triangle.unit_normal() : -triangle.unit_normal();
    SurfaceModel model = surface_at(scene_, hit, front, p.band, material, resolver_);
    if constexpr (flawed) Flaws::surface(model);
    const Vec3 place = triangle.at(hit.u, hit.v);
    const Real lobe = random_.uniform();
    const SurfaceSample sampled =
        sample_surface(model, p.ray.direction, normal, front, lobe, drawn.u, drawn.v);
    const Weight before = p.weight;
    const Weight after = surviving(before, to_fraction(static_cast<double>(sampled.weight)));
    patch_score(hit, front, p.band)[0] += static_cast<int64_t>(before);
    patch_score(hit, front != sampled.transmitted, p.band)[1] += static_cast<int64_t>(after);
    batch_->balance.absorbed_surfaces += before - after;
    p.weight = after;
    if (!survives_roulette(p)) return false;
    const bool straight =
        sampled.transmitted && sampled.specular && model.kind != SurfaceKind::dielectric;
    p.direct = p.direct && straight;
    p.scattered = p.scattered && straight;
    if (!straight) p.body = 0;
    p.ray.direction = sampled.direction;
    p.ray.origin = offset_ray(place, sampled.transmitted ? -normal : normal, scene_.min_offset_m);
    return true;
  }

  int64_t* patch_score(const Hit& hit, bool front, int band) {
    const TriangleRecord& t = *hit.triangle;
    const uint32_t n = t.subdivision;
    uint32_t patch = t.first_patch + (front ? 0 : n * n);
    if (n > 1) patch += sub_triangle(hit.u, hit.v, n);
    if constexpr (flawed) Flaws::patch(patch, scene_);
    const int64_t bands = K::many_bands ? scene_.bands.count() : 1;
    return batch_->scores.data() + patches_ + (int64_t{patch} * bands + band) * 2;
  }

  // ---- weights
  // -----------------------------------------------------------------------------------

  /// Weight that survives an event: the given fraction of it, or all or nothing with analogue
  /// absorption.
  Weight surviving(Weight weight, Fraction fraction) {
    if (fraction == unit_weight) return weight;
    if (fraction == 0) return 0;
    const uint32_t r = random_.bits();
    if (analogue_) return r < fraction ? weight : 0;
    return split(weight, fraction, r);
  }

  /// Russian roulette: survival with probability weight / roulette_to preserves the expectation.
  bool survives_roulette(State& p) {
    if (p.weight >= defaults::roulette_below) return true;
    if (p.weight == 0) return false;
    const uint64_t r = (uint64_t{random_.bits()} * defaults::roulette_to) >> 32;
    if (r < p.weight) {
      const Weight before = p.weight;
      p.weight = defaults::roulette_to;
      if constexpr (flawed) Flaws::roulette(p.weight, before);
      batch_->balance.roulette_gain += p.weight - before;
      return true;
    }
    batch_->balance.roulette_loss += p.weight;
    return false;
  }

  // ---- leaving the scene
  // -------------------------------------------------------------------------

  bool escape(State& p, const SampledDirection& drawn) {
    EscapePoint exit = leave_box(p.ray);
    if constexpr (flawed) Flaws::exit(exit.side);
    pass_detectors(p, exit.distance, drawn);
    const int64_t at = scene_.layout.score_index(scene_.blocks.escape, exit.side, p.band, 0);
    batch_->scores.data()[at] += static_cast<int64_t>(p.weight);
    batch_->balance.escaped += p.weight;
    return false;
  }

  struct EscapePoint {
    Real distance;
    uint32_t side;
  };

  /// Where a ray without a hit leaves the bounding box; a ray that starts outside leaves at the
  /// face it moves away from.
  EscapePoint leave_box(const Ray& ray) const {
    const Vec3 low = scene_.local_low;
    const Vec3 high = scene_.local_high;
    EscapePoint exit{std::numeric_limits<Real>::infinity(), 0};
    for (int a = 0; a < 3; ++a) {
      const Real d = ray.direction[a];
      if (d == 0) continue;
      const Real t = ((d > 0 ? high[a] : low[a]) - ray.origin[a]) / d;
      if (t < exit.distance) exit = {t, static_cast<uint32_t>(2 * a + (d > 0 ? 1 : 0))};
    }
    exit.distance = std::max(exit.distance, 0.0_r);
    return exit;
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  HistoryRandom random_;
  const bool analogue_;
  const int64_t patches_;
  const Group* group_ = nullptr;
  BatchScores* batch_ = nullptr;
};

}  // namespace luxodus
