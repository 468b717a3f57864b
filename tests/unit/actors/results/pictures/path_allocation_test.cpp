// The last paths of a picture are allocated where they are needed, without bias.
#include "actors/results/pictures/path_allocation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "actors/results/pictures/pixel_tracer.hpp"

using namespace luxodus;

namespace {

constexpr int columns = 24, rows = 16;
constexpr int even = 24, allotted = 8;

void one_by_one(int64_t count, const std::function<void(int64_t)>& work) {
  for (int64_t i = 0; i < count; ++i) work(i);
}

void add_path(PixelSums& sums, int path, double light) {
  sums.add(path, {light, light, light, light}, {}, {}, {});
}

using Draw = std::function<double(int column)>;

/// Pixels with equal numbers of paths, whose light is random.
std::vector<PixelSums> drawn(const Draw& draw) {
  std::vector<PixelSums> pixels(columns * rows);
  for (size_t i = 0; i < pixels.size(); ++i)
    for (int path = 0; path < even; ++path)
      add_path(pixels[i], path, draw(static_cast<int>(i % columns)));
  return pixels;
}

std::vector<HalfEnds> allocated(const std::vector<PixelSums>& pixels) {
  return allocate_paths(pixels, columns, rows, even, allotted, one_by_one);
}

/// Paths added to a pixel, on average over pixels.
double added(const std::vector<HalfEnds>& ends, size_t half) {
  double sum = 0;
  for (const HalfEnds& of_pixel : ends) sum += of_pixel[half] - even;
  return sum / static_cast<double>(ends.size());
}

}  // namespace

TEST_CASE("three quarters of the paths are the same for all pixels", "[display]") {
  CHECK(even_paths(4) == 4);
  CHECK(even_paths(15) == 15);
  CHECK(even_paths(16) == 12);
  CHECK(even_paths(32) == 24);
  CHECK(even_paths(50) == 36);
  CHECK(even_paths(limits::max_paths_per_pixel) == limits::max_paths_per_pixel / 4 * 3);
}

TEST_CASE("all remaining paths are allocated, to noisy pixels before uniform ones", "[display]") {
  std::mt19937 random(11);
  std::exponential_distribution<double> chance(1);
  // One column is noisy, unlike its neighbours.
  const std::vector<HalfEnds> ends =
      allocated(drawn([&](int column) { return column == 9 ? 40 * chance(random) : 1.0; }));
  for (const size_t half : {size_t{0}, size_t{1}}) {
    CHECK(added(ends, half) <= allotted);
    CHECK(added(ends, half) > 0.9 * allotted);
    double noisy = 0;
    for (size_t i = 0; i < ends.size(); ++i) {
      CHECK(ends[i][half] % 4 == 0);
      CHECK(ends[i][half] >= even);
      CHECK(ends[i][half] <= 32 * even);
      if (i % columns >= 7 && i % columns <= 11) noisy += ends[i][half] - even;
    }
    CHECK(noisy / static_cast<double>(ends.size()) > 0.95 * added(ends, half));
  }
}

TEST_CASE("without uncertainty no paths are allocated", "[display]") {
  for (const double light : {0.0, 2.0})
    for (const HalfEnds& ends : allocated(drawn([&](int) { return light; })))
      CHECK(ends == HalfEnds{even, even});
}

TEST_CASE("the paths of one half are allocated by the results of the other half", "[display]") {
  std::mt19937 random(11);
  std::exponential_distribution<double> chance(1);
  std::vector<PixelSums> pixels = drawn([&](int) { return chance(random); });
  const std::vector<HalfEnds> before = allocated(pixels);
  const size_t pixel = 5 * columns + 7;
  int path = 0;
  while (half_of(path) != 1) ++path;
  add_path(pixels[pixel], path, 1e6);
  const std::vector<HalfEnds> after = allocated(pixels);
  CHECK(after[pixel][0] > before[pixel][0]);
  for (size_t i = 0; i < pixels.size(); ++i) CHECK(after[i][1] == before[i][1]);
}

TEST_CASE("allocated paths do not bias the mean, however rare bright paths are", "[display]") {
  std::mt19937 random(3);
  std::bernoulli_distribution is_bright(0.02);
  const auto light = [&] { return is_bright(random) ? 50.0 : 0.0; };  // 1 on average
  constexpr int pictures = 60;
  const HalfShares shares = shares_of_halves(even);
  double sum = 0, squares = 0, by_number = 0;
  for (int k = 0; k < pictures; ++k) {
    std::vector<PixelSums> pixels = drawn([&](int) { return light(); });
    const std::vector<HalfEnds> ends = allocated(pixels);
    for (size_t i = 0; i < pixels.size(); ++i) {
      for (int path = even; path < std::max(ends[i][0], ends[i][1]); ++path)
        if (path < ends[i][half_of(path)]) add_path(pixels[i], path, light());
      const double mean = pixels[i].mean(shares)[0];
      sum += mean;
      squares += mean * mean;
      by_number += (pixels[i].turned(0, 0) + pixels[i].turned(1, 0)) / pixels[i].paths();
    }
  }
  const double n = double{pictures} * columns * rows;
  const double error = std::sqrt((squares / n - sum / n * sum / n) / n);
  CHECK(std::abs(sum / n - 1) < 4 * error);
  // The test could detect a bias: a mean by the numbers of paths has one.
  CHECK(by_number / n < 1 - 8 * error);
}
