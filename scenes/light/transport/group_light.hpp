// Light that arrives at an eye or a probe, kept by source group and by band. One thread or fiber.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace luxodus {

/// Light of one source group on its way to an eye [W/(m2 sr)].
struct SourceLight {
  int group = 0;
  double radiance = 0;
};

/// Light that arrives at a place, by source group and by band: the sum of an eye path.
class GroupLight {
 public:
  /// `bands`: 0 if no values by band are needed.
  explicit GroupLight(size_t groups, size_t bands = 0)
      : by_group_(groups, 0.0), by_band_(bands, 0.0) {}

  void clear() {
    std::fill(by_group_.begin(), by_group_.end(), 0.0);
    std::fill(by_band_.begin(), by_band_.end(), 0.0);
    total_ = 0;
  }
  void add(int group, double amount) {
    by_group_[static_cast<size_t>(group)] += amount;
    total_ += amount;
  }
  void add(int group, int band, double amount) {
    add(group, amount);
    add_to_band(band, amount);
  }
  /// Adds light whose source group is unknown, e.g. from a patch that all groups light.
  void add_of_all(int band, double amount) {
    total_ += amount;
    add_to_band(band, amount);
  }

  void add_scaled(const GroupLight& light, double factor) {
    for (size_t g = 0; g < by_group_.size(); ++g) by_group_[g] += factor * light.by_group_[g];
    total_ += factor * light.total_;
  }

  double total() const { return total_; }
  /// The sum of each group's light times its factor. Requires: as many factors as groups.
  double sum(const std::vector<double>& factors) const {
    double out = 0;
    for (size_t g = 0; g < factors.size(); ++g) out += factors[g] * by_group_[g];
    return out;
  }
  double of(size_t group) const { return by_group_[group]; }
  std::span<const double> by_band() const { return by_band_; }

 private:
  void add_to_band(int band, double amount) {
    if (!by_band_.empty()) by_band_[static_cast<size_t>(band)] += amount;
  }

  std::vector<double> by_group_, by_band_;
  double total_ = 0;
};

}  // namespace luxodus
