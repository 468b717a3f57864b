// The bands that an eye path carries, with the light of each. A path of a picture carries all of
// them: one, the hero, decides how it is sampled, and every band is weighted by the balance
// heuristic over what each would have sampled as hero (A. Wilkie et al., "Hero wavelength spectral
// sampling", EGSR 2014). So the light of every band does not depend on which was the hero, and
// colours have no noise where surfaces and media treat all bands alike. A path of one band is the
// special case of one. Plain values; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "scenes/light/optics/media_tables.hpp"

namespace luxodus {

/// A value for each band that a path carries, by position.
using BandValues = std::array<double, limits::max_media_bands>;

class PathBands {
 public:
  static PathBands one(int band) {
    PathBands out(1, band);
    out.hero_ = band;
    out.light_[0] = out.share_[0] = 1;
    return out;
  }
  /// All bands of a scene. `probability`: of each band to be the hero.
  static PathBands all(std::span<const double> probability, int hero) {
    PathBands out(static_cast<int>(probability.size()), 0);
    out.hero_ = hero;
    for (size_t i = 0; i < probability.size(); ++i) {
      out.light_[i] = 1;
      out.share_[i] = probability[i];
    }
    return out;
  }

  PathBands(const PathBands& other) { *this = other; }
  PathBands& operator=(const PathBands& other) {
    count_ = other.count_;
    first_ = other.first_;
    hero_ = other.hero_;
    std::copy_n(other.light_.begin(), count_, light_.begin());
    std::copy_n(other.share_.begin(), count_, share_.begin());
    return *this;
  }

  bool many() const { return count_ > 1; }
  size_t count() const { return count_; }
  int hero() const { return hero_; }
  size_t hero_place() const { return static_cast<size_t>(hero_ - first_); }
  int band(size_t i) const { return first_ + static_cast<int>(i); }

  /// Contribution of a band: its light divided by the density of such paths.
  double light(size_t i) const { return light_[i]; }
  double brightest() const { return *std::max_element(light_.begin(), light_.begin() + count_); }
  /// Share of the density of this path that is due to the band as hero.
  double share(size_t i) const { return share_[i]; }
  /// Density of the hero mixture, from the density of each band.
  template <class DensityOf>
  double mixed(DensityOf&& density) const {
    double sum = 0;
    for (size_t i = 0; i < count_; ++i) sum += share_[i] * density(i);
    return sum;
  }

  /// Updates after an event with density `density` in each band and `mixed_density` in the mixture.
  /// `passed`: light that continues, divided by mixed_density. Requires: mixed_density > 0.
  void go_on(const BandValues& passed, const BandValues& density, double mixed_density) {
    for (size_t i = 0; i < count_; ++i) {
      light_[i] *= passed[i];
      share_[i] *= density[i] / mixed_density;
    }
  }
  /// Updates after an event with equal density in all bands.
  void scale(size_t i, double factor) { light_[i] *= factor; }
  /// Divides by the probability with which such a path is kept.
  void survive(double probability) {
    for (size_t i = 0; i < count_; ++i) light_[i] /= probability;
  }

 private:
  PathBands(int count, int first) : count_(static_cast<size_t>(count)), first_(first) {}

  size_t count_ = 0;
  int first_ = 0, hero_ = 0;
  BandValues light_, share_;  // valid: the first count_
};

}  // namespace luxodus
