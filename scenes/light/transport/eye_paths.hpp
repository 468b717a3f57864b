// Estimates for signs and probes by paths that start at the eye or the probe: the luminance of a
// sign, its surround and the veil before it, at the eye; at a probe, the light that arrives after
// at least one event. Each value is the mean of a batch, in total and for each source group, or for
// each mixture of groups. Eye paths have a particle range, batches and standard errors of their
// own. Thread rule: one EyeScores per thread or fiber.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/path_tracer.hpp"
#include "scenes/light/transport/value_scores.hpp"

namespace luxodus {

/// The texels of each part of a face (SignFace::parts), to aim at.
using FaceTexels = std::array<std::vector<uint32_t>, 2>;
FaceTexels list_texels(const SignFace& face);

template <class Resolver>
class EyeScores {
 public:
  EyeScores(const CompiledScene& scene, Resolver& resolver, uint64_t seed)
      : scene_(scene),
        resolver_(resolver),
        eye_(scene, resolver, seed, RandomStream::eye),
        random_(eye_.random()),
        set_(seed, RandomStream::eye),
        by_group_(scene.groups.size() > 1),
        light_(scene.groups.size()),
        reflected_(scene.groups.size()),
        path_(scene.groups.size()),
        at_eye_(scene.groups.size()),
        illuminance_(scene.groups.size()),
        fluence_(scene.groups.size()) {
    for (const CompiledSign& s : scene.signs)
      texels_.push_back(list_texels(scene.description->signs[s.sign].face));
  }

  /// Units: the parts of signs (legend, ground and surround of each target), then probes. Each has
  /// its own paths and bins, so that they may be traced in any order.
  uint32_t units() const {
    return static_cast<uint32_t>(3 * scene_.eye_targets.size() + scene_.description->probes.size());
  }

  /// Has score() call `rest` after every path.
  void rest_between_paths(std::function<void()> rest) { rest_ = std::move(rest); }

  /// Traces one batch's eye paths for one unit into its value bins. Requires: unit < units().
  void score(int64_t batch, uint32_t unit, BatchScores& scores) {
    const auto paths = static_cast<uint64_t>(scene_.eye_paths_per_batch);
    const uint64_t first = (static_cast<uint64_t>(batch) << 28) + unit * paths;
    const auto parts = static_cast<uint32_t>(3 * scene_.eye_targets.size());
    start_sums();
    const bool stratified = scene_.description->run.stratified;
    if (stratified) set_.choose(first, static_cast<uint32_t>(paths));
    for (uint64_t k = 0; k < paths; ++k) {
      if (stratified)
        random_.start(first + k, set_, static_cast<uint32_t>(k));
      else
        random_.start(first + k);
      if (unit < parts)
        look_at_sign(scene_.eye_targets[unit / 3], unit % 3);
      else
        look_around_probe(unit - parts);
      if (rest_) rest_();
    }
    if (unit < parts)
      store_sign(scene_.eye_targets[unit / 3].first_bin + unit % 3, scores);
    else
      store_probe(unit - parts, scores);
  }

 private:
  /// A band, and the lumens per watt that a path in it represents.
  struct PathBand {
    int band;
    double lm_per_w;
  };
  PathBand choose_band() {
    const int band = eye_.choose_band(random_.uniform_double());
    return {band, scene_.bands[band].lm_per_w / eye_.band_probability(band)};
  }

  /// A stretch of a line of sight that nothing solid interrupts.
  struct Line {
    Ray ray;
    Real length;
  };

  void start_sums() {
    paths_ = 0;
    own_ = transmission_ = visible_ = 0;
    for (GroupLight* l : {&reflected_, &path_, &at_eye_, &illuminance_, &fluence_}) l->clear();
  }

  /// Writes the means over the paths as consecutive values of a bin of `block`, from its first
  /// value on.
  void store(uint32_t block, uint32_t bin, std::initializer_list<double> sums,
             BatchScores& scores) const {
    int64_t* score = scores.scores.data() + scene_.layout.score_index(block, bin, 0, 0);
    uint32_t quantity = 0;
    for (const double sum : sums)
      *score++ =
          value_score(sum / static_cast<double>(paths_), quantum_of(scene_, block, quantity++));
  }

  // ---- a sign seen by an observer
  // ----------------------------------------------------------------

  void store_sign(uint32_t bin, BatchScores& scores) const {
    if (paths_ == 0) return;
    store(scene_.blocks.views, bin,
          {own_, reflected_.total(), at_eye_.total(), path_.total(), transmission_, visible_},
          scores);
    store_mixtures(bin, scores);
    if (scene_.blocks.views_by_group == none_index) return;
    const size_t groups = scene_.groups.size();
    for (size_t g = 0; g < groups; ++g) {
      store(scene_.blocks.views_by_group, static_cast<uint32_t>(bin * groups + g),
            {reflected_.of(g), at_eye_.of(g), path_.of(g)}, scores);
    }
  }

  void store_mixtures(uint32_t bin, BatchScores& scores) const {
    const size_t mixtures = scene_.mixtures.size();
    for (size_t m = 0; m < mixtures; ++m) {
      const std::vector<double>& factors = scene_.mixtures[m];
      store(scene_.blocks.views_by_mixture, static_cast<uint32_t>(bin * mixtures + m),
            {reflected_.sum(factors), at_eye_.sum(factors)}, scores);
    }
  }

  /// A point of the wanted part in face coordinates: u to the reader's right, v up, the face is [0,
  /// 1]^2.
  bool aim(const EyeTarget& target, uint32_t part, Vec2& uv) {
    const SignFace& face = scene_.description->signs[scene_.signs[target.sign].sign].face;
    if (part == 2) {  // a ring around the face, half the face's size wide on each side
      for (int attempt = 0; attempt < 64; ++attempt) {
        uv.x = 2 * random_.uniform() - 0.5_r;
        uv.y = 2 * random_.uniform() - 0.5_r;
        if (uv.x < 0 || uv.x >= 1 || uv.y < 0 || uv.y >= 1) return true;
      }
      return false;
    }
    const std::vector<uint32_t>& texels = texels_[target.sign][part];
    if (texels.empty()) return false;
    const uint64_t r = random_.bits();
    const uint32_t texel = texels[(r * texels.size()) >> 32];
    const Real x = static_cast<Real>(texel % static_cast<uint32_t>(face.width)) + random_.uniform();
    const Real y = static_cast<Real>(texel / static_cast<uint32_t>(face.width)) + random_.uniform();
    uv = {x / static_cast<Real>(face.width), 1 - y / static_cast<Real>(face.height)};
    return true;
  }

  Vec3 place_on_face(const CompiledSign& sign, const Vec2& uv) const {
    const Sign& d = scene_.description->signs[sign.sign];
    return sign.origin + sign.axes[0] * ((uv.x - 0.5_r) * static_cast<Real>(d.width_m)) +
           sign.axes[1] * ((uv.y - 0.5_r) * static_cast<Real>(d.height_m));
  }

  /// From the observer's eye to a point in the plane of the face.
  ShadowRay line_to_face(const EyeTarget& target, const Vec2& uv) const {
    const CompiledSign& sign = scene_.signs[target.sign];
    const Vec3 eye(scene_.description->observers[target.observer].eye - scene_.local_origin);
    return connect(scene_, eye, place_on_face(sign, uv), sign.axes[2], true);
  }

  void look_at_sign(const EyeTarget& target, uint32_t part) {
    Vec2 uv;
    if (!aim(target, part, uv)) return;
    ++paths_;
    const CompiledSign& sign = scene_.signs[target.sign];
    const ShadowRay c = line_to_face(target, uv);
    const PathBand chosen = choose_band();
    if (part == 2) return look_beside_face(target, uv, c, chosen);
    const double solid = solid_transmittance(scene_, c.ray, c.ray.length, chosen.band, resolver_);
    const OwnLight own = own_light(sign, uv, c, chosen.band);
    own_ += own.at_face;
    reflect_room_light(sign, part, place_on_face(sign, uv), c.ray.direction, chosen);
    reflected_.add_scaled(light_, 1);
    if (solid <= 0) return look_along(c, chosen);
    visible_ += 1;
    // For the sign's own light every band is computed, so it has no noise from the choice of band.
    transmission_ += solid * (own.at_face > 0 ? own.at_eye / own.at_face : own.through_scene);
    at_eye_.add(own.group, solid * own.at_eye);
    at_eye_.add_scaled(light_, solid * own.through);
    gather_veil({c.ray, c.distance}, chosen);
    path_.add_scaled(light_, 1);
    at_eye_.add_scaled(light_, 1);
  }

  /// The surround: `reflected` is the light that arrives at the eye from beyond the distance of the
  /// face, `path` the veil up to there, which is that of the face, too.
  void look_beside_face(const EyeTarget& target, const Vec2& uv, const ShadowRay& c,
                        const PathBand& chosen) {
    const Hit hit = resolver_.nearest(c.ray);
    if (hit.found() && hit.distance < c.ray.length)
      return look_at_obstacle(target, uv, c, hit.distance, chosen);
    visible_ += 1;
    look_beyond({c.ray, c.distance}, chosen);
  }

  /// An obstacle beside the face, nearer than the face, has less of its veil. The rest, along the
  /// line to the nearest point of the face, counts as light that does not arrive from beyond.
  void look_at_obstacle(const EyeTarget& target, const Vec2& uv, const ShadowRay& c, Real distance,
                        const PathBand& chosen) {
    const Real before = std::max(distance - static_cast<Real>(scene_.min_offset_m), Real(0));
    look_beyond({c.ray, before}, chosen);
    const ShadowRay face = line_to_face(target, glm::clamp(uv, Vec2(0), Vec2(1)));
    const Real start = std::min(before, face.distance);
    const Vec3 place = face.ray.origin + face.ray.direction * start;
    gather_veil({{place, face.ray.direction}, face.distance - start}, chosen);
    reflected_.add_scaled(light_,
                          -medium_transmittance(scene_, face.ray, start, chosen.band, resolver_));
  }

  /// Adds the light from beyond a line of sight, as it arrives at the eye, and the line's veil.
  void look_beyond(const Line& line, const PathBand& chosen) {
    const double passed =
        medium_transmittance(scene_, line.ray, line.length, chosen.band, resolver_);
    transmission_ += passed;
    // Emitters without a body do not end the line. What they send arrives, too.
    light_.clear();
    EyePath faces{line.ray, PathBands::one(chosen.band), EmitterHits::all, chosen.lm_per_w, light_};
    eye_.emitters().add_faces(faces, line.length);
    reflected_.add_scaled(light_, 1);
    at_eye_.add_scaled(light_, 1);
    light_.clear();
    const Vec3 end = line.ray.origin + line.ray.direction * line.length;
    eye_.radiance({end, line.ray.direction}, chosen.band, EmitterHits::all, chosen.lm_per_w,
                  light_);
    reflected_.add_scaled(light_, passed);
    at_eye_.add_scaled(light_, passed);
    gather_veil(line, chosen);
    path_.add_scaled(light_, 1);
    at_eye_.add_scaled(light_, 1);
  }

  /// Light that the eye receives along a line on which the sign is not visible.
  void look_along(const ShadowRay& c, const PathBand& chosen) {
    eye_.radiance({c.ray.origin, c.ray.direction}, chosen.band, EmitterHits::all, chosen.lm_per_w,
                  at_eye_);
  }

  /// The face's emitted luminance [cd/m2] before and after the medium, over all bands; and the
  /// transmittance in the chosen band, and averaged over the scene's light for faces that do not
  /// emit.
  struct OwnLight {
    int group = 0;
    double at_face = 0, at_eye = 0, through = 0, through_scene = 0;
  };
  OwnLight own_light(const CompiledSign& sign, const Vec2& uv, const ShadowRay& c,
                     int chosen_band) {
    OwnLight own;
    for (int b = 0; b < scene_.bands.count(); ++b) {
      const double t = medium_transmittance(scene_, c.ray, c.distance, b, resolver_);
      const SourceLight texel = eye_.emitters().texel_light(sign, uv, -c.ray.direction, b);
      const double luminance = scene_.bands[b].lm_per_w * texel.radiance;
      own.group = texel.group;
      own.at_face += luminance;
      own.at_eye += luminance * t;
      own.through_scene += eye_.band_probability(b) * t;
      if (b == chosen_band) own.through = t;
    }
    return own;
  }

  /// Adds room light that the face reflects to the eye, into light_.
  void reflect_room_light(const CompiledSign& sign, uint32_t part, const Vec3& place,
                          const Vec3& direction, const PathBand& chosen) {
    light_.clear();
    const std::vector<Real>& rho = sign.colours[sign.parts[part]].reflectance;
    const SurfaceModel model =
        make_surface(SurfaceKind::lambertian,
                     static_cast<double>(rho[static_cast<size_t>(chosen.band)]), 0, 1, 1, 1);
    const Vec3 normal = sign.axes[2];
    const Vec3 start = offset_ray(place, normal, scene_.min_offset_m);
    eye_.add_reflected_light(start, direction, normal, model, chosen.band, chosen.lm_per_w, light_);
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    const Ray onward{start, to_world(normal, cosine_hemisphere(u, v))};
    eye_.radiance_after_reflection(onward, normal, chosen.band,
                                   chosen.lm_per_w * static_cast<double>(model.reflectance),
                                   light_);
  }

  /// Gathers light scattered into the line of sight, or emitted there by flames, into light_, with
  /// one forced collision.
  void gather_veil(const Line& line, const PathBand& chosen) {
    light_.clear();
    if (scene_.features.media == MediaNeed::none) return;
    const int band = chosen.band;
    const Ray& ray = line.ray;
    if (!scene_.volume_points.empty())
      eye_.emitters().add_flames(ray, line.length, band, -1, chosen.lm_per_w, light_);
    const double depth = optical_depth<MediaNeed::general>(scene_.media, band, ray.origin,
                                                           ray.direction, line.length, resolver_);
    if (!(depth > 0)) return;
    const double collided = -std::expm1(-depth);
    const double tau = -std::log1p(-random_.uniform_double() * collided);
    const Real choice = random_.uniform();
    const FreeFlight flight = free_flight<MediaNeed::general>(
        scene_.media, band, ray.origin, ray.direction, line.length, tau, choice, resolver_);
    eye_.add_single_scattering(ray, line.length, flight, collided, band, chosen.lm_per_w, light_);
    if (!flight.collided || flight.albedo <= 0) return;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    const Vec3 direction = sample(phase, ray.direction, u, v);
    eye_.radiance_after_scattering(ray, line.length, flight, collided, direction, band,
                                   chosen.lm_per_w * collided * flight.albedo, light_);
  }

  // ---- probes
  // ------------------------------------------------------------------------------------

  void look_around_probe(uint32_t p) {
    const ProbeMeasure& probe = scene_.description->probes[p];
    const Vec3 normal(probe.normal);
    const Vec3 start =
        offset_ray(Vec3(probe.position - scene_.local_origin), normal, scene_.min_offset_m);
    ++paths_;
    const PathBand chosen = choose_band();
    const double pi = static_cast<double>(pi_f);
    const Real u = random_.uniform();
    const Real v = random_.uniform();
    eye_.radiance({start, to_world(normal, cosine_hemisphere(u, v))}, chosen.band,
                  EmitterHits::none, pi * chosen.lm_per_w, illuminance_);
    const Real s = random_.uniform();
    const Real t = random_.uniform();
    eye_.radiance({start, uniform_sphere(s, t)}, chosen.band, EmitterHits::none,
                  4 * pi * chosen.lm_per_w, fluence_);
  }

  void store_probe(uint32_t p, BatchScores& scores) const {
    store(scene_.blocks.probes, p, {illuminance_.total(), fluence_.total()}, scores);
    if (!by_group_) return;
    const size_t groups = scene_.groups.size();
    for (size_t g = 0; g < groups; ++g) {
      store(scene_.blocks.probes_by_group, static_cast<uint32_t>(p * groups + g),
            {illuminance_.of(g), fluence_.of(g)}, scores);
    }
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  PathTracer<Resolver> eye_;
  Random& random_;  // the tracer's own
  SobolSet set_;
  const bool by_group_;
  std::vector<FaceTexels> texels_;
  std::function<void()> rest_;

  // Sums over the paths of one bin and batch.
  int64_t paths_ = 0;
  double own_ = 0, transmission_ = 0, visible_ = 0;
  GroupLight light_;  // of one path
  GroupLight reflected_, path_, at_eye_, illuminance_, fluence_;
};

}  // namespace luxodus
