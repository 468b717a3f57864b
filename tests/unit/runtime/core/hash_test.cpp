#include "runtime/core/hash.hpp"

#include <xxhash.h>

#include <catch2/catch.hpp>
#include <vector>

using namespace luxodus;

TEST_CASE("hashes are the XXH3 of Debian's library, for every length, at once and in pieces",
          "[runtime][core]") {
  std::vector<std::byte> bytes;
  for (size_t i = 0; i < 100'001; ++i) bytes.push_back(static_cast<std::byte>(i * 31 % 251));
  // The algorithm has a case for each of these ranges of lengths.
  for (const size_t length : {0, 1, 3, 4, 8, 9, 16, 17, 128, 129, 240, 241, 1024, 1025, 100'001}) {
    CAPTURE(length);
    const std::span all = std::span(bytes).first(length);
    const uint64_t expected = XXH3_64bits(all.data(), length);
    CHECK(hash_of(all) == expected);
    CHECK(object_id_of(all).value == expected);
    Hasher hasher;
    hasher.add(all.data(), length / 3);
    hasher.add(all.data() + length / 3, length - length / 3);
    CHECK(hasher.value() == expected);
    hasher.reset();
    hasher.add(all.data(), length);
    CHECK(hasher.value() == expected);
  }
}
