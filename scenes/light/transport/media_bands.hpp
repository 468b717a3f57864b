// What media do to the bands that a path carries, all at once. Where the extinctions of all media
// keep one ratio from band to band (grey smoke, or one kind of soot), depths of all bands follow
// from one. Made for a scene; then any thread. Suspends: where the resolver does.
#pragma once

#include <cmath>
#include <vector>

#include "scenes/light/intersect/ray.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/path_bands.hpp"

namespace luxodus {

class MediaBands {
 public:
  explicit MediaBands(const CompiledScene& scene);

  /// Whether all bands fly and collide alike.
  bool grey() const { return grey_; }
  /// Of what collisions take, what any medium scatters at most, in any band, by the albedo that it
  /// states: a data set may have others.
  double most_scattered() const { return most_scattered_; }

  /// Optical depth of each band along the ray.
  template <class Resolver>
  void depths(const Ray& ray, Real length, const PathBands& bands, BandValues& out,
              Resolver& resolver) const {
    if (bands.many() && ratio_.empty()) {
      return optical_depths(
          scene_.media, bands.count(), [&](size_t i) { return bands.band(i); }, ray.origin,
          ray.direction, length, resolver, out.data());
    }
    for_each_band(bands, out, [&](int band) {
      return optical_depth<MediaNeed::general>(scene_.media, band, ray.origin, ray.direction,
                                               length, resolver);
    });
  }

  /// exp(-depth) of each band along the ray.
  template <class Resolver>
  void transmittances(const Ray& ray, Real length, const PathBands& bands, BandValues& out,
                      Resolver& resolver) const {
    if (scene_.features.media == MediaNeed::none) {
      for (size_t i = 0; i < bands.count(); ++i) out[i] = 1;
      return;
    }
    depths(ray, length, bands, out, resolver);
    if (grey_) {
      const double share = std::exp(-out[0]);
      for (size_t i = 0; i < bands.count(); ++i) out[i] = share;
      return;
    }
    for (size_t i = 0; i < bands.count(); ++i) out[i] = std::exp(-out[i]);
  }

  /// Extinction of each band at a place [1/m].
  template <class Resolver>
  void extinctions(const Vec3& place, const PathBands& bands, BandValues& out,
                   Resolver& resolver) const {
    for_each_band(bands, out,
                  [&](int band) { return extinction_at(scene_.media, band, place, resolver); });
  }

  /// How densely each band would have flown like this, over how densely the hero did. Requires:
  /// `flight` is one of the hero along the ray.
  template <class Resolver>
  void flight_densities(const Ray& ray, const FreeFlight& flight, const PathBands& bands,
                        BandValues& out, Resolver& resolver) const {
    depths(ray, flight.t, bands, out, resolver);
    const double depth = out[bands.hero_place()];
    const MediaTables& tables = scene_.media.tables();
    const double sigma = flight.collided ? tables.sigma_of(bands.hero(), flight.component) : 1.0;
    for (size_t i = 0; i < bands.count(); ++i) {
      const double own = flight.collided ? tables.sigma_of(bands.band(i), flight.component) : 1.0;
      out[i] = own / sigma * std::exp(depth - out[i]);
    }
  }

  /// Of what a collision takes, the share that each band scatters.
  void albedos(const FreeFlight& flight, const PathBands& bands, BandValues& out) const;

 private:
  /// Of one path of many bands, what is in proportion to extinction.
  template <class OfBand>
  void for_each_band(const PathBands& bands, BandValues& out, OfBand&& of_band) const {
    if (!bands.many()) {
      out[0] = of_band(bands.band(0));
    } else if (ratio_.empty()) {
      for (size_t i = 0; i < bands.count(); ++i) out[i] = of_band(bands.band(i));
    } else {
      const double hero = of_band(bands.hero()) / ratio_[static_cast<size_t>(bands.hero())];
      for (size_t i = 0; i < bands.count(); ++i)
        out[i] = hero * ratio_[static_cast<size_t>(bands.band(i))];
    }
  }

  const CompiledScene& scene_;
  std::vector<double> ratio_;  // by band, of the extinctions of all media; empty: there is no one
  bool grey_ = false;          // all ratios are 1
  double most_scattered_ = 0;
};

}  // namespace luxodus
