// Mutated EULUMDAT and IES files. The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS sets how many
// files are mutated.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "runtime/core/regular_file.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/unit/scenes/formats/photometry/photometric_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

Bytes bytes_of_file(const std::filesystem::path& path) {
  auto text = read_regular_file(path, 1 << 20);
  REQUIRE(text.ok());
  const auto* from = reinterpret_cast<const std::byte*>(text->data());
  return Bytes(from, from + text->size());
}

}  // namespace

TEST_CASE("mutated EULUMDAT and IES files are read or rejected with one sentence",
          "[format][ldt][ies]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const int tries = count_text != nullptr ? std::atoi(count_text) : 1000;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(2);
  const Bytes ldt = bytes_of_file(luminaires / "bulkhead.ldt");
  const Bytes ies = bytes_of_file(luminaires / "wall_bulkhead.ies");
  int read = 0;
  for (int i = 0; i < tries; ++i) {
    const bool first = random.bits() % 2 == 0;
    const Bytes bytes = mutated(first ? ldt : ies, first ? ies : ldt, random);
    const std::string_view harmed(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto file = photometric_file_of(harmed, "harmed", luminaires);
    if (!file) {
      REQUIRE_FALSE(file.problem().what.empty());
      continue;
    }
    ++read;
    REQUIRE(file->web->flux_lm() > 0);
    REQUIRE(std::isfinite(file->flux_lm));
  }
  CHECK(read > tries / 50);  // mutations that reach deep
  CHECK(read < tries);
}
