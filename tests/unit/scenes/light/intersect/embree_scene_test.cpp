#include "scenes/light/intersect/embree_scene.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/partition.hpp"
#include "tests/kit/replay_rays.hpp"

using namespace luxodus;

namespace {

void add_triangle(GeometryCell& cell, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  TriangleRecord r{};
  r.corner[0] = a;
  r.corner[1] = b;
  r.corner[2] = c;
  r.normal = glm::normalize(glm::cross(b - a, c - a));
  r.subdivision = 1;
  r.global_triangle = static_cast<uint32_t>(cell.triangles.size());
  cell.triangles.push_back(r);
}

/// A closed box of side 2 about the origin, rotated so that no shared edge runs along an axis; each
/// face has n x n squares of two triangles.
GeometryCell closed_box(int n) {
  GeometryCell cell;
  const glm::vec3 x = glm::normalize(glm::vec3(1, 0.3f, 0.2f));
  const glm::vec3 y = glm::normalize(glm::cross(glm::vec3(0.1f, 0.2f, 1), x));
  const glm::mat3 turn(x, y, glm::cross(x, y));
  const auto grid = [n](int i) { return -1 + 2 * static_cast<float>(i) / static_cast<float>(n); };
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto at = [&](int i, int j) {
        glm::vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = grid(i);
        p[(axis + 2) % 3] = grid(j);
        return turn * p;
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          add_triangle(cell, at(i, j), at(i + 1, j), at(i + 1, j + 1));
          add_triangle(cell, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  return cell;
}

glm::vec3 any_direction(Random& random) {
  const float z = 2 * random.uniform() - 1;
  const float phi = 2 * std::numbers::pi_v<float> * random.uniform();
  const float r = std::sqrt(1 - z * z);
  return glm::normalize(glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
}

glm::vec3 any_point(Random& random, float reach) {
  const float x = random.uniform();
  const float y = random.uniform();
  const float z = random.uniform();
  return reach * (2.0f * glm::vec3(x, y, z) - 1.0f);
}

/// The cell cut into parts, with the search structures over them.
struct Partition {
  std::vector<GeometryCell> cells;
  std::vector<std::unique_ptr<CellScene>> scenes;
  std::unique_ptr<ProxyScene> proxies;

  Partition(const EmbreeDevice& device, const GeometryCell& whole, int parts) {
    std::vector<glm::dvec3> centroids;
    for (const TriangleRecord& t : whole.triangles) {
      centroids.push_back(glm::dvec3(t.corner[0] + t.corner[1] + t.corner[2]) / 3.0);
    }
    std::vector<ProxyScene::Box> boxes;
    for (const auto& members : partition_triangles(centroids, parts)) {
      GeometryCell& cell = cells.emplace_back();
      cell.low = glm::vec3(1e30f);
      cell.high = -cell.low;
      for (const uint32_t m : members) {
        cell.triangles.push_back(whole.triangles[m]);
        for (const glm::vec3& c : whole.triangles[m].corner) {
          cell.low = glm::min(cell.low, c);
          cell.high = glm::max(cell.high, c);
        }
      }
      boxes.push_back({cell.low, cell.high});
    }
    for (const GeometryCell& cell : cells)
      scenes.push_back(std::make_unique<CellScene>(device, cell));
    proxies = std::make_unique<ProxyScene>(device, boxes);
  }
  Hit nearest(const Ray& ray, std::vector<Candidate>& scratch) const {
    return nearest_in_cells(*proxies, ray, scratch,
                            [&](const Candidate& c) { return scenes[c.cell].get(); });
  }
};

}  // namespace

TEST_CASE("the nearest triangle is found from both of its sides, at the right distance and place",
          "[intersect]") {
  GeometryCell cell;
  add_triangle(cell, {0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  add_triangle(cell, {0, 0, 3}, {4, 0, 3}, {0, 4, 3});
  const EmbreeDevice device;
  const CellScene scene(device, cell);
  const Hit up = scene.nearest({{1, 2, 0}, {0, 0, 1}});
  REQUIRE(up.found());
  CHECK(up.index == 0);
  CHECK(up.distance == Approx(1));
  CHECK(up.u == Approx(0.25));
  CHECK(up.v == Approx(0.5));
  CHECK(up.cell == &cell);
  CHECK(glm::distance(up.triangle->at(up.u, up.v), glm::vec3(1, 2, 1)) < 1e-6f);
  const Hit down = scene.nearest({{1, 2, 5}, {0, 0, -1}});
  REQUIRE(down.found());
  CHECK(down.index == 1);
  CHECK(down.distance == Approx(2));
  CHECK_FALSE(scene.nearest({{3, 3, 0}, {0, 0, 1}}).found());
}

TEST_CASE("a ray hits nothing beyond its length", "[intersect]") {
  GeometryCell cell;
  add_triangle(cell, {0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  const EmbreeDevice device;
  const CellScene scene(device, cell);
  const Ray shorter{{1, 1, 0}, {0, 0, 1}, 0.999f};
  const Ray longer{{1, 1, 0}, {0, 0, 1}, 1.001f};
  CHECK_FALSE(scene.nearest(shorter).found());
  CHECK_FALSE(scene.occluded(shorter));
  CHECK(scene.nearest(longer).found());
  CHECK(scene.occluded(longer));
}

TEST_CASE("nothing hits a cell without triangles", "[intersect]") {
  const GeometryCell cell;
  const EmbreeDevice device;
  const CellScene scene(device, cell);
  Random random(1, RandomStream::test);
  random.start(0);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 origin = any_point(random, 1);
    const Ray ray{origin, any_direction(random)};
    CHECK_FALSE(scene.nearest(ray).found());
    CHECK_FALSE(scene.occluded(ray));
  }
}

TEST_CASE("a closed box lets none of a million rays out through its shared edges", "[intersect]") {
  const GeometryCell cell = closed_box(20);
  const EmbreeDevice device;
  const CellScene scene(device, cell);
  Random random(2, RandomStream::test);
  int escaped = 0;
  for (uint64_t i = 0; i < 1'000'000; ++i) {
    random.start(i);
    const glm::vec3 origin = any_point(random, 0.5f);
    glm::vec3 direction = any_direction(random);
    if (i % 2 == 0) {
      // Aimed at the middle of an edge shared by two triangles, or a hundredth of a millimetre past
      // a corner.
      const TriangleRecord& t = cell.triangles[random.bits() % cell.triangles.size()];
      const uint32_t k = random.bits() % 3;
      const bool middle = random.bits() % 2 == 0;
      const glm::vec3 other = middle ? t.corner[(k + 1) % 3] : t.corner[k];
      const glm::vec3 past = middle ? glm::vec3(0) : 1e-5f * any_direction(random);
      direction = glm::normalize(0.5f * (t.corner[k] + other) + past - origin);
    }
    escaped += scene.nearest({origin, direction}).found() ? 0 : 1;
  }
  CHECK(escaped == 0);
}

TEST_CASE(
    "a partitioned scene gives the same hits as the merged one, except for ties on shared edges",
    "[intersect]") {
  const GeometryCell whole = closed_box(12);
  const EmbreeDevice device;
  const CellScene merged(device, whole);
  for (const int parts : {2, 7, 40}) {
    const Partition partition(device, whole, parts);
    REQUIRE(partition.cells.size() == static_cast<size_t>(parts));
    std::vector<Candidate> scratch;
    Random random(3, RandomStream::test);
    int other_triangle = 0;
    float farthest = 0;
    constexpr int rays = 100'000;
    for (uint64_t i = 0; i < rays; ++i) {
      random.start(i);
      const glm::vec3 origin = any_point(random, 2);  // some origins are outside
      const Ray ray{origin, any_direction(random)};
      const Hit a = merged.nearest(ray);
      const Hit b = partition.nearest(ray, scratch);
      REQUIRE(a.found() == b.found());
      if (!a.found()) continue;
      if (a.triangle->global_triangle != b.triangle->global_triangle) ++other_triangle;
      farthest = std::max(farthest, std::abs(a.distance - b.distance));
    }
    CHECK(other_triangle <= rays / 10'000);
    CHECK(farthest < 1e-5f);
  }
}

TEST_CASE("at equal distance in two cells, the triangle with the smaller number wins",
          "[intersect]") {
  GeometryCell low, high;
  add_triangle(low, {0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  add_triangle(high, {0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  low.triangles[0].global_triangle = 3;
  high.triangles[0].global_triangle = 8;
  const EmbreeDevice device;
  const CellScene a(device, low), b(device, high);
  const ProxyScene::Box box{{0, 0, 1}, {4, 4, 1}};
  const ProxyScene proxies(device, {box, box});
  std::vector<Candidate> scratch;
  const Ray ray{{1, 1, 0}, {0, 0, 1}};
  for (const bool swapped : {false, true}) {
    const Hit hit = nearest_in_cells(proxies, ray, scratch, [&](const Candidate& c) {
      return (c.cell == 0) != swapped ? &a : &b;
    });
    REQUIRE(hit.found());
    CHECK(hit.triangle->global_triangle == 3);
  }
}

TEST_CASE("the device counts the bytes that scenes hold, and their release", "[intersect]") {
  const EmbreeDevice device;
  const int64_t before = device.bytes();
  const GeometryCell cell = closed_box(40);
  {
    const CellScene scene(device, cell);
    CHECK(device.bytes() - before > static_cast<int64_t>(36 * cell.triangles.size()));
  }
  CHECK(device.bytes() == before);
}

TEST_CASE("replayed rays hit the same triangles as rays cast one by one", "[intersect]") {
  const GeometryCell cell = closed_box(5);
  const EmbreeDevice device;
  const CellScene scene(device, cell);
  Random random(4, RandomStream::test);
  random.start(0);
  std::vector<Ray> rays;
  uint64_t sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 origin = any_point(random, 2);
    rays.push_back({origin, any_direction(random)});
    const Hit hit = scene.nearest(rays.back());
    if (hit.found()) sum += hit.index;
  }
  CHECK(test::replay_rays(scene, rays) == sum);
}
