// The comparison of two builds: results that it accepts, and results that it must not.
#include "tests/precision/compare.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace luxodus;
using namespace luxodus::precision;

namespace {

constexpr int batches = 256;
/// Statistical error of 1e9 particles in standard deviations of a batch: 256 batches of a thousand
/// particles give the mean to a sixteenth, 3906 times as many 62.5 times better.
constexpr double statistical = 1.0 / 16 / 62.5;

/// A bin whose batches have the standard deviation `deviation`; in the other build they are larger
/// by `off` of these, with noise of `noise` of them.
struct Pair {
  Traced single, twice;
};
Pair pair(double off, double noise) {
  constexpr double mean = 1e9, deviation = 1e7;
  Pair out;
  out.twice = {"double", "room", 1000, {"planes"}, {"floor"}, {}};
  out.single = out.twice;
  out.single.precision = "single";
  for (int k = 0; k < batches; ++k) {
    const double value = mean + (k % 2 == 0 ? deviation : -deviation);
    const double differs = off + (k / 2 % 2 == 0 ? noise : -noise);
    out.twice.rows.push_back({value});
    out.single.rows.push_back({value + deviation * differs});
  }
  return out;
}

bool passes(double off, double noise) {
  const Pair p = pair(off, noise);
  return compare(p.single, p.twice);
}

}  // namespace

TEST_CASE("builds that differ by less than a tenth of the statistical error pass") {
  CHECK(passes(0, 0));
  CHECK(passes(0.05 * statistical, 0));
  CHECK(passes(0, 0.5 * statistical));
}

TEST_CASE("a difference of a fifth of the statistical error fails, in either direction") {
  CHECK_FALSE(passes(0.2 * statistical, 0));
  CHECK_FALSE(passes(-0.2 * statistical, 0));
  CHECK_FALSE(passes(0.2 * statistical, 0.1 * statistical));
}

TEST_CASE("a comparison with too large an error of its own fails, whatever its result") {
  CHECK_FALSE(passes(0, 3 * statistical));
  CHECK_FALSE(passes(0, 1));
}

TEST_CASE("files of different scenes, batches or builds are not compared") {
  Pair p = pair(0, 0);
  CHECK_THROWS_AS(compare(p.twice, p.single), std::runtime_error);
  CHECK_THROWS_AS(compare(p.single, p.single), std::runtime_error);
  Traced other = p.twice;
  other.scene = "another room";
  CHECK_THROWS_AS(compare(p.single, other), std::runtime_error);
  p.twice.rows.pop_back();
  CHECK_THROWS_AS(compare(p.single, p.twice), std::runtime_error);
}
