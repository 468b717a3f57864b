#include "scenes/light/geometry/patches.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <vector>

using namespace luxodus;

namespace {

double area_of(const std::array<glm::dvec2, 3>& t) {
  const glm::dvec2 a = t[1] - t[0], b = t[2] - t[0];
  return 0.5 * (a.x * b.y - a.y * b.x);
}

/// Barycentric test in double, with a margin for points on an edge.
bool holds(const std::array<glm::dvec2, 3>& t, const glm::dvec2& p, double margin) {
  for (size_t i = 0; i < 3; ++i) {
    if (area_of({t[i], t[(i + 1) % 3], p}) < -margin) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("every sub-triangle's centre has that sub-triangle's index", "[geometry][patches]") {
  for (const uint32_t n : {1u, 2u, 3u, 4u, 7u, 16u, 33u, 100u}) {
    std::vector<int> met(n * n, 0);
    for (uint32_t k = 0; k < n * n; ++k) {
      const auto corner = sub_triangle_corners(k, n);
      const glm::dvec2 c = (corner[0] + corner[1] + corner[2]) / 3.0;
      const uint32_t found = sub_triangle(static_cast<float>(c.x), static_cast<float>(c.y), n);
      REQUIRE(found == k);
      ++met[found];
    }
    for (const int times : met) REQUIRE(times == 1);
  }
}

TEST_CASE("the largest subdivision keeps its indices within range at both ends",
          "[geometry][patches]") {
  const uint32_t n = limits::patch_subdivision;
  for (const uint32_t k : {0u, 1u, n, n * n / 2, n * n - 4, n * n - 3, n * n - 2, n * n - 1}) {
    const auto corner = sub_triangle_corners(k, n);
    CHECK(area_of(corner) * n * n == Approx(0.5).epsilon(1e-6));
    CHECK(corner[0].x + corner[0].y <= 1 + 1e-12);
  }
  CHECK(sub_triangle(1, 0, n) == n * n - 1);
}

TEST_CASE("sub-triangles have equal areas and the winding of the whole", "[geometry][patches]") {
  for (const uint32_t n : {1u, 2u, 5u, 24u}) {
    for (uint32_t k = 0; k < n * n; ++k) {
      REQUIRE(area_of(sub_triangle_corners(k, n)) == Approx(0.5 / (n * n)));
    }
  }
}

TEST_CASE("a point lies in the sub-triangle whose index it gets", "[geometry][patches]") {
  std::mt19937 random(20240311);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const uint32_t n : {1u, 2u, 3u, 10u, 77u, 1000u}) {
    for (int k = 0; k < 20'000; ++k) {
      float u = unit(random), v = unit(random);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const uint32_t index = sub_triangle(u, v, n);
      REQUIRE(index < n * n);
      // Float rounding of u n may move a point across an edge by 1e-7 of the whole triangle.
      REQUIRE(holds(sub_triangle_corners(index, n), {u, v}, 2e-7 / n));
    }
  }
}

TEST_CASE("random points fill sub-triangles evenly", "[geometry][patches]") {
  // Counts are binomial: chi-squared over n^2 - 1 degrees of freedom, within five standard errors.
  const uint32_t n = 9;
  const int points = 810'000;
  std::mt19937 random(77);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<double> count(n * n, 0.0);
  for (int k = 0; k < points; ++k) {
    float u = unit(random), v = unit(random);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    ++count[sub_triangle(u, v, n)];
  }
  const double expected = points / static_cast<double>(n * n);
  double chi_squared = 0;
  for (const double c : count) chi_squared += (c - expected) * (c - expected) / expected;
  const double freedom = n * n - 1;
  CHECK(std::abs(chi_squared - freedom) < 5 * std::sqrt(2 * freedom));
}

TEST_CASE("points on the edges and a little beyond get an index of the triangle",
          "[geometry][patches]") {
  const float eps = 1e-6f, nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  for (const uint32_t n : {1u, 2u, 3u, 8u, 333u, limits::patch_subdivision}) {
    for (const float u : {-eps, 0.0f, 0.25f, 0.5f, 1.0f - eps, 1.0f, 1.0f + eps, nan, inf, -inf}) {
      for (const float v : {-eps, 0.0f, 0.25f, 0.5f, 1 - u, 1 - u + eps, 1.0f, nan, inf, -inf}) {
        REQUIRE(sub_triangle(u, v, n) < n * n);
      }
    }
    CHECK(sub_triangle(0, 0, n) == 0);
    CHECK(sub_triangle(1, 0, n) == n * n - 1);
    CHECK(sub_triangle(0, 1, n) == 2 * n - 2);
  }
}

TEST_CASE("subdivision keeps patch edges within the requested length, and rounding adds none",
          "[geometry][patches]") {
  CHECK(subdivision_for(5, 0) == 1);
  CHECK(subdivision_for(5, -1) == 1);
  CHECK(subdivision_for(0.1, 1) == 1);
  CHECK(subdivision_for(1, 1) == 1);
  CHECK(subdivision_for(1.001, 1) == 2);
  CHECK(subdivision_for(0.9, 0.3) == 3);
  CHECK(subdivision_for(0.7, 0.1) == 7);
  CHECK(subdivision_for(1e9, 1e-3) == limits::patch_subdivision);
  CHECK(subdivision_for(std::numeric_limits<double>::quiet_NaN(), 1) == 1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> edge(0.01, 30);
  for (int k = 0; k < 1000; ++k) {
    const double longest = edge(random), patch = edge(random) / 10;
    REQUIRE(longest / subdivision_for(longest, patch) <= patch * (1 + 1e-8));
  }
}
