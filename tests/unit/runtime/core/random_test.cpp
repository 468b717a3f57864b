#include "runtime/core/random.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace luxodus;

TEST_CASE("Philox gives the published test vectors", "[core][random]") {
  // Random123 1.09, kat_vectors, philox4x32 10 rounds.
  CHECK(philox_block({0, 0, 0, 0}, 0) ==
        std::array<uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox_block({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, ~uint64_t{0}) ==
        std::array<uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox_block({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0a4093822) ==
        std::array<uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("a particle's draws are the blocks of its counter, beyond any refill", "[core][random]") {
  const uint64_t seed = 0x1234567890abcdef;
  const uint64_t particle = 0x9876543210;
  Random random(seed, RandomStream::eye);
  random.start(particle);
  for (uint32_t draw = 0; draw < 200; ++draw) {
    const uint32_t block = draw / 32 * 8 + draw % 8;
    const uint32_t word = draw % 32 / 8;
    const auto expected =
        philox_block({block, static_cast<uint32_t>(RandomStream::eye),
                      static_cast<uint32_t>(particle), static_cast<uint32_t>(particle >> 32)},
                     seed);
    REQUIRE(random.bits() == expected[word]);
  }
}

TEST_CASE("restarting a particle repeats its draws whatever was drawn before", "[core][random]") {
  Random random(7, RandomStream::particle);
  random.start(41);
  std::vector<uint32_t> first;
  for (int i = 0; i < 50; ++i) first.push_back(random.bits());
  random.start(42);
  CHECK(random.bits() != first[0]);
  random.start(41);
  for (uint32_t word : first) REQUIRE(random.bits() == word);
}

TEST_CASE("uniform draws have mean 1/2, variance 1/12, and stay below 1", "[core][random]") {
  Random random(3, RandomStream::test);
  const int n = 1 << 20;
  double sum = 0, square = 0;
  for (int i = 0; i < n; ++i) {
    if (i % 16 == 0) random.start(static_cast<uint64_t>(i));
    const float u = random.uniform();
    REQUIRE(u < 1.0f);
    sum += u;
    square += u * u;
  }
  CHECK(std::abs(sum / n - 0.5) < 4 * std::sqrt(1.0 / 12 / n));
  CHECK(std::abs(square / n - 1.0 / 3) < 4 * std::sqrt(4.0 / 45 / n));
}
