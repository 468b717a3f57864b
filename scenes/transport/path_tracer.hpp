// A path tracer: radiance along a ray, traced from where it is seen, the eye or a probe. Paths run
// backwards (all laws are reciprocal), in one band or in all at once. At every event one emitter is
// sampled directly (next-event estimation, next_event.hpp), and a path also counts the emitters
// that it hits, each by its weight. Unbiased, except where pictures end a path in what a run has
// counted (final gather). eye_paths.hpp estimates signs and probes with it. Not seen: point
// emitters and caustics through mirrors and refracting solids; the forward tracer counts those.
// Thread rule: one PathTracer per thread or fiber.
#pragma once

#include <cmath>

#include "runtime/core/random.hpp"
#include "scenes/geometry/real.hpp"
#include "scenes/tally/batch_scores.hpp"
#include "scenes/transport/connect.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/first_hit.hpp"
#include "scenes/transport/flame_boxes.hpp"
#include "scenes/transport/group_light.hpp"
#include "scenes/transport/known_radiance.hpp"
#include "scenes/transport/next_event.hpp"
#include "scenes/transport/textures.hpp"

namespace luxodus {

namespace limits {
inline constexpr int eye_events = 10'000;
inline constexpr int emitters_per_line = 16;  // emitting faces that one straight line may cross
/// Of the size of a scene: where a stretch ends on which places are drawn by an emitter's light.
inline constexpr Real longest_line = 4;
}  // namespace limits

/// Which emitters count when a path meets them on its way.
enum class EmitterHits {
  none,      // somebody else holds all direct light of this place
  weighted,  // emitters were sampled too: by the balance heuristic
  all,       // none was sampled
};

template <class Resolver>
class PathTracer {
 public:
  /// `sight`: what emitters are chosen by; null: by power and distance alone.
  PathTracer(const CompiledScene& scene, Resolver& resolver, uint64_t seed, RandomStream stream,
             const EmitterSight* sight = nullptr)
      : scene_(scene),
        resolver_(resolver),
        random_(seed, stream),
        next_event_(scene, resolver, random_, stream == RandomStream::picture, sight),
        models_(static_cast<size_t>(scene.bands.count())),
        straight_(scene.groups.size(), static_cast<size_t>(scene.bands.count())),
        flames_(flame_boxes(scene)) {
    // A picture shows colours, an estimate of luminance needs few.
    const double colour = stream == RandomStream::picture ? 1.0 : 0.05;
    double total = 0;
    for (int b = 0; b < scene.bands.count(); ++b) {
      double power = 0;
      for (const Group& g : scene.groups) power += g.power_w[static_cast<size_t>(b)];
      const Band& band = scene.bands[b];
      total += power * (band.lm_per_w + colour * (band.x_per_w + band.z_per_w));
      band_cdf_.push_back(total);
      if (band.lm_per_w > scene.bands[brightest_band_].lm_per_w) brightest_band_ = b;
    }
    for (double& c : band_cdf_) c /= total;
    for (int b = 0; b < scene.bands.count(); ++b) hero_.push_back(band_probability(b));
  }

  Random& random() { return random_; }

  /// A band for a path, or the hero of all, from a uniform number; and the probability of it.
  int choose_band(double u) const {
    const auto it = std::upper_bound(band_cdf_.begin(), band_cdf_.end(), u);
    return static_cast<int>(std::min<std::ptrdiff_t>(
        it - band_cdf_.begin(), static_cast<std::ptrdiff_t>(band_cdf_.size()) - 1));
  }
  double band_probability(int b) const {
    return band_cdf_[static_cast<size_t>(b)] - (b > 0 ? band_cdf_[static_cast<size_t>(b - 1)] : 0);
  }

  /// What is known of the ray without chance. `first` keeps its memory.
  void meet_first(const Ray& ray, FirstHit& first) {
    const auto bands = static_cast<size_t>(scene_.bands.count());
    first.emitted.assign(bands, 0.0);
    straight_.clear();
    PathBands through = PathBands::all(hero_, brightest_band_);  // what panes and media let pass
    Ray rest = ray;
    Real passed = 0;
    Hit hit = resolver_.nearest(rest);
    for (int pane = 0; pane < limits::panes_per_line; ++pane) {
      Path path{rest, through, EmitterHits::all, 1, straight_};
      add_emitted_along(path, hit);
      if (!hit.found() || !pass_straight(rest, hit, through)) break;
      passed += hit.distance;
      hit = resolver_.nearest(rest);
    }
    std::copy_n(straight_.by_band().begin(), bands, first.emitted.begin());
    describe(hit, rest, passed, first);
    first.transmittance = medium_transmittance(scene_, ray, line_end(passed + hit.distance),
                                               brightest_band_, resolver_);
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] in `band` that arrives against `ray.direction`,
  /// from one path. `counted`: which emitters count before the first event. `known`: in which light
  /// paths may end after their first diffuse event; null traces them to their end.
  void radiance(const Ray& ray, int band, EmitterHits counted, double weight, GroupLight& into,
                const KnownRadiance* known = nullptr) {
    trace({ray, PathBands::one(band), counted, weight, into}, known);
  }

  /// The same of all bands, by `into.by_band()`, where the path goes as a hero's. Requires: heroes
  /// are drawn by choose_band.
  void radiance_of_all(const Ray& ray, int hero, EmitterHits counted, GroupLight& into,
                       const KnownRadiance* known = nullptr) {
    end_ = {};
    trace({ray, PathBands::all(hero_, hero), counted, 1, into}, known);
  }

  /// Where the last path of radiance_of_all() has ended, if that was in known light.
  const KnownEnd& end() const { return end_; }

  /// The same of a path that a Lambertian surface has sent along `ray`, where `reflected_light` has
  /// sampled emitters.
  void radiance_after_reflection(const Ray& ray, const Vec3& normal, int band, double weight,
                                 GroupLight& into) {
    Path path{ray, PathBands::one(band), EmitterHits::weighted, weight, into};
    path.turn.place = ray.origin;
    path.turn.normal = normal;
    path.turn.pdf = static_cast<double>(cosine_pdf(glm::dot(ray.direction, normal)));
    trace(path, nullptr);
  }

  /// The same of a path that a medium has turned to `direction`, where `flight` along `line`, for
  /// which `add_single_scattering` has sampled emitters, has collided.
  void radiance_after_scattering(const Ray& line, Real length, const FreeFlight& flight,
                                 double share, const Vec3& direction, int band, double weight,
                                 GroupLight& into) {
    const PathTurn turn =
        scattered({line, line_end(length), share, PathBands::one(band)}, flight, direction);
    Path path{{turn.place, direction}, PathBands::one(band), EmitterHits::weighted, weight, into};
    path.turn = turn;
    trace(path, nullptr);
  }

  /// Adds `weight` times the radiance [W/(m2 sr)] that emitters send to the first `length` of the
  /// ray and the medium there turns against it, once. `flight` is one along it whose collisions
  /// have the density sigma_t exp(-depth) / `share`: 1 if it was free, less if a collision was
  /// forced.
  void add_single_scattering(const Ray& ray, Real length, const FreeFlight& flight, double share,
                             int band, double weight, GroupLight& into) {
    if (scene_.features.media == MediaNeed::none) return;
    next_event_.add_scattered({ray, line_end(length), share, PathBands::one(band)}, flight,
                              {flight.albedo}, weight, into);
  }

  /// Adds `weight` times the light of an emitter that a surface sends against `direction`; one
  /// emitter is sampled.
  void add_reflected_light(const Vec3& place, const Vec3& direction, const Vec3& normal,
                           const SurfaceModel& model, int band, double weight, GroupLight& into) {
    next_event_.add_reflected(place, direction, normal, {&model, 1}, PathBands::one(band), weight,
                              into);
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
  /// (-1). False where the ray meets none of them.
  bool add_flames(const Ray& ray, Real length, int band, int medium, double weight,
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
            if (flame == nullptr) continue;  // the scenario has put it out
            const double power = flame->power_w[static_cast<size_t>(band)] * part.density;
            into.add(flame->group, band,
                     weight * power * std::exp(-depth) * through / (4 * static_cast<double>(pi_f)));
          }
          depth += tau;
          return depth < 50;
        });
    return met || depth >= 50;
  }

 private:
  struct Path {
    Ray ray;
    PathBands bands;
    EmitterHits counted;
    double weight;
    GroupLight& into;
    PathTurn turn{};        // where `counted` is weighted
    Real travelled = 0;     // from the last event to the ray's origin, through panes
    bool diffused = false;  // a surface or a medium has spread it

    /// Light of the band in place `i`.
    void add(size_t i, const SourceLight& light) {
      into.add(light.group, bands.band(i), weight * bands.light(i) * light.radiance);
    }
  };

  // ---- what is known without chance
  // ------------------------------------------------------------------------------------

  /// Through a pane or an open surface, on the same line; false: something else ends the line.
  bool pass_straight(Ray& ray, const Hit& hit, PathBands& through) {
    const TriangleRecord& t = *hit.triangle;
    const Real cosine = glm::dot(t.unit_normal(), ray.direction);
    const CompiledMaterial& material = material_at(hit, cosine < 0);
    if (material.kind != MaterialKind::glass_pane && material.kind != MaterialKind::open)
      return false;
    next_event_.media().transmittances(ray, line_end(hit.distance), through, passed_, resolver_);
    for (size_t b = 0; b < through.count(); ++b) {
      if (material.kind == MaterialKind::glass_pane)
        passed_[b] *= static_cast<double>(pane_transmittance(material.by_band[b], cosine));
      through.scale(b, passed_[b]);
    }
    ray.origin = offset_ray(t.at(hit.u, hit.v), cosine < 0 ? -t.unit_normal() : t.unit_normal(),
                            scene_.min_offset_m);
    return true;
  }

  void describe(const Hit& hit, const Ray& ray, Real passed, FirstHit& first) {
    first.reflectance.assign(models_.size(), 0.0);
    first.normal = Vec3(0);
    first.nearness = 0;
    if (!hit.found()) return;
    const Vec3 normal = hit.triangle->unit_normal();
    const bool front = glm::dot(normal, ray.direction) < 0;
    first.normal = front ? normal : -normal;
    first.nearness = 1 / static_cast<double>(passed + hit.distance);
    const CompiledMaterial& material = material_at(hit, front);
    for (size_t b = 0; b < models_.size(); ++b)
      first.reflectance[b] = static_cast<double>(
          surface_at(scene_, hit, front, static_cast<int>(b), material, resolver_).reflectance);
  }

  // ---- events
  // ------------------------------------------------------------------------------------

  void trace(Path path, const KnownRadiance* known) {
    for (int event = 0; event < limits::eye_events; ++event) {
      next_event_.start_event(event);
      const Hit hit = resolver_.nearest(path.ray);
      if (path.counted != EmitterHits::none) add_emitted_along(path, hit);
      const Stretch stretch{path.ray, line_end(hit.distance), 1, path.bands};
      const FreeFlight flight = fly(path.ray, hit.distance, path.bands.hero());
      pass_media(path, flight);
      const KnownRadiance* end = path.diffused ? known : nullptr;  // where the path may end here
      const bool alive =
          flight.collided ? scatter(path, flight, stretch, end) : meet_surface(path, hit, end);
      // Last, since asking may drop the cell that the hit is of.
      if (scene_.features.media != MediaNeed::none)
        next_event_.add_scattered(stretch, flight, passed_, path.weight, path.into, end);
      if (!alive || (event >= 2 && !survives_roulette(path.bands))) return;
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

  /// The light and the shares of bands after a flight; `passed_` keeps what a collision lets go on.
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

  const CompiledMaterial& material_at(const Hit& hit, bool front) const {
    return scene_.materials[scene_.surfaces[hit.triangle->surface].material[front ? 0 : 1]];
  }

  bool reflects_diffusely(const Hit& hit, const Ray& ray) const {
    const bool front = glm::dot(hit.triangle->unit_normal(), ray.direction) < 0;
    const MaterialKind kind = material_at(hit, front).kind;
    return kind == MaterialKind::lambertian || kind == MaterialKind::glossy;
  }

  /// Medium event: a new direction, or the end in known light. Light sampled from emitters is
  /// NextEvent's, where it is not of the known. False ends the path.
  bool scatter(Path& p, const FreeFlight& flight, const Stretch& stretch,
               const KnownRadiance* known) {
    if (p.bands.brightest() <= 0) return false;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const Vec3 place = p.ray.origin + p.ray.direction * flight.t;
    if (known != nullptr && known->knows(place)) {
      for (size_t i = 0; i < p.bands.count(); ++i)
        add_known(p, i, known->of_medium(place, p.ray.direction, phase, p.bands.band(i)));
      if (end_.luminance > 0) end_.error = known->error_of_medium(place, p.ray.direction, phase);
      return false;
    }
    const auto choice = aims() ? random_.uniform_double() : 1.0;
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    next_event_.guide_at(place);
    const bool aimed = choice < next_event_.guide().aimed();
    const Vec3 direction =
        aimed ? next_event_.guide().direction(choice, u, v) : sample(phase, p.ray.direction, u, v);
    p.turn = scattered(stretch, flight, direction);
    weigh_aimed(p, direction);
    p.ray = {p.turn.place, direction};
    p.counted = EmitterHits::weighted;
    p.travelled = 0;
    p.diffused = true;
    return true;
  }

  /// Whether a part of the turns goes towards glows.
  bool aims() const { return !next_event_.guide().empty(); }

  /// Of a turn whose own density is `p.turn.pdf`: the density of both ways, and the light by it.
  /// Roulette does not ask for that: aimed turns are rare in the other way, not poor.
  void weigh_aimed(Path& p, const Vec3& direction) {
    if (!aims()) return;
    const double own = p.turn.pdf;
    p.turn.pdf = next_event_.guide().density(direction, own);
    p.weight *= own / p.turn.pdf;
  }

  PathTurn scattered(const Stretch& stretch, const FreeFlight& flight, const Vec3& direction) {
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const Vec3& before = stretch.ray.direction;
    return {stretch.ray.origin + before * flight.t,
            static_cast<double>(evaluate(phase, glm::dot(before, direction))),
            Vec3(0),
            true,
            stretch,
            flight.t};
  }

  /// Surface event, where the path may end in known light. False ends it.
  bool meet_surface(Path& p, const Hit& hit, const KnownRadiance* known) {
    if (!hit.found()) return false;
    if (known == nullptr || !reflects_diffusely(hit, p.ray)) return bounce(p, hit);
    const bool front = glm::dot(hit.triangle->unit_normal(), p.ray.direction) < 0;
    for (size_t i = 0; i < p.bands.count(); ++i)
      add_known(p, i, known->of_surface(hit, front, p.bands.band(i)));
    if (end_.luminance > 0) end_.error = known->error_of_surface(hit, front);
    return false;
  }

  /// Ends in known radiance of the band in place `i`.
  void add_known(Path& p, size_t i, double radiance) {
    const double brought = p.weight * p.bands.light(i) * radiance;
    p.into.add_of_all(p.bands.band(i), brought);
    end_.luminance += brought * scene_.bands[p.bands.band(i)].lm_per_w;
  }

  /// Surface event: light sampled from an emitter, then a new direction. False ends the path.
  bool bounce(Path& p, const Hit& hit) {
    const TriangleRecord& t = *hit.triangle;
    const bool front = glm::dot(t.unit_normal(), p.ray.direction) < 0;
    for (size_t i = 0; i < p.bands.count(); ++i)
      models_[i] =
          surface_at(scene_, hit, front, p.bands.band(i), material_at(hit, front), resolver_);
    const SurfaceModel& model = models_[p.bands.hero_place()];
    const Vec3 normal = front ? t.unit_normal() : -t.unit_normal();
    const Vec3 place = t.at(hit.u, hit.v);
    if (model.kind == SurfaceKind::lambertian || model.kind == SurfaceKind::glossy) {
      next_event_.add_reflected(offset_ray(place, normal, scene_.min_offset_m), p.ray.direction,
                                normal, models_, p.bands, p.weight, p.into);
    }
    const Real lobe = random_.uniform();
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    SurfaceSample s = sample_surface(model, p.ray.direction, normal, front, lobe, u, v);
    const bool aimed = aims() && model.kind == SurfaceKind::lambertian;
    if (aimed && !aim_reflection(offset_ray(place, normal, scene_.min_offset_m), normal, u, v, s))
      return false;
    double pdf = 0;
    if (!reflect_bands(p, s, normal, pdf)) return false;
    // Straight through a pane nothing has happened that asking does not know of.
    const bool straight = s.specular && s.transmitted && model.kind != SurfaceKind::dielectric;
    if (straight) {
      p.travelled += hit.distance;
    } else {
      p.counted = s.specular ? EmitterHits::all : EmitterHits::weighted;
      p.travelled = 0;
    }
    p.ray.direction = s.direction;
    p.ray.origin = offset_ray(place, s.transmitted ? -normal : normal, scene_.min_offset_m);
    if (s.specular) return true;
    p.diffused = true;
    p.turn.place = p.ray.origin;
    p.turn.pdf = pdf;
    p.turn.normal = normal;
    p.turn.in_medium = false;
    if (aimed) weigh_aimed(p, s.direction);
    return true;
  }

  /// Draws the direction of a Lambertian reflection anew, where it is an aimed one. False: it goes
  /// below the horizon, where nothing is sent.
  bool aim_reflection(const Vec3& place, const Vec3& normal, Real u, Real v, SurfaceSample& s) {
    const GlowGuide& guide = next_event_.guide_at(place);
    const double choice = random_.uniform_double();
    if (choice >= guide.aimed()) return true;
    s.direction = guide.direction(choice, u, v);
    return glm::dot(s.direction, normal) > 0;
  }

  /// What `models_` let go on of each band where the hero's has drawn the sample; and the density
  /// [1/sr] of the direction drawn, by the path's bands together. False: nothing goes on.
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

  /// Of a glossy surface or a pane in the band in place `i`: into `passed_` what of the light takes
  /// the sampled way, into `drawn_` how densely that is sampled.
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
      const double weight = weight_of_face(p, e.emitter, e.point, distance);
      next_event_.media().transmittances(p.ray, distance, p.bands, through_, resolver_);
      for (size_t i = 0; i < p.bands.count(); ++i) {
        const double sent =
            emitted_radiance(emitter, e.point, -p.ray.direction, p.bands.band(i), resolver_);
        p.add(i, {emitter.group, weight * sent * through_[i]});
      }
      // Past it by more than rounding, or the same face would be hit again.
      const Real step = e.distance * slack + scene_.min_offset_m;
      rest.origin += rest.direction * step;
      before += step;
      reach -= step;
      if (!(reach > 0)) break;
    }
    add_emitted_by_sign(p, hit);
    add_flames_met(p, hit.distance);
  }

  /// Weight of a point of an emitting face that the path hits, `distance` along its ray.
  double weight_of_face(const Path& p, uint32_t emitter, const EmissionPoint& point,
                        Real distance) {
    if (p.counted == EmitterHits::all) return 1;
    const double apparent_sr =
        apparent_face(scene_.emitters[emitter], point, -p.ray.direction, p.travelled + distance);
    return next_event_.weight_of_hit(p.turn, emitter, point.position, apparent_sr, p.bands);
  }

  void add_emitted_by_sign(Path& p, const Hit& hit) {
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
      p.add(i, {group, weight * own.radiance * through_[i]});
    }
  }

  /// Of a sign's face, each colour is an emitter.
  double weight_of_sign(const Path& p, uint32_t sign, int group, const EmissionPoint& point,
                        Real distance) {
    for (uint32_t i = 0; i < scene_.emitters.size(); ++i) {
      const CompiledEmitter& e = scene_.emitters[i];
      if (e.kind == EmitterKind::sign_face && e.sign == sign && e.group == group &&
          sampled_area_m2(e, point.position) > 0)
        return weight_of_face(p, i, point, distance);
    }
    return 1;  // nothing that is sampled: hits count alone
  }

  /// Flames on the line, up to the surface: all of their light, or what the weight leaves of it.
  void add_flames_met(const Path& p, Real length) {
    if (scene_.volume_points.empty()) return;
    if (p.counted == EmitterHits::all) {
      bool met = true;
      for (size_t i = 0; i < p.bands.count() && met; ++i)
        met = add_flames(p.ray, length, p.bands.band(i), -1, p.weight * p.bands.light(i), p.into);
      return;
    }
    for (const FlameBox& flame : flames_) add_flame_hit(p, flame, length);
  }

  /// A place of the line in proportion to the light that it sends back along it.
  struct FlamePlace {
    double light =
        0;  // of the whole line: emission density, times what passes, times length [1/m2]
    double density = 0;  // mean of the segment [1/m3]
    Real t = 0;
    bool missed = false;  // the line does not meet the flame
  };

  /// `u`: uniform.
  FlamePlace place_in_flame(const Path& p, int band, const CompiledEmitter& flame, Real length,
                            double u) {
    FlamePlace chosen;
    double depth = 0;
    for_each_segment(
        scene_.media, band, p.ray.origin, p.ray.direction, line_end(length), resolver_,
        [&](const MediaSegment& s) {
          const double tau = s.sigma_t * s.length;
          for (const EmissionPart& part : s.emission) {
            if (static_cast<uint32_t>(part.medium) != flame.medium) continue;
            const double through = s.sigma_t > 0 ? -std::expm1(-tau) / s.sigma_t : s.length;
            const double light = part.density * std::exp(-depth) * through;
            if (!(light > 0)) continue;
            chosen.light += light;
            const double share = light / chosen.light;
            if (u >= share) {  // used again for each segment: what is left is uniform
              u = (u - share) / (1 - share);
              continue;
            }
            u /= share;
            const double along =
                s.sigma_t > 0 ? -std::log1p(u * std::expm1(-tau)) / s.sigma_t : u * s.length;
            chosen.density = part.density;
            chosen.t = s.t0 + static_cast<Real>(along);
          }
          depth += tau;
          return depth < 50;
        });
    chosen.missed = !(chosen.light > 0) && depth < 50;
    return chosen;
  }

  void add_flame_hit(const Path& p, const FlameBox& box, Real length) {
    const uint32_t emitter = box.emitter;
    const CompiledEmitter& flame = scene_.emitters[emitter];
    const auto power = [&](size_t i) {
      return flame.power_w[static_cast<size_t>(p.bands.band(i))];
    };
    const size_t hero = p.bands.hero_place();
    if (!p.bands.many() && !(power(hero) > 0)) return;
    const double u = random_.uniform_double();
    if (!box.may_meet(p.ray, length)) return;
    const FlamePlace place = place_in_flame(p, p.bands.hero(), flame, length, u);
    if (place.missed) return;
    for (size_t i = 0; i < p.bands.count(); ++i) {
      if (!(power(i) > 0)) continue;
      // Bands see the flame through different depths of smoke.
      const bool same = i == hero || next_event_.media().grey();
      add_flame_place(p, i, emitter, power(i),
                      same ? place : place_in_flame(p, p.bands.band(i), flame, length, u));
    }
  }

  void add_flame_place(const Path& p, size_t i, uint32_t emitter, double power,
                       const FlamePlace& place) {
    if (!(place.light > 0)) return;
    const CompiledEmitter& flame = scene_.emitters[emitter];
    const EmissionPoint point{p.ray.origin + p.ray.direction * place.t, Vec3(0, 0, -1)};
    const double density =
        scene_.media.emission_density(static_cast<int>(flame.medium), point.position, resolver_);
    const double apparent_sr =
        next_event_.apparent_solid_angle(flame, point, -p.ray.direction, p.travelled + place.t);
    const double weight =
        next_event_.weight_of_hit(p.turn, emitter, point.position, apparent_sr, p.bands);
    p.into.add(flame.group, p.bands.band(i),
               p.weight * p.bands.light(i) * weight * power * place.light *
                   (density / place.density) / (4 * static_cast<double>(pi_f)));
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

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random random_;
  std::vector<double> band_cdf_, hero_;  // hero_: probabilities
  NextEvent<Resolver> next_event_;
  int brightest_band_ = 0;            // of the most lumens a watt
  std::vector<SurfaceModel> models_;  // of the path's bands, at the last surface
  BandValues passed_, drawn_, through_;
  GroupLight straight_;
  std::vector<FlameBox> flames_;
  KnownEnd end_;
};

}  // namespace luxodus
