// Counter-based random numbers: Philox 4x32-10 (Salmon, Moraes, Dror, Shaw, "Parallel random
// numbers: as easy as 1, 2, 3", SC11). A draw is a pure function of (seed, stream, particle, draw
// number), so any machine can redo any particle and get the same bits. Draws of one particle are
// made 32 at a time, in vector registers where the target has them; the scalar code gives the same
// numbers. Rule: never two draws in one expression, since the compiler chooses their order. Thread
// rule: a Random belongs to one fiber or thread.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/core/sobol.hpp"

namespace luxodus {

/// Purpose of a stream: equal particle ids in different streams are independent.
enum class RandomStream : uint32_t {
  particle = 0,
  eye = 1,
  picture = 2,
  layout = 3,
  test = 4,
  graph = 5,
  fetch = 6,
  faults = 7,
  simulation = 8,
  scramble = 9
};

/// One Philox 4x32-10 block, the reference for every other form.
inline std::array<uint32_t, 4> philox_block(std::array<uint32_t, 4> counter, uint64_t seed) {
  uint32_t key0 = static_cast<uint32_t>(seed);
  uint32_t key1 = static_cast<uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    const uint64_t p0 = uint64_t{0xD2511F53} * counter[0];
    const uint64_t p1 = uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<uint32_t>(p1 >> 32) ^ counter[1] ^ key0, static_cast<uint32_t>(p1),
               static_cast<uint32_t>(p0 >> 32) ^ counter[3] ^ key1, static_cast<uint32_t>(p0)};
    key0 += 0x9E3779B9u;
    key1 += 0xBB67AE85u;
  }
  return counter;
}

/// The draws of one particle in order. Plain value, one per fiber or thread.
class Random {
 public:
  /// `part` separates users of one stream with the same ids; below 2^24.
  Random(uint64_t seed, RandomStream stream, uint32_t part = 0)
      : seed_(seed), stream_(static_cast<uint32_t>(stream) | part << 8) {}

  /// Begins the sequence of this particle at its first draw.
  void start(uint64_t particle) {
    particle_ = particle;
    block_ = 0;
    refill();
  }
  /// Begins the sequence; the first draws are the coordinates of a point of `set`.
  void start(uint64_t particle, const SobolSet& set, uint32_t index) {
    start(particle);
    SobolSet::Point point;
    set.point(index, point);
    for (uint32_t d = 0; d < SobolSet::dimensions; ++d) words_[d] = point[d];
  }

  /// The next 32 random bits.
  uint32_t bits() {
    if (next_ == draws_per_refill) refill();
    return static_cast<uint32_t>(words_[next_++]);
  }
  uint64_t bits64() {
    const uint64_t high = bits();
    const uint64_t low = bits();
    return (high << 32) | low;
  }
  /// Uniform in [0, 1), a multiple of 2^-24: never rounds to 1 in float.
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform_double() { return static_cast<double>(bits64() >> 11) * 0x1p-53; }

 private:
  static constexpr uint32_t blocks_per_refill = 8;
  static constexpr uint32_t draws_per_refill = 4 * blocks_per_refill;

  // Draw number d of a refill is word d / 8 of block d % 8: the order in which vector lanes come
  // out. Compiled once, at the highest level that the build has, whatever the caller's.
  void refill();

  uint64_t seed_;
  uint32_t stream_;
  uint32_t block_ = 0;
  uint64_t particle_ = 0;
  uint32_t next_ = draws_per_refill;
  alignas(32) std::array<uint64_t, draws_per_refill> words_{};
};

}  // namespace luxodus
