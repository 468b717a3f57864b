// Light traced from where it is seen: what an eye receives from a sign, its surround and the veil
// between, what reaches a point probe after at least one event, and the radiance of a picture's
// rays. Paths run backwards (all laws are reciprocal); at every event one emitter is asked
// directly, so that a path needs no luck to meet it. Close to an emitter asking has no bounded
// variance (1/r2), so light from points nearer than its half size is counted only where a path
// meets it, and from farther ones only where it is asked: each pair of places once. Unbiased,
// except where pictures end a path in the patches' flux (final gather). Paths have a particle
// range, batches and standard errors of their own.
// Not seen: point emitters and caustics through mirrors and refracting solids; the forward tracer
// counts those. Thread rule: one EyeTracer per thread or fiber.
#pragma once

#include <cmath>

#include "runtime/core/random.hpp"
#include "scenes/tally/totals.hpp"
#include "scenes/transport/connect.hpp"
#include "scenes/transport/emission.hpp"
#include "scenes/transport/textures.hpp"

namespace luxodus {

namespace limits {
inline constexpr int eye_events = 10'000;
inline constexpr int emitters_per_line = 16;  // emitting faces that one straight line may cross
inline constexpr int nearby_emitters = 256;   // up to here distance decides who is asked
/// Of a value score [its unit]: 2^-40, so int64 holds up to 8 million cd/m2 per batch mean.
inline constexpr double value_quantum = 0x1p-40;
}  // namespace limits

int64_t value_score(double mean);

/// Outgoing radiance of a patch, for final gathers: [W/(m2 sr)]. Implemented where flux is
/// collected.
class PatchRadiance {
 public:
  virtual ~PatchRadiance() = default;
  virtual double radiance(const Hit& hit, bool front, int band) const = 0;
};

/// Texels of each colour of a face, to aim at.
struct FaceTexels {
  std::vector<uint32_t> white, green;
};

/// Which emitters count when a path meets them on its way.
enum class Met {
  none,  // somebody else holds all direct light of this place
  near,  // those closer than their half size; the others were asked
  all,   // nothing was asked
};

template <class Resolver>
class EyeTracer {
 public:
  EyeTracer(const CompiledScene& scene, Resolver& resolver, uint64_t seed, RandomStream stream)
      : scene_(scene), resolver_(resolver), random_(seed, stream) {
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
    for (const CompiledSign& s : scene.signs) texels_.push_back(list_texels(s));
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

  /// Eye paths of one batch: all targets and probes, into their value bins.
  void score_batch(int64_t batch, BatchScores& scores) {
    const auto paths = static_cast<uint64_t>(scene_.eye_paths_per_batch);
    uint64_t next = static_cast<uint64_t>(batch) << 28;
    for (const EyeTarget& target : scene_.eye_targets) {
      for (uint32_t part = 0; part < 3; ++part) {
        SignSums sums;
        for (uint64_t i = 0; i < paths; ++i) {
          random_.start(next++);
          look_at_sign(target, part, sums);
        }
        store(sums, target.first_bin + part, scores);
      }
    }
    score_probes(next, paths, scores);
  }

  /// Radiance [W/(m2 sr)] in `band` that arrives against `ray.direction`, from one path. `met`:
  /// which emitters count before the first event. `gather`: where paths may end after their first
  /// diffuse event; null traces them to their end.
  double radiance(Ray ray, int band, Met met, const PatchRadiance* gather = nullptr) {
    Path path{ray, band, met};
    for (int event = 0; event < limits::eye_events; ++event) {
      const Hit hit = resolver_.nearest(path.ray);
      if (path.met != Met::none) path.sum += path.throughput * emitted_along(path, hit);
      const Flight flight = fly(path.ray, hit.distance, band);
      if (flight.collided) {
        if (!scatter(path, flight)) return path.sum;
      } else {
        if (!hit.found()) return path.sum;
        if (gather != nullptr && path.diffused && reflects_diffusely(hit, path.ray)) {
          const bool front = glm::dot(hit.triangle->normal, path.ray.direction) < 0;
          return path.sum + path.throughput * gather->radiance(hit, front, band);
        }
        if (!bounce(path, hit)) return path.sum;
      }
      if (event >= 2 && !survives(path.throughput)) return path.sum;
    }
    return path.sum;
  }

 private:
  struct SignSums {
    double value[eye_quantities] = {};
    int64_t paths = 0;
  };

  struct Path {
    Ray ray;
    int band;
    Met met;
    double sum = 0;
    double throughput = 1;
    float travelled = 0;    // from the last event to the ray's origin, through panes
    bool diffused = false;  // a surface has spread it
  };

  // ---- events
  // ------------------------------------------------------------------------------------

  Flight fly(const Ray& ray, float length, int band) {
    if (scene_.features.media == MediaNeed::none) return {};
    const uint32_t r = random_.bits();
    const double tau = -std::log((4294967296.0 - static_cast<double>(r)) * 0x1p-32);
    const float choice = random_.uniform();
    return free_flight<MediaNeed::general>(scene_.media, band, ray.origin, ray.direction, length,
                                           tau, choice, resolver_);
  }

  const CompiledMaterial& material_at(const Hit& hit, bool front) const {
    return scene_.materials[scene_.surfaces[hit.triangle->surface].material[front ? 0 : 1]];
  }

  bool reflects_diffusely(const Hit& hit, const Ray& ray) const {
    const bool front = glm::dot(hit.triangle->normal, ray.direction) < 0;
    const MaterialKind kind = material_at(hit, front).kind;
    return kind == MaterialKind::lambertian || kind == MaterialKind::glossy;
  }

  /// Medium event: light asked from an emitter, then a new direction. False ends the path.
  bool scatter(Path& p, const Flight& flight) {
    p.throughput *= flight.albedo;
    if (p.throughput <= 0) return false;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    p.ray.origin += p.ray.direction * flight.t;
    p.sum += p.throughput * scattered_light(p.ray.origin, p.ray.direction, phase, p.band);
    const float u = random_.uniform();
    const float v = random_.uniform();
    p.ray.direction = sample(phase, p.ray.direction, u, v);
    p.met = Met::near;
    p.travelled = 0;
    return true;
  }

  /// Surface event: light asked from an emitter, then a new direction. False ends the path.
  bool bounce(Path& p, const Hit& hit) {
    const TriangleRecord& t = *hit.triangle;
    const bool front = glm::dot(t.normal, p.ray.direction) < 0;
    const SurfaceModel model =
        surface_at(scene_, hit, front, p.band, material_at(hit, front), resolver_);
    const glm::vec3 normal = front ? t.normal : -t.normal;
    const glm::vec3 place = t.at(hit.u, hit.v);
    if (model.kind == SurfaceKind::lambertian || model.kind == SurfaceKind::glossy) {
      p.sum += p.throughput *
               reflected_light(offset_ray(place, normal), p.ray.direction, normal, model, p.band);
    }
    const float lobe = random_.uniform();
    const float u = random_.uniform();
    const float v = random_.uniform();
    const SurfaceSample s = sample_surface(model, p.ray.direction, normal, front, lobe, u, v);
    p.throughput *= static_cast<double>(s.weight);
    if (p.throughput <= 0) return false;
    // Straight through a pane nothing has happened that asking does not know of.
    const bool straight = s.specular && s.transmitted && model.kind != SurfaceKind::dielectric;
    if (straight) {
      p.travelled += hit.distance;
    } else {
      p.met = s.specular ? Met::all : Met::near;
      p.travelled = 0;
    }
    if (!s.specular) p.diffused = true;
    p.ray.direction = s.direction;
    p.ray.origin = offset_ray(place, s.transmitted ? -normal : normal);
    return true;
  }

  bool survives(double& throughput) {
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
  double emitted_along(const Path& p, const Hit& hit) {
    const float slack = 1 + 1e-5f;  // a body's own face lies as far as the emitter on it
    float reach = hit.distance * slack;
    double sum = 0;
    Ray rest = p.ray;
    float before = 0;
    for (int k = 0; k < limits::emitters_per_line; ++k) {
      const EmitterHit e = nearest_emitter(scene_, rest, reach);
      if (e.emitter == none_index) break;
      const CompiledEmitter& emitter = scene_.emitters[e.emitter];
      const float distance = before + e.distance;
      if (counts(p, distance, emitter.near_m)) {
        sum += emitted_radiance(emitter, e.point, -p.ray.direction, p.band, resolver_) *
               medium_transmittance(scene_, p.ray, distance, p.band, resolver_);
      }
      const float step = std::nextafter(e.distance * slack, std::numeric_limits<float>::infinity());
      rest.origin += rest.direction * step;
      before += step;
      reach -= step;
      if (!(reach > 0)) break;
    }
    return sum + emitted_by_sign(p, hit) + flames_met(p, hit.distance);
  }

  static bool counts(const Path& p, float distance, float near) {
    return p.met == Met::all || p.travelled + distance < near;
  }

  double emitted_by_sign(const Path& p, const Hit& hit) {
    if (!hit.found()) return 0;
    const uint32_t index = scene_.surfaces[hit.triangle->surface].sign;
    if (index == none_index || glm::dot(hit.triangle->normal, p.ray.direction) >= 0) return 0;
    const CompiledSign& sign = scene_.signs[index];
    if (!counts(p, hit.distance, sign.near_m)) return 0;
    const Sign& d = scene_.description->signs[sign.sign];
    const double own =
        texel_radiance(sign, d, texture_uv(*hit.cell, hit), -p.ray.direction, p.band);
    return own > 0 ? own * medium_transmittance(scene_, p.ray, hit.distance, p.band, resolver_) : 0;
  }

  /// Flames that count: all along the line, or the part of each that is near.
  double flames_met(const Path& p, float length) {
    if (scene_.volume_points.empty()) return 0;
    if (p.met == Met::all) return flames_along(p.ray, length, p.band, -1);
    double sum = 0;
    for (const CompiledEmitter& e : scene_.emitters) {
      if (e.kind != EmitterKind::volume) continue;
      const float rest = e.near_m - p.travelled;
      if (rest > 0)
        sum += flames_along(p.ray, std::min(length, rest), p.band, static_cast<int>(e.medium));
    }
    return sum;
  }

  /// Emission of flames along the ray, of one medium or of all (-1).
  double flames_along(const Ray& ray, float length, int band, int medium) {
    double sum = 0;
    double depth = 0;
    for_each_segment(
        scene_.media, band, ray.origin, ray.direction, std::min(length, 4 * scene_.diagonal_m),
        resolver_, [&](const MediaSegment& s) {
          const double tau = s.sigma_t * s.length;
          const double through = s.sigma_t > 0 ? -std::expm1(-tau) / s.sigma_t : s.length;
          for (const EmissionPart& part : s.emission) {
            if (medium >= 0 && part.medium != medium) continue;
            sum += flame_power(part.medium, band) * part.density * std::exp(-depth) * through;
          }
          depth += tau;
          return depth < 50;
        });
    return sum / (4 * static_cast<double>(pi_f));
  }

  /// Watts of a medium's glow in a band; 0 where the scenario has put it out.
  double flame_power(int medium, int band) const {
    for (const CompiledEmitter& e : scene_.emitters) {
      if (e.kind == EmitterKind::volume && e.medium == static_cast<uint32_t>(medium))
        return e.power_w[static_cast<size_t>(band)];
    }
    return 0;
  }

  double texel_radiance(const CompiledSign& sign, const Sign& d, const glm::vec2& uv,
                        const glm::vec3& to_eye, int band) const {
    const SignColour colour = d.face.colour[texel_at(d.face, uv)];
    if (colour == SignColour::other) return 0;
    const auto& radiance = colour == SignColour::white ? sign.white_radiance : sign.green_radiance;
    const double cosine = std::max(0.0, static_cast<double>(glm::dot(sign.axes[2], to_eye)));
    const double angular = d.angular_exponent == 0 ? 1 : std::pow(cosine, d.angular_exponent);
    return radiance[static_cast<size_t>(band)] * angular * face_relative(d.face, uv);
  }

  static double face_relative(const SignFace& face, const glm::vec2& uv) {
    if (face.relative_luminance.empty()) return 1;
    return static_cast<double>(face.relative_luminance[texel_at(face, uv)]);
  }

  // ---- asking an emitter
  // -------------------------------------------------------------------------

  struct Asked {
    const CompiledEmitter* emitter = nullptr;
    double probability = 0;
  };

  /// An emitter, in proportion to power over squared distance where they are few.
  Asked ask(const glm::vec3& place, int band) {
    const auto b = static_cast<size_t>(band);
    const size_t n = scene_.emitters.size();
    weights_.resize(n);
    double total = 0;
    for (size_t i = 0; i < n; ++i) {
      const CompiledEmitter& e = scene_.emitters[i];
      double w = e.distribution == Distribution::collimated ? 0 : e.power_w[b];
      if (n <= limits::nearby_emitters) {
        const glm::vec3 d = (e.kind == EmitterKind::mesh ? e.corners[0] : e.origin) - place;
        const glm::vec3 size = e.size;
        w /= static_cast<double>(glm::dot(d, d) + 0.25f * glm::dot(size, size)) + 1e-6;
      }
      total += w;
      weights_[i] = total;
    }
    if (!(total > 0)) return {};
    const double u = random_.uniform_double() * total;
    const auto at = static_cast<size_t>(std::upper_bound(weights_.begin(), weights_.end(), u) -
                                        weights_.begin());
    const size_t chosen = std::min(at, n - 1);
    const double share = (weights_[chosen] - (chosen > 0 ? weights_[chosen - 1] : 0)) / total;
    if (!(share > 0)) return {};
    return {&scene_.emitters[chosen], share};
  }

  /// Irradiance normal to the line from one point of one emitter, divided by the probability of
  /// asking it.
  struct Arriving {
    glm::vec3 direction{0};  // towards the emitter
    double irradiance = 0;
  };

  Arriving arriving_light(const glm::vec3& place, int band) {
    const Asked asked = ask(place, band);
    if (asked.emitter == nullptr) return {};
    const CompiledEmitter& e = *asked.emitter;
    const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
    const Connection c = connect(place, point.position, point.axis, e.kind != EmitterKind::volume);
    if (!(c.distance > e.near_m)) return {};  // counted where paths meet it
    const auto density =
        static_cast<double>(directional_density(e, point, -c.ray.direction, resolver_));
    if (density <= 0) return {};
    const double solid = solid_transmittance(scene_, c.ray, c.ray.length, band, resolver_);
    if (solid <= 0) return {};
    const double medium = medium_transmittance(scene_, c.ray, c.distance, band, resolver_);
    const auto d = static_cast<double>(c.distance);
    return {c.ray.direction, e.power_w[static_cast<size_t>(band)] * density * solid * medium /
                                 (d * d * asked.probability)};
  }

  double scattered_light(const glm::vec3& place, const glm::vec3& direction,
                         const PhaseFunction& phase, int band) {
    const Arriving a = arriving_light(place, band);
    if (a.irradiance <= 0) return 0;
    return a.irradiance * static_cast<double>(evaluate(phase, glm::dot(a.direction, direction)));
  }

  double reflected_light(const glm::vec3& place, const glm::vec3& direction,
                         const glm::vec3& normal, const SurfaceModel& model, int band) {
    const Arriving a = arriving_light(place, band);
    const float cosine = glm::dot(a.direction, normal);
    if (a.irradiance <= 0 || cosine <= 0) return 0;
    return a.irradiance * static_cast<double>(cosine) *
           static_cast<double>(evaluate_surface(model, -direction, a.direction, normal));
  }

  // ---- a sign seen by an observer
  // ----------------------------------------------------------------

  FaceTexels list_texels(const CompiledSign& s) const {
    FaceTexels out;
    const SignFace& face = scene_.description->signs[s.sign].face;
    for (uint32_t i = 0; i < face.colour.size(); ++i) {
      if (face.colour[i] == SignColour::white) out.white.push_back(i);
      if (face.colour[i] == SignColour::green) out.green.push_back(i);
    }
    return out;
  }

  /// A point of the wanted part in face coordinates, u to the reader's right, v up, the face is [0,
  /// 1]^2.
  bool aim(const EyeTarget& target, uint32_t part, glm::vec2& uv) {
    const SignFace& face = scene_.description->signs[scene_.signs[target.sign].sign].face;
    if (part == 2) {  // the ring as wide as half the face on each side
      for (int attempt = 0; attempt < 64; ++attempt) {
        uv.x = 2 * random_.uniform() - 0.5f;
        uv.y = 2 * random_.uniform() - 0.5f;
        if (uv.x < 0 || uv.x >= 1 || uv.y < 0 || uv.y >= 1) return true;
      }
      return false;
    }
    const std::vector<uint32_t>& texels =
        part == 0 ? texels_[target.sign].white : texels_[target.sign].green;
    if (texels.empty()) return false;
    const uint64_t r = random_.bits();
    const uint32_t texel = texels[(r * texels.size()) >> 32];
    const float x =
        static_cast<float>(texel % static_cast<uint32_t>(face.width)) + random_.uniform();
    const float y =
        static_cast<float>(texel / static_cast<uint32_t>(face.width)) + random_.uniform();
    uv = {x / static_cast<float>(face.width), 1 - y / static_cast<float>(face.height)};
    return true;
  }

  void look_at_sign(const EyeTarget& target, uint32_t part, SignSums& sums) {
    glm::vec2 uv;
    if (!aim(target, part, uv)) return;
    ++sums.paths;
    const CompiledSign& sign = scene_.signs[target.sign];
    const Sign& d = scene_.description->signs[sign.sign];
    const glm::vec3 eye(scene_.description->observers[target.observer].eye - scene_.local_origin);
    const glm::vec3 aimed = sign.origin +
                            sign.axes[0] * ((uv.x - 0.5f) * static_cast<float>(d.width_m)) +
                            sign.axes[1] * ((uv.y - 0.5f) * static_cast<float>(d.height_m));
    const Connection c = connect(eye, aimed, sign.axes[2], true);
    const double chance = random_.uniform_double();
    const int band = choose_band(chance);
    const double lm = scene_.bands[band].lm_per_w / band_probability(band);
    double* value = sums.value;
    const auto add = [&](EyeQuantity q, double v) { value[static_cast<size_t>(q)] += v; };
    if (part == 2) {
      add(EyeQuantity::at_eye, lm * radiance({eye, c.ray.direction}, band, Met::all));
      return;
    }
    const double solid = solid_transmittance(scene_, c.ray, c.ray.length, band, resolver_);
    double through = 0;
    double own = 0;
    double own_at_eye = 0;
    double through_scene = 0;  // weighted by the scene's light, for faces without their own
    for (int b = 0; b < scene_.bands.count(); ++b) {
      const double t = medium_transmittance(scene_, c.ray, c.distance, b, resolver_);
      const double l = scene_.bands[b].lm_per_w * texel_radiance(sign, d, uv, -c.ray.direction, b);
      own += l;
      own_at_eye += l * t;
      through_scene += band_probability(b) * t;
      if (b == band) through = t;
    }
    add(EyeQuantity::own, own);
    const double reflected = lm * face_reflection(sign, part, aimed, c.ray.direction, band);
    add(EyeQuantity::reflected, reflected);
    if (solid <= 0) {
      add(EyeQuantity::at_eye, lm * radiance({eye, c.ray.direction}, band, Met::all));
      return;
    }
    add(EyeQuantity::visible, 1);
    // Of the sign's own light: every band is known here, so none is left to chance.
    add(EyeQuantity::transmission, solid * (own > 0 ? own_at_eye / own : through_scene));
    const double path = lm * path_radiance(c, band);
    add(EyeQuantity::path, path);
    add(EyeQuantity::at_eye, solid * (own_at_eye + reflected * through) + path);
  }

  /// Room light that the face sends back to the eye.
  double face_reflection(const CompiledSign& sign, uint32_t part, const glm::vec3& place,
                         const glm::vec3& direction, int band) {
    const auto& rho = part == 0 ? sign.white_reflectance : sign.green_reflectance;
    SurfaceModel model = make_surface(
        SurfaceKind::lambertian, static_cast<double>(rho[static_cast<size_t>(band)]), 0, 1, 1, 1);
    const glm::vec3 normal = sign.axes[2];
    const glm::vec3 start = offset_ray(place, normal);
    double sum = reflected_light(start, direction, normal, model, band);
    const float u = random_.uniform();
    const float v = random_.uniform();
    const Ray onward{start, to_world(normal, cosine_hemisphere(u, v))};
    sum += static_cast<double>(model.reflectance) * radiance(onward, band, Met::near);
    return sum;
  }

  /// Light scattered, or emitted by flames, into the line of sight: one collision is forced on it.
  double path_radiance(const Connection& c, int band) {
    if (scene_.features.media == MediaNeed::none) return 0;
    double sum = scene_.volume_points.empty() ? 0 : flames_along(c.ray, c.ray.length, band, -1);
    const double depth = optical_depth<MediaNeed::general>(scene_.media, band, c.ray.origin,
                                                           c.ray.direction, c.distance, resolver_);
    if (!(depth > 0)) return sum;
    const double collided = -std::expm1(-depth);
    const double tau = -std::log1p(-random_.uniform_double() * collided);
    const float choice = random_.uniform();
    const Flight flight = free_flight<MediaNeed::general>(
        scene_.media, band, c.ray.origin, c.ray.direction, c.distance, tau, choice, resolver_);
    if (!flight.collided || flight.albedo <= 0) return sum;
    const PhaseFunction& phase = scene_.phases[static_cast<size_t>(flight.phase)];
    const glm::vec3 place = c.ray.origin + c.ray.direction * flight.t;
    double inner = scattered_light(place, c.ray.direction, phase, band);
    const float u = random_.uniform();
    const float v = random_.uniform();
    inner += radiance({place, sample(phase, c.ray.direction, u, v)}, band, Met::near);
    return sum + collided * flight.albedo * inner;
  }

  void store(const SignSums& sums, uint32_t bin, BatchScores& scores) {
    if (sums.paths == 0) return;
    for (uint32_t q = 0; q < eye_quantities; ++q) {
      const auto at = scene_.layout.score_index(scene_.blocks.views, bin, 0, q);
      scores.scores[static_cast<size_t>(at)] =
          value_score(sums.value[q] / static_cast<double>(sums.paths));
    }
  }

  // ---- probes
  // ------------------------------------------------------------------------------------

  void score_probes(uint64_t next, uint64_t paths, BatchScores& scores) {
    const auto& probes = scene_.description->probes;
    for (uint32_t p = 0; p < probes.size(); ++p) {
      const glm::vec3 normal(probes[p].normal);
      const glm::vec3 start =
          offset_ray(glm::vec3(probes[p].position - scene_.local_origin), normal);
      double illuminance = 0, fluence = 0;
      for (uint64_t i = 0; i < paths; ++i) {
        random_.start(next++);
        const int band = choose_band(random_.uniform_double());
        const double lm = scene_.bands[band].lm_per_w / band_probability(band);
        const float u = random_.uniform();
        const float v = random_.uniform();
        illuminance +=
            lm * radiance({start, to_world(normal, cosine_hemisphere(u, v))}, band, Met::none);
        const float s = random_.uniform();
        const float t = random_.uniform();
        fluence += lm * radiance({start, uniform_sphere(s, t)}, band, Met::none);
      }
      const double n = static_cast<double>(paths);
      const double pi = static_cast<double>(pi_f);
      const auto at = static_cast<size_t>(scene_.layout.score_index(scene_.blocks.probes, p, 0, 0));
      scores.scores[at] = value_score(pi * illuminance / n);
      scores.scores[at + 1] = value_score(4 * pi * fluence / n);
    }
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  Random random_;
  std::vector<double> band_cdf_;
  std::vector<FaceTexels> texels_;
  std::vector<double> weights_;
};

}  // namespace luxodus
