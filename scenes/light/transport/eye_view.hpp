// The noise-free part of a picture's pixel: what its ray hits first, light that emitters send
// straight to the eye, features for the filter, and the transmittance of the media. The first
// segment of a path uses the same results. One thread or fiber at a time; suspends where the
// resolver does.
#pragma once

#include <span>
#include <vector>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/transport/connect.hpp"
#include "scenes/light/transport/emitters_met.hpp"
#include "scenes/light/transport/first_hit.hpp"
#include "scenes/light/transport/group_light.hpp"
#include "scenes/light/transport/media_bands.hpp"
#include "scenes/light/transport/path_bands.hpp"
#include "scenes/light/transport/textures.hpp"

namespace luxodus {

/// A ray from the eye with its hit.
struct EyeRay {
  Hit hit;
  BandValues passed;  // transmittance of the media up to the hit, by the path's bands
};

template <class Resolver>
class EyeView {
 public:
  /// Requires: all references outlive this.
  EyeView(const CompiledScene& scene, Resolver& resolver, const MediaBands& media,
          EmittersMet<Resolver>& emitters)
      : scene_(scene),
        resolver_(resolver),
        media_(media),
        emitters_(emitters),
        straight_(scene.groups.size(), static_cast<size_t>(scene.bands.count())) {
    for (int b = 0; b < scene.bands.count(); ++b)
      if (scene.bands[b].lm_per_w > scene.bands[brightest_band_].lm_per_w) brightest_band_ = b;
  }

  /// The hit is valid until the resolver's next one.
  EyeRay meet(const Ray& ray, const PathBands& bands) {
    EyeRay met;
    met.hit = resolver_.nearest(ray);
    media_.transmittances(ray, line_end(scene_, met.hit.distance), bands, met.passed, resolver_);
    return met;
  }

  /// Describes a ray that was passed to meet() just before. `bands`: all, at the start of the ray.
  /// `first` keeps its memory.
  void describe(const Ray& ray, const PathBands& bands, EyeRay& met, FirstHit& first) {
    straight_.clear();
    PathBands through = bands;  // light transmitted by panes and media
    Ray rest = ray;
    Hit hit = met.hit;
    Real before = 0;
    int panes = 0;
    bodies_.clear();
    for (; panes < limits::panes_per_line; ++panes) {
      EyePath path{rest, through, EmitterHits::all, 1, straight_};
      path.bodies = bodies_;
      emitters_.add_along(path, hit);
      if (!hit.found() || !pass_straight(rest, hit, through)) break;
      before += hit.distance;
      hit = resolver_.nearest(rest);
    }
    const std::span<const double> emitted = straight_.by_band();
    first.emitted.assign(emitted.begin(), emitted.end());
    describe_surface(hit, rest, before, first);
    first.transmittance =
        met.passed[static_cast<size_t>(brightest_band_)] * of_moment(ray, bands, met.hit);
    if (panes == 0) return;
    first.transmittance = medium_transmittance(scene_, ray, line_end(scene_, before + hit.distance),
                                               brightest_band_, resolver_);
    met.hit = resolver_.nearest(ray);
  }

 private:
  /// Factor of flames on light from the hit, in the band with the most lumens per watt.
  double of_moment(const Ray& ray, const PathBands& bands, const Hit& hit) {
    FlameMoment* const moment = emitters_.moment();
    if (moment == nullptr) return 1;
    moment->meet(ray, line_end(scene_, hit.distance), bands);
    return moment->on_light_from(static_cast<double>(hit.distance),
                                 static_cast<size_t>(brightest_band_));
  }

  /// Continues through a pane or an open surface on the same line; false if anything else ends it.
  bool pass_straight(Ray& ray, const Hit& hit, PathBands& through) {
    const TriangleRecord& t = *hit.triangle;
    const Real cosine = glm::dot(t.unit_normal(), ray.direction);
    const CompiledMaterial& material = material_at(scene_, hit, cosine < 0);
    if (material.kind != MaterialKind::glass_pane && material.kind != MaterialKind::open)
      return false;
    media_.transmittances(ray, line_end(scene_, hit.distance), through, passed_, resolver_);
    BodyMet met{scene_.surfaces[t.surface].body, true, {}};
    for (size_t b = 0; b < through.count(); ++b) {
      met.transmittance[b] = straight_transmittance(material.by_band[b], cosine);
      through.scale(b, passed_[b] * met.transmittance[b]);
    }
    if (met.body != 0) bodies_.push_back(met);
    ray.origin = offset_ray(t.at(hit.u, hit.v), cosine < 0 ? -t.unit_normal() : t.unit_normal(),
                            scene_.min_offset_m);
    return true;
  }

  void describe_surface(const Hit& hit, const Ray& ray, Real before, FirstHit& first) {
    first.reflectance.assign(static_cast<size_t>(scene_.bands.count()), 0.0);
    first.normal = Vec3(0);
    first.nearness = 0;
    if (!hit.found()) return;
    const Vec3 normal = hit.triangle->unit_normal();
    const bool front = glm::dot(normal, ray.direction) < 0;
    first.normal = front ? normal : -normal;
    first.nearness = 1 / static_cast<double>(before + hit.distance);
    const CompiledMaterial& material = material_at(scene_, hit, front);
    for (size_t b = 0; b < first.reflectance.size(); ++b)
      first.reflectance[b] = static_cast<double>(
          surface_at(scene_, hit, front, static_cast<int>(b), material, resolver_).reflectance);
  }

  const CompiledScene& scene_;
  Resolver& resolver_;
  const MediaBands& media_;
  EmittersMet<Resolver>& emitters_;
  int brightest_band_ = 0;  // band with the most lumens per watt
  GroupLight straight_;
  BandValues passed_;
  std::vector<BodyMet> bodies_;  // passed by the ray that is described
};

}  // namespace luxodus
