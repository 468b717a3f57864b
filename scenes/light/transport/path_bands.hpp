// The bands that a path from the eye carries, and what it brings of each. A path of a picture
// carries all of them: one, the hero, decides how it goes on, and every band is weighted by the
// balance heuristic over what each would have decided as hero (A. Wilkie et al., "Hero wavelength
// spectral sampling", EGSR 2014). So light of every band is the same function of the path whichever
// was its hero, and colours come without chance where surfaces and media treat bands alike. A path
// of one band is the same with one. Plain values.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "scenes/light/optics/media_tables.hpp"

namespace luxodus {

/// A value of each band that a path carries, by place among them.
using BandValues = std::array<double, limits::max_media_bands>;

class PathBands {
 public:
  static PathBands one(int band) {
    PathBands out(1, band);
    out.hero_ = band;
    out.light_[0] = out.share_[0] = 1;
    return out;
  }
  /// All bands of a scene. `probability`: of each to be the hero.
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

  /// What the path brings of a band: of the light, over how densely such paths are drawn.
  double light(size_t i) const { return light_[i]; }
  double brightest() const { return *std::max_element(light_.begin(), light_.begin() + count_); }
  /// Of the paths that go this way, those of which the band is the hero.
  double share(size_t i) const { return share_[i]; }
  /// How densely heroes draw something, by how densely each does.
  template <class DensityOf>
  double mixed(DensityOf&& density) const {
    double sum = 0;
    for (size_t i = 0; i < count_; ++i) sum += share_[i] * density(i);
    return sum;
  }

  /// After an event that each band would have drawn with such a density, and all together with
  /// `mixed_density`. `passed`: light that goes on, over that. Requires: mixed_density > 0.
  void go_on(const BandValues& passed, const BandValues& density, double mixed_density) {
    for (size_t i = 0; i < count_; ++i) {
      light_[i] *= passed[i];
      share_[i] *= density[i] / mixed_density;
    }
  }
  /// After an event that all bands would have drawn alike.
  void scale(size_t i, double factor) { light_[i] *= factor; }
  /// One over the probability with which a path like this is kept.
  void survive(double probability) {
    for (size_t i = 0; i < count_; ++i) light_[i] /= probability;
  }

 private:
  PathBands(int count, int first) : count_(static_cast<size_t>(count)), first_(first) {}

  size_t count_ = 0;
  int first_ = 0, hero_ = 0;
  BandValues light_, share_;  // of the first count_
};

}  // namespace luxodus
