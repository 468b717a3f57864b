// A quantity known with noise at a few places, the supports, and interpolated between them. Which
// supports a place may use is for the caller to say: those that it sees. Plain values; any thread
// once the supports are set.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/emergency/uncertain.hpp"

namespace luxodus {

/// A support near a place.
struct NearSupport {
  uint32_t support = 0;
  double distance_m = 0;
};

/// Bound that is assumed for the error of a luminance of which nothing is known [cd/m2]: no smoke
/// glows as brightly.
inline constexpr double any_luminance = 1e6;

/// Factors on the errors of interpolated values, to ask what less of them would decide.
struct Doubt {
  double noise = 1, bound = 1;
};

/// An interpolated value: with the standard error of its noise, and with a bound of the error of
/// the interpolation.
struct Interpolated {
  double value = 0;
  double noise = 0;
  double bound = any_luminance;

  /// With an error of which `sure_errors` hold the bound and as many of the noise.
  Uncertain at_worst(double sure_errors, const Doubt& doubt) const {
    return {value, doubt.noise * noise + doubt.bound * bound / sure_errors};
  }
};

namespace limits {
/// Supports that a value is interpolated between, at most.
inline constexpr size_t near_supports = 4;
}  // namespace limits

class SupportField {
 public:
  /// Adds or replaces the value of a support.
  void set(uint32_t support, const Uncertain& value);
  /// Of this support nothing can be known: nothing bounds a value near it.
  void lose(uint32_t support);

  /// Compares the value of a support with that which its neighbours give there. Call again after
  /// any of them has changed. Requires: `others` without the support itself.
  void test(uint32_t support, std::span<const NearSupport> others);

  /// Between these supports, by inverse squares of distances. The bound is the largest by which one
  /// of them differs from what its neighbours give there, less noise, and half the range of their
  /// values; any_luminance without two supports, one of which has neighbours, and beside one that
  /// is lost.
  Interpolated at(std::span<const NearSupport> near) const;

 private:
  struct Value {
    Uncertain value;
    double off = -1;  // from what the neighbours give; < 0: not known
    bool known = false, lost = false;
  };
  /// Weighted mean of the values that are known, and the standard error of its noise.
  Uncertain mean(std::span<const NearSupport> near) const;

  std::vector<Value> values_;  // by support
};

}  // namespace luxodus
