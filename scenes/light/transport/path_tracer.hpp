// A path tracer: radiance along a ray, traced backwards from an eye or a probe (all laws are
// reciprocal), in one band or in all at once. At every event one emitter is sampled (next-event
// estimation, next_event.hpp), and emitters that a path hits count, too, combined by multiple
// importance sampling. Unbiased, except that paths of pictures may end in a radiance cache, the
// flux tallied by a run (final gather). eye_paths.hpp estimates signs and probes with it. As in
// the particle tracer, an emitter does not light its own body, whose panes do not dim it. Not
// included: hits of point emitters, caustics through mirrors and refracting solids, and emitters
// seen by an eye or in a mirror through their own opaque body; the particle tracer counts those.
// Thread rule: one PathTracer per thread or fiber.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/connect.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/emitters_met.hpp"
#include "scenes/light/transport/eye_view.hpp"
#include "scenes/light/transport/group_light.hpp"
#include "scenes/light/transport/next_event.hpp"
#include "scenes/light/transport/radiance_cache.hpp"
#include "scenes/light/transport/textures.hpp"
#include "scenes/light/transport/turn_numbers.hpp"

namespace luxodus {

namespace limits {
inline constexpr int eye_events = 10'000;
/// Splitting factor of a picture's path in scenes with media, if it may end in the cache. More
/// parts cost as much as they gain; so does any splitting in clear air.
inline constexpr int path_parts = 2;
/// Worth of a collision in smoke without absorption, relative to a surface hit, for split paths:
/// first flights are made to collide more often by it.
inline constexpr double collision_worth = 4;
/// Largest share of first flights made to collide, if more collide than in free flight: one of two
/// parts.
inline constexpr double max_forced = 0.5;
}  // namespace limits

template <class Resolver>
class PathTracer {
 public:
  /// `sight`: data for the light sampler; null: emitters are chosen by power and distance alone.
  PathTracer(const CompiledScene& scene, Resolver& resolver, uint64_t seed, RandomStream stream,
             const EmitterSight* sight = nullptr)
      : scene_(scene),
        resolver_(resolver),
        random_(seed, stream),
        next_event_(scene, resolver, random_, stream == RandomStream::picture, sight),
        met_(scene, resolver, random_, next_event_),
        view_(scene, resolver, next_event_.media(), met_),
        models_(static_cast<size_t>(scene.bands.count())) {
    // A picture shows colours; an estimate of luminance needs few.
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
    for (int b = 0; b < scene.bands.count(); ++b) hero_.push_back(band_probability(b));
  }

  Random& random() { return random_; }
  /// The emitter hits along rays.
  EmittersMet<Resolver>& emitters() { return met_; }

  /// Chooses a path's band, or the hero of all bands, from a uniform number; and its probability.
  int choose_band(double u) const {
    const auto it = std::upper_bound(band_cdf_.begin(), band_cdf_.end(), u);
    return static_cast<int>(std::min<std::ptrdiff_t>(
        it - band_cdf_.begin(), static_cast<std::ptrdiff_t>(band_cdf_.size()) - 1));
  }
  double band_probability(int b) const {
    return band_cdf_[static_cast<size_t>(b)] - (b > 0 ? band_cdf_[static_cast<size_t>(b - 1)] : 0);
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] in `band` that arrives against `ray.direction`,
  /// from one path. `counted`: emitter hits that count before the first event. `cache`: the cache
  /// in which paths may end after their first diffuse event; null traces them to their end.
  void radiance(const Ray& ray, int band, EmitterHits counted, double weight, GroupLight& into,
                const RadianceCache* cache = nullptr) {
    ends_.clear();
    trace({ray, PathBands::one(band), counted, weight, into}, cache, 0);
  }

  /// The radiance of all bands, in `into.by_band()`, by one path that is sampled for one band, the
  /// hero (hero wavelength sampling). Requires: heroes are chosen by choose_band. `first`: receives
  /// the noise-free data of the ray; null: not needed.
  void radiance_of_all(const Ray& ray, int hero, EmitterHits counted, GroupLight& into,
                       const RadianceCache* cache = nullptr, FirstHit* first = nullptr) {
    ends_.clear();
    const Path path{ray, PathBands::all(hero_, hero), counted, 1, into};
    next_event_.start_event(0);  // before the ray: computing glows may drop the cell of its hit
    if (cache != nullptr || first != nullptr) met_first_ = view_.meet(ray, path.bands);
    if (first != nullptr) view_.describe(ray, path.bands, met_first_, *first);
    if (cache == nullptr) return trace(path, nullptr, 0);
    split(path, {cache, false}, scene_.features.media == MediaNeed::none ? 1 : limits::path_parts);
    for (const Path& part : parts_) trace(part, cache, 1);
  }

  /// Cached light at which the last path of radiance() has ended, or the parts of the last path of
  /// radiance_of_all().
  std::span<const CachedEnd> ends() const { return ends_; }

  /// Continues a path that a Lambertian surface has scattered along `ray`, after
  /// `add_reflected_light` has sampled emitters there.
  void radiance_after_reflection(const Ray& ray, const Vec3& normal, int band, double weight,
                                 GroupLight& into) {
    Path path{ray, PathBands::one(band), EmitterHits::weighted, weight, into};
    path.vertex.place = ray.origin;
    path.vertex.normal = normal;
    path.vertex.pdf = static_cast<double>(cosine_pdf(glm::dot(ray.direction, normal)));
    trace(path, nullptr, 0);
  }

  /// Continues a path that a medium has scattered to `direction` at the collision of `flight` along
  /// `line`, after `add_single_scattering` has sampled emitters for it.
  void radiance_after_scattering(const Ray& line, Real length, const FreeFlight& flight,
                                 double share, const Vec3& direction, int band, double weight,
                                 GroupLight& into) {
    const ScatteringVertex vertex =
        scattered({line, line_end(scene_, length), share, PathBands::one(band)}, flight, direction);
    Path path{{vertex.place, direction}, PathBands::one(band), EmitterHits::weighted, weight, into};
    path.vertex = vertex;
    trace(path, nullptr, 0);
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] of emitters that the medium on the first `length`
  /// of the ray scatters once against it. `flight` is one sample along it, whose collisions have
  /// the density sigma_t exp(-depth) / `share`: 1 for a free flight, less if a collision was
  /// forced.
  void add_single_scattering(const Ray& ray, Real length, const FreeFlight& flight, double share,
                             int band, double weight, GroupLight& into) {
    if (scene_.features.media == MediaNeed::none) return;
    next_event_.add_scattered({ray, line_end(scene_, length), share, PathBands::one(band)}, flight,
                              {flight.albedo}, weight, into);
  }

  /// Adds `weight` times the emitted light that a surface reflects against `direction`, by sampling
  /// one emitter. Requires: the surface is no part of a luminaire's body.
  void add_reflected_light(const Vec3& place, const Vec3& direction, const Vec3& normal,
                           const SurfaceModel& model, int band, double weight, GroupLight& into) {
    next_event_.add_reflected(place, direction, normal, {&model, 1}, 0, PathBands::one(band),
                              weight, into);
  }

 private:
  using Path = EyePath;

  /// Splits a path at its first event. All parts share the ray from the eye, and the emitters
  /// sampled on its surface and near it; their flights and directions are stratified. Writes the
  /// parts that continue to `parts_`. Requires: `met_first_` belongs to the path.
  void split(Path path, const PathEnds& ends, int parts) {
    parts_.clear();
    flights_.clear();
    const Hit& hit = met_first_.hit;
    if (path.counted != EmitterHits::none) met_.add_along(path, hit);
    const bool media = scene_.features.media != MediaNeed::none;
    const Real end = line_end(scene_, hit.distance);
    // Without a surface a flight may go beyond the segment's end, so none is forced.
    const bool may_force = media && hit.found();
    const double more = may_force ? more_collisions(path) : 1;
    // Collisions of all parts together are denser than those of one free flight.
    const RaySegment segment{path.ray, end, 1.0 / (parts * more), path.bands};
    if (media) {
      const double collides = may_force ? 1 - met_first_.passed[path.bands.hero_place()] : 1;
      const uint32_t bits = random_.bits();
      const Real choice = random_.uniform();
      constexpr double step = 0.6180339887498949;  // the golden ratio's
      for (int i = 0; i < parts; ++i) {
        const double u = uniform_of(bits_of_part(bits, i, parts)) / more;
        if (u >= collides) continue;
        flights_.push_back(fly_by(path.ray, hit.distance, path.bands.hero(), -std::log1p(-u),
                                  moved_on(choice, i, step)));
      }
      std::erase_if(flights_, [](const FreeFlight& flight) { return !flight.collided; });
    }
    const int passing = parts - static_cast<int>(flights_.size());
    if (passing > 0 && hit.found()) split_at_surface(path, hit, passing, parts, more);
    // Last, since learning cells may drop the cell of the hit.
    if (media) split_in_medium(path, segment, ends);
  }

  /// Factor by which the first flight collides more often than in free flight, equal for all bands.
  /// Thin smoke of high albedo contributes more light than its few collisions would sample well.
  double more_collisions(const Path& path) const {
    const BandValues& through = met_first_.passed;
    const double least = *std::min_element(through.begin(), through.begin() + path.bands.count());
    const double free = 1 - least;
    if (!(free > 0)) return 1;
    const double brought = limits::collision_worth * next_event_.media().max_scattered() * free;
    const double wanted = std::min(limits::max_forced, brought / (brought + least));
    return std::max(1.0, wanted / free);
  }

  /// Updates the light that reaches the surface through the media, if flights collide `more` times
  /// as often as free ones.
  void reach_surface(Path& p, double more) {
    const BandValues& through = met_first_.passed;
    for (size_t i = 0; i < p.bands.count(); ++i) drawn_[i] = 1 - more * (1 - through[i]);
    const double all = p.bands.mixed([&](size_t i) { return drawn_[i]; });
    for (size_t i = 0; i < p.bands.count(); ++i) passed_[i] = through[i] / all;
    p.bands.go_on(passed_, drawn_, all);
  }

  /// Continues `passing` of the parts at the surface.
  void split_at_surface(Path path, const Hit& hit, int passing, int parts, double more) {
    if (scene_.features.media != MediaNeed::none) reach_surface(path, more);
    if (!pass_flames(path, hit.distance)) return;
    const SurfaceEvent event = meet(path, hit);
    path.weight *= static_cast<double>(passing) / parts;
    add_reflected(path, event);
    path.weight /= passing;
    const TurnNumbers numbers = surface_numbers();
    for (int i = 0; i < passing; ++i) {
      Path part = path;
      if (turn_at_surface(part, event, numbers.of_part(i))) parts_.push_back(part);
    }
  }

  /// Continues the parts whose flights, `flights_`, have collided.
  void split_in_medium(const Path& path, const RaySegment& segment, const PathEnds& ends) {
    const bool emitters_near = next_event_.add_near(segment, path.weight, path.into, ends);
    if (flights_.empty()) return;
    const TurnNumbers numbers = medium_numbers();
    for (size_t i = 0; i < flights_.size(); ++i) {
      Path part = path;
      pass_media(part, flights_[i]);
      next_event_.add_collided(segment, flights_[i], emitters_near, passed_, path.weight, path.into,
                               ends);
      if (!pass_flames(part, flights_[i].t) || part.bands.brightest() <= 0) continue;
      part.weight *= segment.share;
      const CachedLight cached = add_cached_of_medium(part, flights_[i], ends);
      turn_in_medium(part, flights_[i], segment, numbers.of_part(static_cast<int>(i)), cached);
      parts_.push_back(part);
    }
  }

  /// Traces a path from event number `first` on.
  void trace(Path path, const RadianceCache* cache, int first) {
    for (int event = first; event < limits::eye_events; ++event) {
      next_event_.start_event(event);
      const Hit hit = resolver_.nearest(path.ray);
      if (path.counted != EmitterHits::none) met_.add_along(path, hit);
      const PathEnds ends{cache, path.diffused};
      if (path.scattered_cached) {
        if (!hit.found()) return;
        pass_without_collision(path, line_end(scene_, hit.distance));
        if (!meet_surface(path, hit, ends)) return;
        continue;
      }
      const RaySegment segment{path.ray, line_end(scene_, hit.distance), 1, path.bands};
      const FreeFlight flight = fly(path.ray, hit.distance, path.bands.hero());
      pass_media(path, flight);
      const bool passes = pass_flames(path, flight.collided ? flight.t : hit.distance);
      const double weight = path.weight;  // before the scattering
      const bool alive = passes && (flight.collided ? scatter(path, flight, segment, ends)
                                                    : meet_surface(path, hit, ends));
      // Last, since learning cells may drop the cell of the hit.
      if (scene_.features.media != MediaNeed::none)
        next_event_.add_scattered(segment, flight, passed_, weight, path.into, ends);
      if (!alive || (event >= 2 && !survives_roulette(path.bands))) return;
    }
  }

  FreeFlight fly(const Ray& ray, Real length, int band) {
    if (scene_.features.media == MediaNeed::none) return {};
    const double u = uniform_of(random_.bits());
    return fly_by(ray, length, band, -std::log(1 - u), random_.uniform());
  }

  /// In [0, 1), in steps of 2^-32.
  static double uniform_of(uint32_t bits) { return static_cast<double>(bits) * 0x1p-32; }

  FreeFlight fly_by(const Ray& ray, Real length, int band, double tau, Real choice) {
    return free_flight<MediaNeed::general>(scene_.media, band, ray.origin, ray.direction, length,
                                           tau, choice, resolver_);
  }

  /// Applies the transmittance of a segment whose in-scattered light was taken from the cache.
  void pass_without_collision(Path& p, Real end) {
    next_event_.media().transmittances(p.ray, end, p.bands, passed_, resolver_);
    for (size_t i = 0; i < p.bands.count(); ++i) p.bands.scale(i, passed_[i]);
  }

  /// Updates light and shares of bands after a flight; `passed_` keeps the light after a collision.
  void pass_media(Path& p, const FreeFlight& flight) {
    if (scene_.features.media == MediaNeed::none) return;
    if (flight.collided) next_event_.media().albedos(flight, p.bands, passed_);
    if (p.bands.many() && !next_event_.media().grey()) {
      next_event_.media().flight_densities(p.ray, flight, p.bands, drawn_, resolver_);
      const double all = p.bands.mixed([&](size_t i) { return drawn_[i]; });
      for (size_t i = 0; i < p.bands.count(); ++i)
        passed_[i] = (flight.collided ? passed_[i] : 1) * drawn_[i] / all;
      p.bands.go_on(passed_, drawn_, all);
    } else if (flight.collided) {
      for (size_t i = 0; i < p.bands.count(); ++i) p.bands.scale(i, passed_[i]);
    }
  }

  /// Light from a place of a ray that shows steady flames at a moment. False: they hide it all.
  bool pass_flames(Path& p, Real distance) {
    FlameMoment* const moment = met_.moment();
    if (moment == nullptr || p.diffused) return true;
    moment->meet(p.ray, std::min(distance, line_end(scene_, distance)), p.bands);
    for (size_t i = 0; i < p.bands.count(); ++i)
      p.bands.scale(i, moment->on_light_from(static_cast<double>(distance), i));
    return p.bands.brightest() > 0;
  }

  bool reflects_diffusely(const Hit& hit, const Ray& ray) const {
    const bool front = glm::dot(hit.triangle->unit_normal(), ray.direction) < 0;
    const MaterialKind kind = material_at(scene_, hit, front).kind;
    return kind == MaterialKind::lambertian || kind == MaterialKind::glossy;
  }

  /// Medium event: a new direction, or the end in the cache. NextEvent samples the light of
  /// emitters that is not in the cache. False ends the path.
  bool scatter(Path& p, const FreeFlight& flight, const RaySegment& segment, const PathEnds& ends) {
    if (p.bands.brightest() <= 0) return false;
    const CachedLight cached = add_cached_of_medium(p, flight, ends);
    if (cached == CachedLight::all) return false;
    turn_in_medium(p, flight, segment, medium_numbers(), cached);
    return true;
  }

  /// Adds cached light at a collision. Returns which light that was: the rest of the path must not
  /// find it again.
  CachedLight add_cached_of_medium(Path& p, const FreeFlight& flight, const PathEnds& ends) {
    const Vec3 place = p.ray.origin + p.ray.direction * flight.t;
    const CachedLight which = ends.in_medium(place);
    if (which == CachedLight::nothing) return which;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const Vec3& direction = p.ray.direction;
    const Real x = random_.uniform();
    const Real y = random_.uniform();
    const uint32_t voxel = ends.cache->choose_voxel(place, {x, y, random_.uniform()}, which);
    for (size_t i = 0; i < p.bands.count(); ++i)
      add_cached(p, i, ends.cache->of_medium(voxel, direction, phase, p.bands.band(i), which));
    end_in_cache([&] { return ends.cache->error_of_medium(voxel, direction, phase, which); });
    return which;
  }

  TurnNumbers medium_numbers() {
    TurnNumbers out;
    if (aims()) out.choice = random_.uniform_double();
    out.u = random_.uniform();
    out.v = random_.uniform();
    return out;
  }

  void turn_in_medium(Path& p, const FreeFlight& flight, const RaySegment& segment,
                      const TurnNumbers& numbers, CachedLight cached) {
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const GlowGuide& guide =
        next_event_.guide_at(p.ray.origin + p.ray.direction * flight.t, Vec3(0), cached);
    const Vec3 direction = numbers.choice < guide.aimed()
                               ? guide.direction(numbers.choice, numbers.u, numbers.v)
                               : sample(phase, p.ray.direction, numbers.u, numbers.v);
    p.vertex = scattered(segment, flight, direction);
    weigh_aimed(p, direction);
    p.ray = {p.vertex.place, direction};
    p.counted = EmitterHits::weighted;
    p.travelled = 0;
    p.bodies.clear();
    p.diffused = true;
    p.scattered_cached = cached == CachedLight::scattered;
  }

  /// Whether a part of the directions is guided towards glows.
  bool aims() const { return !next_event_.guide().empty(); }

  /// For a direction whose unguided density is `p.vertex.pdf`: replaces it by the density of the
  /// mixture, and weights the path by the ratio. Russian roulette ignores this weight: guided
  /// directions are rare for the unguided technique, not of low contribution.
  void weigh_aimed(Path& p, const Vec3& direction) {
    if (!aims()) return;
    const double own = p.vertex.pdf;
    p.vertex.pdf = next_event_.guide().density(direction, own);
    p.weight *= own / p.vertex.pdf;
  }

  ScatteringVertex scattered(const RaySegment& segment, const FreeFlight& flight,
                             const Vec3& direction) {
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const Vec3& before = segment.ray.direction;
    return {segment.ray.origin + before * flight.t,
            static_cast<double>(evaluate(phase, glm::dot(before, direction))),
            Vec3(0),
            true,
            segment,
            flight.t};
  }

  /// Surface event; the path may end in the cache. False ends it.
  bool meet_surface(Path& p, const Hit& hit, const PathEnds& ends) {
    if (!hit.found()) return false;
    const RadianceCache* cache = ends.cache;
    if (!ends.on_surfaces() || !reflects_diffusely(hit, p.ray)) return bounce(p, hit);
    const bool front = glm::dot(hit.triangle->unit_normal(), p.ray.direction) < 0;
    for (size_t i = 0; i < p.bands.count(); ++i)
      add_cached(p, i, cache->of_surface(hit, front, p.bands.band(i)));
    end_in_cache([&] { return cache->error_of_surface(hit, front); });
    return false;
  }

  /// Adds cached radiance of the band in place `i`.
  void add_cached(Path& p, size_t i, double radiance) {
    const double brought = p.weight * p.bands.light(i) * radiance;
    p.into.add_of_all(p.bands.band(i), brought);
    brought_luminance_ += brought * scene_.bands[p.bands.band(i)].lm_per_w;
  }

  /// Call after all bands were added.
  template <class ErrorOf>
  void end_in_cache(ErrorOf&& error_of) {
    if (brought_luminance_ > 0) ends_.push_back({error_of(), brought_luminance_});
    brought_luminance_ = 0;
  }

  /// A surface event of a path.
  struct SurfaceEvent {
    Vec3 place, normal;  // on the path's side
    Vec3 before;         // the place, offset from the surface
    bool front;
    Real distance;  // along the path's ray
    int body;       // of which the surface is a part, or 0
  };

  /// Surface event: samples an emitter, then a new direction. False ends the path.
  bool bounce(Path& p, const Hit& hit) {
    const SurfaceEvent event = meet(p, hit);
    add_reflected(p, event);
    return turn_at_surface(p, event, surface_numbers());
  }

  /// Writes the surface's reflection models to `models_`.
  SurfaceEvent meet(const Path& p, const Hit& hit) {
    const TriangleRecord& t = *hit.triangle;
    const bool front = glm::dot(t.unit_normal(), p.ray.direction) < 0;
    for (size_t i = 0; i < p.bands.count(); ++i)
      models_[i] = surface_at(scene_, hit, front, p.bands.band(i), material_at(scene_, hit, front),
                              resolver_);
    const Vec3 normal = front ? t.unit_normal() : -t.unit_normal();
    const Vec3 place = t.at(hit.u, hit.v);
    return {place, normal,       offset_ray(place, normal, scene_.min_offset_m),
            front, hit.distance, scene_.surfaces[t.surface].body};
  }

  void add_reflected(Path& p, const SurfaceEvent& e) {
    const SurfaceKind kind = models_[p.bands.hero_place()].kind;
    if (kind == SurfaceKind::lambertian || kind == SurfaceKind::glossy)
      next_event_.add_reflected(e.before, p.ray.direction, e.normal, models_, e.body, p.bands,
                                p.weight, p.into);
  }

  TurnNumbers surface_numbers() {
    TurnNumbers out;
    out.lobe = random_.uniform();
    out.u = random_.uniform();
    out.v = random_.uniform();
    if (aims() && models_[0].kind == SurfaceKind::lambertian) out.choice = random_.uniform_double();
    return out;
  }

  /// False ends the path.
  bool turn_at_surface(Path& p, const SurfaceEvent& e, const TurnNumbers& numbers) {
    const SurfaceModel& model = models_[p.bands.hero_place()];
    const Vec3& normal = e.normal;
    SurfaceSample s =
        sample_surface(model, p.ray.direction, normal, e.front, numbers.lobe, numbers.u, numbers.v);
    const bool aimed = aims() && model.kind == SurfaceKind::lambertian;
    if (aimed && !aim_reflection(e, numbers, s)) return false;
    double pdf = 0;
    if (!reflect_bands(p, s, normal, pdf)) return false;
    // Passing straight through a pane is no event: next-event estimation accounts for it.
    const bool straight = s.specular && s.transmitted && model.kind != SurfaceKind::dielectric;
    if (straight) {
      p.travelled += e.distance;
    } else {
      p.counted = s.specular ? EmitterHits::all : EmitterHits::weighted;
      p.travelled = 0;
      p.scattered_cached = false;
      p.bodies.clear();
    }
    if (e.body != 0) note_body(p, e, straight);
    p.ray.direction = s.direction;
    p.ray.origin = offset_ray(e.place, s.transmitted ? -normal : normal, scene_.min_offset_m);
    if (s.specular) return true;
    p.diffused = true;
    p.vertex.place = p.ray.origin;
    p.vertex.pdf = pdf;
    p.vertex.normal = normal;
    p.vertex.in_medium = false;
    if (aimed) weigh_aimed(p, s.direction);
    return true;
  }

  /// Requires: `models_` are those of the surface, and the path still has its old direction.
  void note_body(Path& p, const SurfaceEvent& e, bool straight) const {
    BodyMet met{e.body, straight, {}};
    const Real cosine = glm::dot(p.ray.direction, e.normal);
    for (size_t i = 0; straight && i < p.bands.count(); ++i)
      met.transmittance[i] = straight_transmittance(models_[i], cosine);
    p.bodies.push_back(met);
  }

  /// Replaces the direction of a Lambertian reflection if it is to be guided. False: it points
  /// below the horizon, where nothing is reflected.
  bool aim_reflection(const SurfaceEvent& e, const TurnNumbers& numbers, SurfaceSample& s) {
    const GlowGuide& guide = next_event_.guide_at(e.before, e.normal, CachedLight::nothing);
    if (numbers.choice >= guide.aimed()) return true;
    s.direction = guide.direction(numbers.choice, numbers.u, numbers.v);
    return glm::dot(s.direction, e.normal) > 0;
  }

  /// Updates each band for a direction sampled with the hero's model, by `models_`; and computes
  /// the density [1/sr] of that direction in the hero mixture. False: nothing continues.
  bool reflect_bands(Path& p, const SurfaceSample& s, const Vec3& normal, double& pdf) {
    const SurfaceModel& hero = models_[p.bands.hero_place()];
    const Vec3 wo = -p.ray.direction;
    const auto density_of = [&](const SurfaceModel& model) {
      return static_cast<double>(surface_pdf(model, wo, s.direction, normal));
    };
    if (!p.bands.many() || hero.kind == SurfaceKind::open || hero.kind == SurfaceKind::dielectric) {
      for (size_t i = 0; i < p.bands.count(); ++i) p.bands.scale(i, static_cast<double>(s.weight));
      if (!s.specular) pdf = density_of(hero);
    } else if (hero.kind == SurfaceKind::lambertian || hero.kind == SurfaceKind::mirror) {
      const bool mirror = hero.kind == SurfaceKind::mirror;
      for (size_t i = 0; i < p.bands.count(); ++i)
        p.bands.scale(i,
                      static_cast<double>(mirror ? models_[i].specular : models_[i].reflectance));
      if (!mirror) pdf = density_of(hero);
    } else {
      for (size_t i = 0; i < p.bands.count(); ++i) share_lobes(models_[i], s, wo, normal, i);
      if (!(s.weight > 0 && drawn_[p.bands.hero_place()] > 0)) return false;
      pdf = p.bands.mixed([&](size_t i) { return drawn_[i]; });
      for (size_t i = 0; i < p.bands.count(); ++i) passed_[i] /= pdf;
      p.bands.go_on(passed_, drawn_, pdf);
    }
    return p.bands.brightest() > 0;
  }

  /// For a glossy surface or a pane in the band in place `i`: writes the light that continues in
  /// the sampled direction to `passed_`, and the density of sampling it to `drawn_`.
  void share_lobes(const SurfaceModel& model, const SurfaceSample& s, const Vec3& wo,
                   const Vec3& normal, size_t i) {
    if (model.kind == SurfaceKind::glossy) {
      const auto cosine = static_cast<double>(glm::dot(s.direction, normal));
      drawn_[i] = static_cast<double>(surface_pdf(model, wo, s.direction, normal));
      passed_[i] = std::max(0.0, cosine) *
                   static_cast<double>(evaluate_surface(model, wo, s.direction, normal));
      return;
    }
    const PaneShares shares = pane_shares(model, glm::dot(wo, normal));
    passed_[i] = static_cast<double>(s.transmitted ? shares.transmitted : shares.reflected);
    const auto sum = static_cast<double>(shares.transmitted + shares.reflected);
    drawn_[i] = sum > 0 ? passed_[i] / sum : 0;
  }

  bool survives_roulette(PathBands& bands) {
    const double brightest = bands.brightest();
    if (brightest >= 0.2) return true;
    const double survival = brightest / 0.4;
    const auto u = static_cast<double>(random_.uniform());
    if (u >= survival) return false;
    bands.survive(survival);
    return true;
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random random_;
  std::vector<double> band_cdf_, hero_;  // hero_: probabilities
  NextEvent<Resolver> next_event_;
  EmittersMet<Resolver> met_;
  EyeView<Resolver> view_;
  std::vector<SurfaceModel> models_;  // of the path's bands, at the last surface
  BandValues passed_, drawn_;
  EyeRay met_first_;                 // of the last path of all bands
  std::vector<Path> parts_;          // of the last split path
  std::vector<FreeFlight> flights_;  // of its parts
  std::vector<CachedEnd> ends_;
  double brought_luminance_ = 0;  // by the end that is being added
};

}  // namespace luxodus
