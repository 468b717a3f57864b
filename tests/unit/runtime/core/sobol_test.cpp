#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

constexpr uint32_t dims = SobolSet::dimensions;

std::vector<SobolSet::Point> points_of(uint64_t number, uint32_t count, uint64_t seed = 1) {
  SobolSet set(seed, RandomStream::test);
  set.choose(number, count);
  std::vector<SobolSet::Point> points(count);
  for (uint32_t i = 0; i < count; ++i) set.point(i, points[i]);
  return points;
}

double unit(uint32_t coordinate) {
  return coordinate * 0x1p-32;
}

/// A smooth function of all dimensions, of mean 1.
template <class Coordinate>
double smooth(Coordinate&& coordinate) {
  double product = 1;
  for (uint32_t d = 0; d < dims; ++d) product *= 1 + (coordinate(d) - 0.5) / (d + 1);
  return product;
}

}  // namespace

TEST_CASE("2^k points of a set lie one in each of 2^k intervals, in every dimension") {
  for (uint64_t number = 0; number < 20; ++number) {
    for (const uint32_t k : {0u, 1u, 4u, 10u, 13u}) {
      const auto points = points_of(number, 1u << k);
      for (uint32_t d = 0; d < dims; ++d) {
        std::set<uint32_t> intervals;
        for (const auto& p : points) intervals.insert(k == 0 ? 0 : p[d] >> (32 - k));
        REQUIRE(intervals.size() == points.size());
      }
    }
  }
}

TEST_CASE("in the first two dimensions every box of area 2^-10 holds one of 2^10 points") {
  for (uint64_t number = 0; number < 20; ++number) {
    const auto points = points_of(number, 1 << 10);
    for (uint32_t x = 0; x <= 10; ++x) {
      std::set<uint64_t> boxes;
      for (const auto& p : points) {
        const uint64_t column = uint64_t{p[0]} >> (32 - x);
        const uint64_t row = uint64_t{p[1]} >> (32 - (10 - x));
        boxes.insert(column << 32 | row);
      }
      REQUIRE(boxes.size() == points.size());
    }
  }
}

TEST_CASE("each point is uniform over sets, and two points of a set are not each other's image") {
  constexpr int sets = 1 << 14;
  SobolSet set(7, RandomStream::test);
  for (const uint32_t index : {0u, 1u, 37u, 255u}) {
    for (uint32_t d = 0; d < dims; ++d) {
      double mean = 0, square = 0, product = 0;
      for (int number = 0; number < sets; ++number) {
        set.choose(static_cast<uint64_t>(number), 256);
        SobolSet::Point p, other;
        set.point(index, p);
        set.point(index ^ 128, other);
        const double x = unit(p[d]) - 0.5;
        mean += x;
        square += x * x;
        product += x * (unit(other[d]) - 0.5);
      }
      CAPTURE(index, d);
      const double root = std::sqrt(static_cast<double>(sets));
      CHECK(std::abs(mean / sets) < 4.5 * std::sqrt(1.0 / 12) / root);
      CHECK(std::abs(square / sets - 1.0 / 12) < 4.5 * std::sqrt(1.0 / 180) / root);
      CHECK(std::abs(product / sets) < 0.09);  // never farther apart than an interval: 1 / 12
    }
  }
}

TEST_CASE(
    "means over sets have no bias, honest errors, and far less variance than independent draws") {
  constexpr int sets = 512;
  constexpr uint32_t count = 1024;
  double sum = 0, squares = 0, plain_squares = 0;
  Random random(3, RandomStream::test);
  for (int number = 0; number < sets; ++number) {
    double mean = 0, plain = 0;
    random.start(static_cast<uint64_t>(number));
    for (const auto& p : points_of(static_cast<uint64_t>(number), count, 3)) {
      mean += smooth([&](uint32_t d) { return unit(p[d]); }) / count;
      plain += smooth([&](uint32_t) { return random.uniform_double(); }) / count;
    }
    sum += mean - 1;
    squares += (mean - 1) * (mean - 1);
    plain_squares += (plain - 1) * (plain - 1);
  }
  const double error = std::sqrt(squares / sets / sets);
  CHECK(std::abs(sum / sets) < 4.5 * error);
  CHECK(squares < plain_squares / 50);
}

TEST_CASE("other seeds, streams and numbers give other points, the same ones the same") {
  const auto points = points_of(5, 64);
  CHECK(points == points_of(5, 64));
  CHECK(points != points_of(6, 64));
  CHECK(points != points_of(5, 64, 2));
  SobolSet other(1, RandomStream::eye);
  other.choose(5, 64);
  SobolSet::Point p;
  other.point(0, p);
  CHECK(p != points[0]);
}

TEST_CASE("the first draws of a stratified history are its point, the rest its own") {
  SobolSet set(9, RandomStream::test);
  set.choose(64, 64);
  Random plain(9, RandomStream::test);
  Random stratified(9, RandomStream::test);
  SobolSet::Point point;
  set.point(3, point);
  plain.start(67);
  stratified.start(67, set, 3);
  for (uint32_t d = 0; d < dims; ++d) {
    plain.bits();
    CHECK(stratified.bits() == point[d]);
  }
  for (int draw = 0; draw < 100; ++draw) CHECK(stratified.bits() == plain.bits());
}
