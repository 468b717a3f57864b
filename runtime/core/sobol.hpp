// Randomised low-discrepancy points: the Sobol' sequence in 16 dimensions (direction numbers of S.
// Joe and F. Y. Kuo, "Constructing Sobol' sequences with better two-dimensional projections", SIAM
// J. Sci. Comput. 30 (2008)), scrambled by a random linear matrix per dimension and shifted by
// random digits (J. Matousek, "On the L2-discrepancy for anchored boxes", J. Complexity 14 (1998)).
// Promise: every point of a set is uniform on [0, 1)^16, so a mean over them is unbiased; the first
// 2^k points lie one in each interval of 2^-k in every dimension; sets of different numbers are
// independent, so the spread of their means is an honest standard error. Thread rule: plain values;
// one thread per object.
#pragma once

#include <array>
#include <cstdint>

namespace luxodus {

enum class RandomStream : uint32_t;

class SobolSet {
 public:
  static constexpr uint32_t dimensions = 16;
  using Point = std::array<uint32_t, dimensions>;  // units of 2^-32

  /// Sets of different streams are independent.
  SobolSet(uint64_t seed, RandomStream stream) : seed_(seed), stream_(stream) {}

  /// Selects the set with this number, with room for `count` points. Free if it is already
  /// selected.
  void choose(uint64_t number, uint32_t count);

  /// Requires: index < the count of choose().
  void point(uint32_t index, Point& out) const {
    out = shift_;
    for (uint32_t column = 0; index != 0; ++column, index >>= 1) {
      const uint32_t mask = 0u - (index & 1);
      for (uint32_t d = 0; d < dimensions; ++d) out[d] ^= scrambled_[column][d] & mask;
    }
  }

 private:
  uint64_t seed_;
  uint64_t number_ = 0;
  RandomStream stream_;
  uint32_t columns_ = 0;  // columns computed; 0 before choose()
  alignas(32) Point shift_{};
  alignas(
      32) std::array<Point, 32> scrambled_;  // direction numbers of this set, by bit of the index
};

}  // namespace luxodus
