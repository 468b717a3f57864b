// For every worker there is a word with one bit for each source that has reached it: the base
// vertices, and the controller. The words of the rotated copies of one base vertex are contiguous,
// one round and then repeated once, so that a step of all sources over all copies of a joint is one
// loop of `or` without a wrap, over whole vector registers. A register may extend beyond the first
// round: its excess is overwritten when the round is repeated. (One bit for each source: Nakao,
// Murai, Sato 2020.)
#include <algorithm>
#include <bit>
#include <cstring>

#include "topology/lift.hpp"

namespace luxodus {
namespace {

// More than the hops of any path.
constexpr uint64_t hops_of_no_way = 2 * limits::graph_vertices;

/// One vector register of words.
template <size_t bytes>
struct ChunkOf {
  using Type [[gnu::vector_size(bytes)]] = uint64_t;
};
template <>
struct ChunkOf<8> {
  using Type = uint64_t;
};

uint64_t bits_in(uint64_t chunk) {
  return static_cast<uint64_t>(std::popcount(chunk));
}
template <class Chunk>
uint64_t bits_in(const Chunk& chunk) {
  uint64_t bits = 0;
  for (size_t w = 0; w < sizeof chunk / sizeof(uint64_t); ++w) bits += bits_in(chunk[w]);
  return bits;
}

/// Works on this many bytes at a time.
template <size_t chunk_bytes>
class HopCounterOf final : public HopCounter {
 public:
  HopCounterOf(const LiftShape& shape, uint32_t word_bytes)
      : shape_(shape),
        controller_(shape.controller_links > 0),
        word_bytes_(word_bytes),
        round_bytes_(shape.turns * word_bytes),
        row_bytes_(2 * round_bytes_ + sizeof(Chunk)),
        reached_(row_bytes_ * shape.base),
        next_(reached_.size()) {
    const size_t in_last = (round_bytes_ - 1) % sizeof(Chunk) + 1;
    std::memset(&in_round_, 0, sizeof in_round_);
    std::memset(&in_round_, 0xFF, in_last);
  }

  uint64_t hops(const Lift& lift, uint64_t enough) override {
    const uint32_t sources = shape_.base + (controller_ ? 1 : 0);
    const uint32_t word_bits = 8 * word_bytes_;
    uint64_t hops = 0;
    for (uint32_t first = 0; first < sources && hops <= enough; first += word_bits) {
      hops += hops_of_sources(lift, first, std::min(sources, first + word_bits), enough - hops);
    }
    return hops;
  }

 private:
  using Chunk = typename ChunkOf<chunk_bytes>::Type;

  /// Hops from the sources first .. end - 1; source number `base` is the controller.
  uint64_t hops_of_sources(const Lift& lift, uint32_t first, uint32_t end, uint64_t enough) {
    const uint32_t base = shape_.base;
    const bool controller = end > base;
    const uint64_t base_sources = std::min(end, base) - first;
    start(first, std::min(end, base));

    // Pairs not yet reached: from base sources to workers, and from the controller to base
    // vertices. A pair reached after k hops is missing k times, so the sum of missing pairs is the
    // sum of hops.
    uint64_t missing = base_sources * (shape_.workers() - 1);
    uint64_t missing_controller = controller ? base : 0;
    uint64_t hops = 0;
    for (bool first_step = true; missing + missing_controller > 0; first_step = false) {
      hops += missing + 2 * missing_controller;
      if (hops > enough) return hops;
      const uint64_t have = step(lift, controller && first_step ? base - first : no_source);
      const uint64_t have_controller = controller ? controller_has(base - first) : 0;
      const uint64_t still =
          base_sources * shape_.workers() + have_controller * shape_.turns - have;
      const uint64_t still_controller = controller ? base - have_controller : 0;
      if (still == missing && still_controller == missing_controller) {
        return hops + (missing + missing_controller) * hops_of_no_way;
      }
      missing = still;
      missing_controller = still_controller;
      reached_.swap(next_);
    }
    return hops;
  }

  static constexpr uint32_t no_source = UINT32_MAX;

  static void set_bit(std::byte* word, uint32_t bit) { word[bit / 8] |= std::byte{1} << bit % 8; }

  void start(uint32_t first, uint32_t end) {
    std::fill(reached_.begin(), reached_.end(), std::byte{0});
    for (uint32_t b = first; b < end; ++b) {
      std::byte* row = &reached_[row_bytes_ * b];
      set_bit(row, b - first);
      set_bit(row + round_bytes_, b - first);
    }
  }

  /// Advances all sources by one hop, into next_; the controller, if its bit is given, reaches its
  /// neighbours. Returns the number of bits set afterwards.
  uint64_t step(const Lift& lift, uint32_t controller_bit) {
    const std::vector<Lift::Joint>& joints = lift.joints();
    uint64_t have = 0;
    for (uint32_t b = 0; b < shape_.base; ++b) {
      const Lift::Joint* joint = &joints[size_t{b} * shape_.links];
      std::byte* row = &next_[row_bytes_ * b];
      for (size_t at = 0; at < round_bytes_; at += sizeof(Chunk)) {
        Chunk chunk = load(&reached_[row_bytes_ * b + at]);
        for (uint32_t i = 0; i < shape_.links; ++i) {
          if (joint[i].mate == Lift::to_controller) continue;
          chunk |= load(&reached_[row_bytes_ * joint[i].base + joint[i].turn * word_bytes_ + at]);
        }
        store(row + at, chunk);
      }
      if (controller_bit != no_source) reach_from_controller(joint, row, controller_bit);
      have += repeat_round(row);
    }
    return have;
  }

  /// Returns the number of bits set in the round.
  uint64_t repeat_round(std::byte* row) const {
    uint64_t have = 0;
    for (size_t at = 0; at < round_bytes_; at += sizeof(Chunk)) {
      const Chunk chunk = load(row + at);
      store(row + round_bytes_ + at, chunk);
      const bool last = at + sizeof(Chunk) >= round_bytes_;
      have += bits_in(last ? chunk & in_round_ : chunk);
    }
    return have;
  }

  static Chunk load(const std::byte* bytes) {
    Chunk chunk;
    std::memcpy(&chunk, bytes, sizeof chunk);
    return chunk;
  }
  static void store(std::byte* bytes, const Chunk& chunk) {
    std::memcpy(bytes, &chunk, sizeof chunk);
  }

  void reach_from_controller(const Lift::Joint* joint, std::byte* row, uint32_t bit) const {
    const bool linked = std::any_of(joint, joint + shape_.links, [](const Lift::Joint& j) {
      return j.mate == Lift::to_controller;
    });
    for (uint32_t t = 0; linked && t < shape_.turns; ++t) set_bit(row + t * word_bytes_, bit);
  }

  /// Number of base vertices that the controller has reached.
  uint64_t controller_has(uint32_t bit) const {
    uint64_t count = 0;
    for (uint32_t b = 0; b < shape_.base; ++b) {
      const std::byte byte = next_[row_bytes_ * b + bit / 8];
      count += std::to_integer<uint64_t>(byte >> bit % 8 & std::byte{1});
    }
    return count;
  }

  LiftShape shape_;
  bool controller_;
  uint32_t word_bytes_;
  size_t round_bytes_, row_bytes_;
  Chunk in_round_;                         // the part of a round's last chunk that belongs to it
  std::vector<std::byte> reached_, next_;  // a row for each base vertex
};

}  // namespace

std::unique_ptr<HopCounter> make_hop_counter(const LiftShape& shape) {
  const uint32_t sources = shape.base + (shape.controller_links > 0 ? 1 : 0);
  const uint32_t word_bytes = sources <= 8 ? 1 : sources <= 16 ? 2 : sources <= 32 ? 4 : 8;
  const uint32_t round_bytes = word_bytes * shape.turns;
  if (round_bytes <= 8) return std::make_unique<HopCounterOf<8>>(shape, word_bytes);
  if (round_bytes <= 16) return std::make_unique<HopCounterOf<16>>(shape, word_bytes);
  return std::make_unique<HopCounterOf<32>>(shape, word_bytes);
}

}  // namespace luxodus
