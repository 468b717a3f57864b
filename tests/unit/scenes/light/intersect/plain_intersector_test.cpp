#include "scenes/light/intersect/plain_intersector.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/intersect/embree_scene.hpp"

using namespace luxodus;

namespace {

TriangleRecord triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                        uint32_t number = 0) {
  TriangleRecord r{};
  r.corner[0] = a;
  r.corner[1] = b;
  r.corner[2] = c;
  r.normal = glm::normalize(glm::cross(b - a, c - a));
  r.subdivision = 1;
  r.global_triangle = number;
  return r;
}

/// A closed ball of 2 n n triangles about the origin, with irregularly placed corners.
std::vector<TriangleRecord> ball(int n) {
  const auto at = [n](int i, int j) {
    const double polar = std::numbers::pi * i / n;
    const double azimuth = 2 * std::numbers::pi * (j % n) / n + 0.1;
    const double ring = i == 0 || i == n ? 0 : std::sin(polar);
    return glm::vec3(ring * std::cos(azimuth), ring * std::sin(azimuth), std::cos(polar));
  };
  std::vector<TriangleRecord> out;
  const auto number = [&] { return static_cast<uint32_t>(out.size()); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (i > 0) out.push_back(triangle(at(i, j), at(i + 1, j), at(i, j + 1), number()));
      if (i < n - 1)
        out.push_back(triangle(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1), number()));
    }
  }
  return out;
}

glm::dvec3 plain_direction(Random& random) {
  const double z = 2 * random.uniform_double() - 1;
  const double phi = 2 * std::numbers::pi * random.uniform_double();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

glm::dvec3 plain_point(Random& random, double reach) {
  const double x = random.uniform_double();
  const double y = random.uniform_double();
  const double z = random.uniform_double();
  return reach * (2.0 * glm::dvec3(x, y, z) - 1.0);
}

template <class T>
PlainRay<T> ray(const glm::dvec3& origin, const glm::dvec3& direction) {
  return {glm::vec<3, T>(origin), glm::vec<3, T>(direction)};
}

}  // namespace

TEMPLATE_TEST_CASE("a triangle is met from both sides at its distance and place, in any precision",
                   "[intersect][plain]", float, double) {
  const std::vector<TriangleRecord> two = {triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1}),
                                           triangle({0, 0, 3}, {4, 0, 3}, {0, 4, 3})};
  const auto up = plain_nearest<TestType>(two, ray<TestType>({1, 2, 0}, {0, 0, 1}));
  CHECK(up.index == 0);
  CHECK(up.distance == Approx(1));
  CHECK(up.u == Approx(0.25));
  CHECK(up.v == Approx(0.5));
  const auto down = plain_nearest<TestType>(two, ray<TestType>({1, 2, 5}, {0, 0, -1}));
  CHECK(down.index == 1);
  CHECK(down.distance == Approx(2));
  CHECK(plain_nearest<TestType>(two, ray<TestType>({3, 3, 0}, {0, 0, 1})).index == no_triangle);
  CHECK(plain_nearest<TestType>(two, ray<TestType>({1, 1, 0}, {0, 1, 0})).index == no_triangle);
}

TEST_CASE("a plain ray hits nothing beyond its length, and nothing at its start",
          "[intersect][plain]") {
  const std::vector<TriangleRecord> one = {triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1})};
  PlainRay<double> at = ray<double>({1, 1, 0}, {0, 0, 1});
  at.length = 1 - 1e-15;
  CHECK(plain_nearest<double>(one, at).index == no_triangle);
  CHECK_FALSE(plain_occluded<double>(one, at));
  at.length = 1;
  CHECK(plain_nearest<double>(one, at).index == 0);
  CHECK_FALSE(plain_occluded<double>(one, at));
  at.length = 1 + 1e-15;
  CHECK(plain_occluded<double>(one, at));
  CHECK(plain_nearest<double>(one, ray<double>({1, 1, 1}, {0, 0, 1})).index == no_triangle);
}

TEST_CASE("at equal distance the triangle with the smaller number wins, in any order",
          "[intersect][plain]") {
  const auto with = [](uint32_t first, uint32_t second) {
    return std::vector<TriangleRecord>{triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1}, first),
                                       triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1}, second)};
  };
  const auto up = ray<double>({1, 1, 0}, {0, 0, 1});
  CHECK(plain_nearest<double>(with(3, 8), up).index == 0);
  CHECK(plain_nearest<double>(with(8, 3), up).index == 1);
}

TEMPLATE_TEST_CASE("a closed ball lets no ray out through its shared edges, in any precision",
                   "[intersect][plain]", float, double) {
  const std::vector<TriangleRecord> triangles = ball(10);
  Random random(2, RandomStream::test);
  int escaped = 0;
  for (uint64_t i = 0; i < 40'000; ++i) {
    random.start(i);
    const glm::dvec3 origin = plain_point(random, 0.4);
    glm::dvec3 direction = plain_direction(random);
    if (i % 4 !=
        0) {  // aimed at an edge, at its middle or anywhere but at its ends to the last bit
      const TriangleRecord& t = triangles[random.bits() % triangles.size()];
      const uint32_t k = random.bits() % 3;
      const double share = i % 4 == 1 ? 0.5 : 0.01 + 0.98 * random.uniform_double();
      const glm::dvec3 other(t.corner[(k + 1) % 3]);
      direction = glm::normalize(glm::mix(glm::dvec3(t.corner[k]), other, share) - origin);
    }
    const auto hit = plain_nearest<TestType>(triangles, ray<TestType>(origin, direction));
    escaped += hit.index == no_triangle ? 1 : 0;
  }
  CHECK(escaped == 0);
}

TEMPLATE_TEST_CASE("boxes of groups change no hit, whether rays run along axes or not",
                   "[intersect][plain]", float, double) {
  std::vector<TriangleRecord> triangles = ball(9);  // 144, and one more below
  triangles.push_back(triangle({-2, -2, -1.5f}, {2, -2, -1.5f}, {0, 2, -1.5f}, 144));
  const std::vector<PlainBox> boxes = plain_boxes(triangles);
  CHECK(boxes.size() == (triangles.size() + plain_group - 1) / plain_group);
  Random random(4, RandomStream::test);
  int wrong = 0, hits = 0;
  for (uint64_t i = 0; i < 20'000; ++i) {
    random.start(i);
    glm::dvec3 origin = plain_point(random, 2);
    glm::dvec3 direction = plain_direction(random);
    if (i % 3 == 1) {  // from a corner's height, along an axis
      const glm::dvec3 corner(triangles[random.bits() % triangles.size()].corner[0]);
      origin = {corner.x, corner.y, origin.z};
      direction = {0, 0, origin.z > 0 ? -1 : 1};
    }
    auto line = ray<TestType>(origin, direction);
    if (i % 2 == 1) line.length = static_cast<TestType>(random.uniform_double() * 2);
    const auto all = plain_nearest<TestType>(triangles, line);
    const auto some = plain_nearest<TestType>(triangles, line, boxes);
    const bool same = all.index == some.index && all.distance == some.distance &&
                      plain_occluded<TestType>(triangles, line) ==
                          plain_occluded<TestType>(triangles, line, boxes);
    wrong += same ? 0 : 1;
    hits += all.index != no_triangle ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(hits > 5000);
}

TEST_CASE("the double-precision intersector agrees with Embree within rounding",
          "[intersect][plain]") {
  GeometryCell cell;
  cell.triangles = ball(16);
  const EmbreeDevice device;
  const CellScene scene(device, cell);
  Random random(3, RandomStream::test);
  int other_triangle = 0;
  double farthest = 0, farthest_place = 0;
  for (uint64_t i = 0; i < 50'000; ++i) {
    random.start(i);
    const glm::vec3 origin(plain_point(random, 1.5));  // some origins are outside
    const glm::vec3 direction(plain_direction(random));
    const auto exact = plain_nearest<double>(cell.triangles, {origin, direction});
    const Hit hit = scene.nearest({origin, direction});
    if (hit.found() != (exact.index != no_triangle)) {  // the ray just passes a silhouette
      ++other_triangle;
      continue;
    }
    CHECK(scene.occluded({origin, direction}) ==
          plain_occluded<double>(cell.triangles, {origin, direction}));
    if (!hit.found()) continue;
    if (hit.index != exact.index) {
      ++other_triangle;
      continue;
    }
    farthest = std::max(farthest, std::abs(static_cast<double>(hit.distance) - exact.distance));
    const glm::dvec3 there = glm::dvec3(origin) + glm::dvec3(direction) * exact.distance;
    const TriangleRecord& t = cell.triangles[exact.index];
    const glm::dvec3 here = (1 - exact.u - exact.v) * glm::dvec3(t.corner[0]) +
                            exact.u * glm::dvec3(t.corner[1]) + exact.v * glm::dvec3(t.corner[2]);
    farthest_place = std::max(farthest_place, glm::distance(here, there));
  }
  CHECK(other_triangle <= 5);
  CHECK(farthest < 2e-5);  // at grazing incidence; typically 1e-7
  CHECK(farthest_place < 1e-11);
}
