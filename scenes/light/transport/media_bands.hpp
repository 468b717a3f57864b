// Effect of media on all bands of a path at once. If the extinctions of all media have one ratio
// from band to band (grey smoke, or one kind of soot), the optical depths of all bands follow from
// one. Immutable once made for a scene; any thread. Suspends: where the resolver does.
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

  /// Whether free flights and collisions are equal in all bands.
  bool grey() const { return grey_; }
  /// Largest albedo of any medium in any band, as stated by the media; arrays of a data set may
  /// differ.
  double max_scattered() const { return max_scattered_; }

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

  /// Density of this flight in each band, relative to that in the hero band. Requires: `flight` was
  /// sampled for the hero along the ray.
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

  /// The albedo of a collision in each band.
  void albedos(const FreeFlight& flight, const PathBands& bands, BandValues& out) const;

 private:
  /// Evaluates a quantity proportional to extinction for all bands, from one band if possible.
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
  std::vector<double> ratio_;  // by band, common to all media; empty: there is none
  bool grey_ = false;          // all ratios are 1
  double max_scattered_ = 0;
};

}  // namespace luxodus
