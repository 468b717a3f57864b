// Small corruptions of bytes, drawn from the seed: flipped bits, words that break arithmetic,
// truncation, extension, splicing with another frame. Pure but for the random numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "runtime/core/random.hpp"

namespace luxodus::test {

using Bytes = std::vector<std::byte>;

inline void harm(Bytes& bytes, const Bytes& other, Random& random) {
  if (bytes.empty()) bytes.resize(8);
  const size_t at = random.bits() % bytes.size();
  switch (random.bits() % 6) {
    case 0:
      bytes[at] ^= static_cast<std::byte>(1u << (random.bits() % 8));
      break;
    case 1:
      bytes[at] = static_cast<std::byte>(random.bits());
      break;
    case 2: {
      constexpr uint32_t words[] = {0,          1,          0x7fffffff, 0x80000000,
                                    0xffffffff, 0xfffffffe, 0x1fffffff};
      const uint32_t word = words[random.bits() % std::size(words)];
      const size_t from = at / 4 * 4;
      if (from + sizeof word <= bytes.size()) std::memcpy(bytes.data() + from, &word, sizeof word);
      break;
    }
    case 3:
      bytes.resize(at);
      break;
    case 4:
      bytes.resize(bytes.size() + random.bits() % 64, static_cast<std::byte>(0xa5));
      break;
    case 5: {
      const size_t from = std::min(at, other.size());
      bytes.resize(from);
      bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
      break;
    }
    default:
      break;
  }
}

/// One corruption, sometimes several.
inline Bytes mutated(const Bytes& bytes, const Bytes& other, Random& random) {
  Bytes out = bytes;
  do harm(out, other, random);
  while (random.uniform() < 0.4f);
  return out;
}

}  // namespace luxodus::test
