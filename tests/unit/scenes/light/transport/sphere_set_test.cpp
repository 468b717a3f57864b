// Spheres near a line, compared with a test of each sphere by itself.
#include "scenes/light/transport/sphere_set.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace luxodus {

namespace {

/// Distance of the centre from the first `end` of the ray, in double.
double distance_to(const Vec3& centre, const Ray& ray, double end) {
  const glm::dvec3 o(ray.origin), d(ray.direction), c(centre);
  const double t = std::clamp(glm::dot(c - o, d), 0.0, end);
  return glm::length(c - o - d * t);
}

}  // namespace

TEST_CASE("spheres near a line are found in order, for any number of them", "[transport]") {
  const size_t count = GENERATE(0u, 1u, 63u, 64u, 65u, 200u);
  const auto end = GENERATE(2.0f, std::numeric_limits<float>::infinity());
  std::mt19937 numbers(static_cast<uint32_t>(count));
  std::uniform_real_distribution<float> anywhere(-5, 5), radius(0, 1);
  SphereSet set;
  std::vector<Vec3> centres;
  for (size_t i = 0; i < count; ++i) {
    centres.emplace_back(anywhere(numbers), anywhere(numbers), anywhere(numbers));
    set.add(centres.back(), radius(numbers));
  }
  for (int line = 0; line < 50; ++line) {
    const Vec3 towards(anywhere(numbers), anywhere(numbers), anywhere(numbers));
    const Ray ray{{anywhere(numbers), anywhere(numbers), 0}, glm::normalize(towards)};
    constexpr Real reach = 0.5_r;
    std::vector<uint32_t> found, expected;
    set.for_each_near(ray, end, reach, [&](uint32_t i, Real t, Real square) {
      found.push_back(i);
      const Vec3 there = ray.origin + ray.direction * t;
      CHECK(glm::dot(centres[i] - there, centres[i] - there) == Approx(square).margin(1e-4));
      CHECK(std::sqrt(square) == Approx(distance_to(centres[i], ray, double{end})).margin(1e-4));
    });
    bool sure = true;  // whether the result is beyond rounding
    for (uint32_t i = 0; i < count; ++i) {
      const double off = distance_to(centres[i], ray, double{end}) - double{reach + set.radius(i)};
      sure &= std::abs(off) > 1e-4;
      if (off < 0) expected.push_back(i);
    }
    if (sure) CHECK(found == expected);
  }
}

}  // namespace luxodus
