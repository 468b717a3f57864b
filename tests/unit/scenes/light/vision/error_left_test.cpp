// Prediction of the error that the filter leaves: small where many pixels are similar.
#include "scenes/light/vision/error_left.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace luxodus;

namespace {

constexpr int columns = 40, rows = 30;  // in all pictures
constexpr float deviation = 0.2f;       // of all pixels [cd/m2]

void one_by_one(int64_t count, const std::function<void(int64_t)>& work) {
  for (int64_t i = 0; i < count; ++i) work(i);
}

size_t at(int x, int y) {
  return static_cast<size_t>(y * columns + x);
}

UncertainLight even_light(float light) {
  constexpr size_t pixels = columns * rows;
  return {std::vector<float>(pixels, light), std::vector<float>(pixels, deviation * deviation)};
}

std::vector<float> left_of(const UncertainLight& light) {
  return error_left(light, columns, rows, RegressionFilter{}.tolerance, one_by_one);
}

}  // namespace

TEST_CASE("in uniform light the error left is that of the average over a small window",
          "[filter]") {
  const std::vector<float> left = left_of(even_light(3));
  CHECK(left[at(20, 15)] == Approx(deviation / 9));  // 9 x 9 pixels
  CHECK(left[at(0, 0)] == Approx(deviation / 5));    // of these, 5 x 5 are in the picture
}

TEST_CASE("at an edge and in a thin line more error is left", "[filter]") {
  UncertainLight light = even_light(3);
  for (int y = 0; y < rows; ++y) {
    for (int x = 20; x < columns; ++x) light.light[at(x, y)] = 30;
    light.light[at(8, y)] = 30;
  }
  const std::vector<float> left = left_of(light);
  const float within = left[at(32, 15)], edge = left[at(19, 15)], line = left[at(8, 15)];
  CHECK(edge > 1.5f * within);
  CHECK(line == Approx(deviation / 3));  // only the line's own 9 pixels are similar
}

TEST_CASE("a pixel unlike all others keeps its error", "[filter]") {
  UncertainLight light = even_light(3);
  light.light[at(20, 15)] = 300;
  const std::vector<float> left = left_of(light);
  CHECK(left[at(20, 15)] == Approx(deviation));
  CHECK(left[at(32, 15)] == Approx(deviation / 9));
}

TEST_CASE("a pixel that no rare path has reached gets its neighbours' error", "[filter]") {
  UncertainLight light = even_light(3);
  light.variance[at(20, 15)] = 0;
  CHECK(left_of(light)[at(20, 15)] > 0.9f * deviation / 9);
}
