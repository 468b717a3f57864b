// Mirror images of emitters: finds the flat mirrors and panes seen from a cell of space, and those
// emitters whose mirrored light is worth guiding paths to. A path that happens to scatter towards a
// pane and is mirrored to a lamp carries thousands of times its pixel's light, and next-event
// estimation cannot sample that connection; so glow_guide.hpp guides paths there. One thread or
// fiber at a time; suspends where the resolver does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/transport/connect.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/sight_places.hpp"
#include "scenes/light/transport/textures.hpp"

namespace luxodus {

namespace limits {
/// Rays from a cell that search for mirrors.
inline constexpr size_t mirror_lines = 128;
/// Mirror planes of a cell: those hit most often.
inline constexpr size_t mirror_planes = 8;
/// Mirrors within this distance of one plane are one [m].
inline constexpr Real same_plane_m = 1e-3_r;
/// Images that a cell keeps: those of the largest worth, each above this share of the light that
/// arrives without mirrors.
inline constexpr size_t emitter_images = 8;
inline constexpr double image_share = 1e-3;
}  // namespace limits

/// The mirror image of an emitter.
struct EmitterImage {
  Vec3 centre{0};
  Real radius = 0;
  /// Root mean square over a cell of the light that arrives by the mirror, per watt, without the
  /// inverse square [1/sr], times the emitter's power and divided by the root of the mirror's
  /// reflectance. Only that share of the paths guided there is reflected, so this weight is the
  /// best guiding probability.
  double worth = 0;
};

/// An emitter that mirrors may show.
struct MirroredEmitter {
  uint32_t emitter = 0;
  double power = 0;  // in all bands, weighted by luminance and colour
};

template <class Resolver>
class EmitterImages {
 public:
  /// For the light of one band. Requires: all references outlive this.
  EmitterImages(const CompiledScene& scene, int band, std::span<const SightPlace> places,
                Random& random, Resolver& resolver)
      : scene_(scene), band_(band), places_(places), random_(random), resolver_(resolver) {}

  /// The images that the mirrors show to the places. `straight`: light that arrives there without
  /// mirrors, as power over squared distance [1/sr]. Draws from `random`.
  std::vector<EmitterImage> find(std::span<const MirroredEmitter> emitters, double straight) {
    std::vector<EmitterImage> out;
    for (const Mirror& mirror : mirrors()) {
      for (const MirroredEmitter& e : emitters) {
        const EmitterBound bound = emitter_bound(scene_, e.emitter);
        const bool can_be_met = scene_.emitters[e.emitter].kind != EmitterKind::point;
        if (!can_be_met || !(mirror.above(bound.centre) > 0)) continue;
        const Vec3 centre = mirror.image(bound.centre);
        const Vec3 way = centre - places_.front().at;
        const double least =
            limits::image_share * straight * static_cast<double>(glm::dot(way, way)) / e.power;
        const std::vector<Line> lines = lines_to(e.emitter, mirror);
        if (!(worth_of(lines, [](const Line&) { return 1.0; }) > least)) continue;
        const double worth = worth_of(lines, [&](const Line& l) { return passed(l, mirror); });
        if (worth > least) out.push_back({centre, bound.radius, e.power * worth});
      }
    }
    std::stable_sort(out.begin(), out.end(), [](const EmitterImage& a, const EmitterImage& b) {
      return a.worth > b.worth;
    });
    out.resize(std::min(out.size(), limits::emitter_images));
    return out;
  }

 private:
  /// The plane of a mirror; its normal is on the visible side.
  struct Mirror {
    Vec3 normal{0};
    Real offset = 0;
    const CompiledMaterial* material = nullptr;
    int times_met = 1;

    Real above(const Vec3& place) const { return glm::dot(normal, place) - offset; }
    Vec3 image(const Vec3& place) const { return place - normal * (2 * above(place)); }
    bool in_plane_of(const Mirror& other) const {
      return glm::dot(normal, other.normal) > 0.9999_r &&
             std::abs(offset - other.offset) < limits::same_plane_m;
    }
  };

  /// A connection from a place to a point of an emitter by way of a mirror.
  struct Line {
    Ray ray;              // towards the image
    EmissionPoint point;  // of the emitter
    double worth = 0;     // unoccluded [1/sr]
    double weight = 1;    // of the place
  };

  /// Specular reflectance of a material, for the light that arrives there.
  double mirrored_share(const CompiledMaterial& material, Real cosine) const {
    const SurfaceModel& model = material.by_band[static_cast<size_t>(band_)];
    if (material.kind == MaterialKind::mirror) return static_cast<double>(model.specular);
    if (material.kind != MaterialKind::glass_pane) return 0;
    return static_cast<double>(pane_shares(model, cosine).reflected);
  }

  /// The mirrors that rays from the places hit first.
  std::vector<Mirror> mirrors() {
    std::vector<Mirror> out;
    for (size_t i = 0; i < limits::mirror_lines; ++i) {
      const SightPlace& place = places_[i % places_.size()];
      const Real u = random_.uniform();
      const Real v = random_.uniform();
      const Vec3 direction = uniform_sphere(u, v);
      const Ray ray{place.at, place.faces(direction) ? direction : -direction};
      const Hit hit = resolver_.nearest(ray);
      if (!hit.found()) continue;
      const Vec3 front = hit.triangle->unit_normal();
      const Real cosine = glm::dot(front, ray.direction);
      const CompiledMaterial& material = material_at(scene_, hit, cosine < 0);
      if (!(mirrored_share(material, cosine) > 0)) continue;
      const Vec3 normal = cosine < 0 ? front : -front;
      const Mirror met{normal, glm::dot(normal, hit.triangle->at(hit.u, hit.v)), &material};
      const auto known =
          std::find_if(out.begin(), out.end(), [&](const Mirror& m) { return m.in_plane_of(met); });
      if (known == out.end())
        out.push_back(met);
      else
        ++known->times_met;
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Mirror& a, const Mirror& b) { return a.times_met > b.times_met; });
    out.resize(std::min(out.size(), limits::mirror_planes));
    return out;
  }

  /// The connections along which the emitter sends light.
  std::vector<Line> lines_to(uint32_t emitter, const Mirror& mirror) {
    std::vector<Line> out;
    const CompiledEmitter& e = scene_.emitters[emitter];
    for (const SightPlace& place : places_) {
      const EmissionPoint point = emission_point(scene_, e, random_, resolver_);
      if (!(mirror.above(place.at) > 0 && mirror.above(point.position) > 0)) continue;
      const Vec3 towards = glm::normalize(mirror.image(point.position) - place.at);
      const Vec3 sent = glm::normalize(mirror.image(place.at) - point.position);
      const auto density = static_cast<double>(directional_density(e, point, sent, resolver_));
      const double share = mirrored_share(*mirror.material, glm::dot(mirror.normal, towards));
      if (density > 0 && place.faces(towards))
        out.push_back({{place.at, towards}, point, std::sqrt(share) * density, place.weight});
    }
    return out;
  }

  /// Root mean square over the places; `passed(line)` weights each line.
  template <class Passed>
  double worth_of(const std::vector<Line>& lines, Passed&& passed) const {
    double squares = 0;
    for (const Line& line : lines) {
      const double worth = line.worth * passed(line);
      squares += line.weight * worth * worth;
    }
    return root_mean(squares, places_);
  }

  /// Transmittance of smoke and solids along a connection; 0 if the mirror is not hit first.
  double passed(const Line& line, const Mirror& mirror) {
    const Hit hit = resolver_.nearest(line.ray);
    if (!hit.found()) return 0;
    const Real distance = hit.distance;
    const Vec3 met = hit.triangle->at(hit.u, hit.v);
    const bool front = glm::dot(hit.triangle->unit_normal(), line.ray.direction) < 0;
    if (&material_at(scene_, hit, front) != mirror.material ||
        std::abs(mirror.above(met)) > limits::same_plane_m)
      return 0;
    const ShadowRay onward = connect(scene_, offset_ray(met, mirror.normal, scene_.min_offset_m),
                                     line.point.position, line.point.axis, true);
    OwnBody none;
    if (!passes_solids(scene_, onward.ray, onward.ray.length, resolver_, none,
                       [](const CompiledMaterial&, Real) {}))
      return 0;
    return medium_transmittance(scene_, line.ray, distance, band_, resolver_) *
           medium_transmittance(scene_, onward.ray, onward.distance, band_, resolver_);
  }

  const CompiledScene& scene_;
  const int band_;
  const std::span<const SightPlace> places_;
  Random& random_;
  Resolver& resolver_;
};

}  // namespace luxodus
