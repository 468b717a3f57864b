#include "runtime/observe/histogram.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "runtime/core/random.hpp"

using namespace luxodus;

TEST_CASE("a histogram is a few kilobytes", "[runtime][histogram]") {
  CHECK(sizeof(Histogram) < 6 * 1024);
}

TEST_CASE("an empty histogram has no durations", "[runtime][histogram]") {
  const Histogram empty;
  CHECK(empty.count() == 0);
  CHECK(empty.at(0.99) == 0);
}

TEST_CASE("a single duration is every quantile, the least and the most", "[runtime][histogram]") {
  for (const Nanoseconds one : {Nanoseconds{1}, Nanoseconds{999}, microseconds(1), microseconds(99),
                                microseconds(100), milliseconds(37), seconds(99), seconds(1000)}) {
    Histogram histogram;
    histogram.add(one);
    CHECK(histogram.at(0.0) == one);
    CHECK(histogram.at(0.5) == one);
    CHECK(histogram.at(1.0) == one);
    CHECK(histogram.least() == one);
    CHECK(histogram.most() == one);
    CHECK(histogram.sum() == one);
  }
}

TEST_CASE("quantiles err by less than a tenth, upwards, in all decades", "[runtime][histogram]") {
  Random random(5, RandomStream::test);
  random.start(1);
  Histogram histogram;
  std::vector<Nanoseconds> exact;
  for (int i = 0; i < 20'000; ++i) {
    const auto duration = static_cast<Nanoseconds>(1e3 * std::pow(1e8, random.uniform_double()));
    histogram.add(duration);
    exact.push_back(duration);
  }
  std::sort(exact.begin(), exact.end());
  for (const double q : {0.0001, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 0.9999, 1.0}) {
    const auto rank = static_cast<size_t>(std::ceil(q * static_cast<double>(exact.size())));
    const auto truth = static_cast<double>(exact[std::max<size_t>(rank, 1) - 1]);
    const auto told = static_cast<double>(histogram.at(q));
    CHECK(told >= truth);
    CHECK(told <= truth * 1.1 + 1);
  }
}

TEST_CASE("two merged histograms equal one that counted everything", "[runtime][histogram]") {
  Histogram one, two, both;
  for (int i = 0; i < 1000; ++i) {
    const Nanoseconds duration = microseconds(1) << (i % 25);
    (i % 3 == 0 ? one : two).add(duration);
    both.add(duration);
  }
  Histogram sum;
  sum.merge(one);
  sum.merge(two);
  sum.merge(Histogram());
  CHECK(sum.count() == both.count());
  CHECK(sum.sum() == both.sum());
  CHECK(sum.least() == both.least());
  CHECK(sum.most() == both.most());
  for (const double q : {0.1, 0.5, 0.9, 0.99}) CHECK(sum.at(q) == both.at(q));
}

TEST_CASE("negative durations count as zero, and too long ones keep their maximum",
          "[runtime][histogram]") {
  Histogram histogram;
  histogram.add(-5);
  histogram.add(seconds(500));
  CHECK(histogram.least() == 0);
  CHECK(histogram.at(0.5) == microseconds(1));
  CHECK(histogram.at(1.0) == seconds(500));
}
