// Emitters as flat mirrors show them: panes and mirrors that a cell of space sees, and of the
// emitters that they mirror those whose light is worth turning to. A path that turns to a pane by
// chance and is mirrored to a lamp brings thousands of times its pixel's light, and next-event
// estimation does not know that way; so turns are aimed there (glow_guide.hpp). Suspends: where the
// resolver does.
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
/// Lines from a cell on which mirrors are looked for.
inline constexpr size_t mirror_lines = 128;
/// Planes of mirrors of a cell: those most often met.
inline constexpr size_t mirror_planes = 8;
/// Mirrors as near to one plane are one [m].
inline constexpr Real same_plane_m = 1e-3_r;
/// Emitters in mirrors that a cell knows: those of the most worth, and of more than a share of the
/// light that arrives straight.
inline constexpr size_t emitter_images = 8;
inline constexpr double image_share = 1e-3;
}  // namespace limits

/// An emitter where a mirror shows it.
struct EmitterImage {
  Vec3 centre{0};
  Real radius = 0;
  /// Of the emitter's power, root mean square over a cell of what arrives there by the mirror,
  /// without the inverse square [1/sr], over the root of what the mirror sends on: as only so many
  /// of the paths that turn there are mirrored, that is how often they should.
  double worth = 0;
};

/// An emitter that may be mirrored.
struct MirroredEmitter {
  uint32_t emitter = 0;
  double power = 0;  // in all bands, by how they look
};

template <class Resolver>
class EmitterImages {
 public:
  /// In the light of a band. Requires: all that is referred to outlives this.
  EmitterImages(const CompiledScene& scene, int band, std::span<const SightPlace> places,
                Random& random, Resolver& resolver)
      : scene_(scene), band_(band), places_(places), random_(random), resolver_(resolver) {}

  /// What mirrors show of the emitters to the places. `straight`: light that arrives there without
  /// mirrors, as power over squared distance [1/sr]. Draws `random`.
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
  /// The plane of a mirror; its normal is on the side that is seen.
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

  /// From a place to a point of an emitter by way of a mirror.
  struct Line {
    Ray ray;              // towards the image
    EmissionPoint point;  // of the emitter
    double worth = 0;     // where nothing is in the way [1/sr]
    double weight = 1;    // of the place
  };

  /// What a material sends on as a mirror does, of the light that arrives there.
  double mirrored_share(const CompiledMaterial& material, Real cosine) const {
    const SurfaceModel& model = material.by_band[static_cast<size_t>(band_)];
    if (material.kind == MaterialKind::mirror) return static_cast<double>(model.specular);
    if (material.kind != MaterialKind::glass_pane) return 0;
    return static_cast<double>(pane_shares(model, cosine).reflected);
  }

  /// Those that are met first on lines from the places.
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

  /// Those that the emitter sends light along.
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

  /// Root mean square over the places; each line counts by what `passed(line)` says.
  template <class Passed>
  double worth_of(const std::vector<Line>& lines, Passed&& passed) const {
    double squares = 0;
    for (const Line& line : lines) {
      const double worth = line.worth * passed(line);
      squares += line.weight * worth * worth;
    }
    return root_mean(squares, places_);
  }

  /// What smoke and solids let pass; 0 where the line does not meet the mirror first.
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
    if (!passes_solids(scene_, onward.ray, onward.ray.length, resolver_,
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
