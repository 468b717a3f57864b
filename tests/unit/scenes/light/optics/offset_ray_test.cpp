#include "scenes/light/optics/offset_ray.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <numbers>

#include "runtime/core/random.hpp"
#include "tests/unit/scenes/light/optics/sampler_checks.hpp"

using namespace luxodus;
using namespace luxodus::checks;

namespace {

struct Triangle {
  std::array<glm::vec3, 3> corner;

  /// The exact normal of the float corners, in double.
  glm::dvec3 normal() const {
    const glm::dvec3 a(corner[0]), b(corner[1]), c(corner[2]);
    return glm::normalize(glm::cross(b - a, c - a));
  }
  glm::vec3 at(const glm::vec3& b) const {
    return corner[0] * b.x + corner[1] * b.y + corner[2] * b.z;
  }
  double height(const glm::vec3& p) const {
    return glm::dot(normal(), glm::dvec3(p) - glm::dvec3(corner[0]));
  }
};

/// A triangle of about `size` at `distance` from the origin. Every other one is tilted against a
/// coordinate plane by 1e-5 to 1, and every fifth has a coordinate close to zero: the hard cases
/// for an offset by coordinates.
Triangle any_triangle(Uniform& next, double distance, double size, int i) {
  const auto direction = [&] {
    const float u = next();
    const float v = next();
    return glm::dvec3(uniform_sphere(u, v));
  };
  glm::dvec3 centre = distance * direction();
  if (i % 5 == 0) centre[i / 5 % 3] *= std::pow(10.0, -6.0 * static_cast<double>(next()));
  glm::dvec3 normal = direction();
  if (i % 2 == 0) {
    const double tilt = std::pow(10.0, -5.0 * static_cast<double>(next()));
    const int axis = i / 2 % 3;
    const double steep = normal[axis] > 0 ? 1.0 : -1.0;
    normal *= tilt;
    normal[axis] = steep;
    normal = glm::normalize(normal);
  }
  const Basis plane = basis_around(glm::vec3(normal));
  const double turn = 2 * std::numbers::pi * static_cast<double>(next());
  Triangle out;
  for (int k = 0; k < 3; ++k) {
    const double angle = turn + k * 2.1;
    out.corner[static_cast<std::size_t>(k)] =
        glm::vec3(centre + size * (std::cos(angle) * glm::dvec3(plane.x) +
                                   std::sin(angle) * glm::dvec3(plane.y)));
  }
  return out;
}

/// Whether a ray hits a triangle at a positive distance, computed in float (edges, determinant).
bool meets(const Triangle& t, const glm::vec3& origin, const glm::vec3& direction) {
  const glm::vec3 e1 = t.corner[1] - t.corner[0];
  const glm::vec3 e2 = t.corner[2] - t.corner[0];
  const glm::vec3 p = glm::cross(direction, e2);
  const float det = glm::dot(e1, p);
  if (det == 0.0F) return false;
  const glm::vec3 s = origin - t.corner[0];
  const float u = glm::dot(s, p) / det;
  const glm::vec3 q = glm::cross(s, e1);
  const float v = glm::dot(direction, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 0;
}

}  // namespace

TEST_CASE("a ray offset from a triangle never hits it again, in scenes of 2e-3 to 2e5 m",
          "[optics][offset]") {
  const uint32_t seed = seed_or(31);
  INFO("seed " << seed);
  Uniform next(seed);
  for (double distance = 1e-3; distance < 1.5e5; distance *= 10) {
    int wrong_side = 0;
    int met_again = 0;
    double farthest = 0;
    for (int i = 0; i < 20000; ++i) {
      const double size = std::max(distance * (i % 4 < 2 ? 1.0 : 0.01), 1e-3);
      const Triangle t = any_triangle(next, distance, size, i);
      const float u = next();
      const float v = next();
      const glm::vec3 hit = t.at(uniform_triangle(u, v));
      const double side = next() < 0.5F ? 1.0 : -1.0;
      const glm::vec3 normal(side * t.normal());
      const glm::vec3 start = offset_ray(hit, normal, min_offset(static_cast<float>(2 * distance)));
      if (!(side * t.height(start) > 0)) ++wrong_side;
      farthest = std::max(farthest, glm::length(glm::dvec3(start) - glm::dvec3(hit)));
      const float u2 = next();
      const float v2 = next();
      const glm::vec3 away = to_world(normal, cosine_hemisphere(u2, v2));
      if (meets(t, start, away)) ++met_again;
    }
    CAPTURE(distance, farthest);
    CHECK(wrong_side == 0);
    CHECK(met_again == 0);
    CHECK(farthest < 3e-5 * distance);  // 80 ulps are 5 to 10 millionths of a coordinate
  }
}

TEST_CASE("a point near the origin of a triangle that reaches 50 m out is offset far enough",
          "[optics][offset]") {
  const uint32_t seed = seed_or(32);
  INFO("seed " << seed);
  Uniform next(seed);
  int wrong_side = 0;
  int met_again = 0;
  for (int i = 0; i < 50000; ++i) {
    const Triangle t = any_triangle(next, 0.01, 50.0, i);
    const float jitter = 0.01F * next();
    const glm::vec3 hit = t.at({1.0F / 3 + jitter, 1.0F / 3 - jitter, 1.0F / 3});
    const glm::vec3 normal(t.normal());
    const glm::vec3 start = offset_ray(hit, normal, min_offset(100));
    if (!(t.height(start) > 0)) ++wrong_side;
    const float u = next();
    const float v = next();
    if (meets(t, start, to_world(normal, cosine_hemisphere(u, v)))) ++met_again;
  }
  CHECK(wrong_side == 0);
  CHECK(met_again == 0);
}

TEST_CASE("an offset moves only along the normal's coordinates and stays under 1 mm within 100 m",
          "[optics][offset]") {
  CHECK(offset_ray({1, 2, 3}, {0, 0, 1}, min_offset(30)).x == 1.0F);
  CHECK(offset_ray({1, 2, 3}, {0, 0, 1}, min_offset(30)).y == 2.0F);
  CHECK(offset_ray({1, 2, 3}, {0, 0, 1}, min_offset(30)).z > 3.0F);
  CHECK(offset_ray({1, 2, 3}, {0, 0, -1}, min_offset(30)).z < 3.0F);
  CHECK(offset_ray({1, 2, -3}, {0, 0, 1}, min_offset(30)).z > -3.0F);
  CHECK(offset_ray({1, 2, -3}, {0, 0, -1}, min_offset(30)).z < -3.0F);
  CHECK(offset_ray({0, 0, 0}, {0, -1, 0}, 0x1p-16F).y == -0x1p-16F);
  CHECK(offset_ray({-0.0F, 0, 0}, {1, 0, 0}, 0x1p-16F).x == 0x1p-16F);
  for (const float x : {0.01F, 1.0F, 10.0F, 99.0F, -99.0F}) {
    CHECK(std::fabs(offset_ray({x, 0, 0}, {1, 0, 0}, min_offset(30)).x - x) < 1e-3F);
    CHECK(std::fabs(offset_ray({x, 0, 0}, {-1, 0, 0}, min_offset(30)).x - x) < 1e-3F);
  }
}

TEST_CASE("a coordinate a few steps from zero crosses it instead of wrapping around",
          "[optics][offset]") {
  for (const float x : {0x1p-149F, 0x1p-140F, -0x1p-149F, -0x1p-143F}) {
    for (const float n : {1.0F, -1.0F, 0.01F, -0.01F}) {
      const float moved = offset_coordinate(x, n, min_offset(30));
      CHECK(std::isfinite(moved));
      CHECK((moved - x) * n > 0.0F);
      CHECK(std::fabs(moved) < 1e-4F);
    }
  }
}

TEST_CASE("an offset in double is as large as in float, whatever the position's further digits",
          "[optics][offset]") {
  Random random(5, RandomStream::test);
  for (uint64_t i = 0; i < 20'000; ++i) {
    random.start(i);
    const double size = std::exp2(20 * random.uniform_double() - 10);
    const double position = size * (2 * random.uniform_double() - 1);
    const double normal = 2 * random.uniform_double() - 1;
    const double least = size * 0x1p-21;
    const auto single = static_cast<float>(position);
    const double moved_single =
        static_cast<double>(
            offset_coordinate(single, static_cast<float>(normal), static_cast<float>(least))) -
        static_cast<double>(single);
    const double moved = offset_coordinate(position, normal, least) - position;
    // Float's own result is rounded to an ulp of the position.
    const double ulp = std::max(std::fabs(position), least) * 0x1p-22;
    CHECK(std::fabs(moved - moved_single) <= ulp);
    CHECK(moved * normal >= 0);
  }
}
