#include "scenes/light/geometry/partition.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "scenes/light/geometry/mesh.hpp"

using namespace luxodus;
using Cells = std::vector<std::vector<uint32_t>>;

namespace {

std::vector<glm::dvec3> random_points(size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(0, 10);
  std::vector<glm::dvec3> points;
  for (size_t i = 0; i < count; ++i) {
    const double x = along(random), y = along(random), z = along(random);
    points.push_back({x, y / 4, z / 10});
  }
  return points;
}

bool each_once(const Cells& cells, size_t count) {
  std::vector<int> met(count, 0);
  for (const auto& cell : cells) {
    if (cell.empty() || !std::is_sorted(cell.begin(), cell.end())) return false;
    for (const uint32_t i : cell) ++met[i];
  }
  return std::all_of(met.begin(), met.end(), [](int times) { return times == 1; });
}

}  // namespace

TEST_CASE("there are as many cells as requested or as triangles, none empty, each triangle in one",
          "[geometry][partition]") {
  for (const size_t count : {1u, 2u, 7u, 100u, 1000u}) {
    const auto points = random_points(count, 3);
    for (const int cells : {-1, 0, 1, 2, 3, 5, 16, 100, 5000}) {
      const Cells parts = partition_triangles(points, cells);
      const size_t wanted = std::min(count, static_cast<size_t>(std::max(cells, 1)));
      CHECK(parts.size() == wanted);
      CHECK(each_once(parts, count));
    }
  }
  CHECK(partition_triangles({}, 4).empty());
}

TEST_CASE("cells are of nearly equal size", "[geometry][partition]") {
  for (const int cells : {2, 3, 8, 13}) {
    const Cells parts = partition_triangles(random_points(10'000, 4), cells);
    for (const auto& cell : parts) {
      CHECK(static_cast<double>(cell.size()) == Approx(10'000.0 / cells).margin(6));
    }
  }
}

TEST_CASE("two cells lie on either side of a cut across the longest axis",
          "[geometry][partition]") {
  const auto points = random_points(501, 6);
  const Cells parts = partition_triangles(points, 2);
  double low = -1e300, high = 1e300;
  for (const uint32_t i : parts[0]) low = std::max(low, points[i].x);
  for (const uint32_t i : parts[1]) high = std::min(high, points[i].x);
  CHECK(low < high);
}

TEST_CASE("ties go by index, lower first", "[geometry][partition]") {
  const std::vector<glm::dvec3> same(10, glm::dvec3(1, 2, 3));
  const Cells parts = partition_triangles(same, 3);
  CHECK(parts == Cells{{0, 1, 2}, {3, 4, 5}, {6, 7, 8, 9}});
}

TEST_CASE("cells are compact: together their boxes fill far less than those of random cells",
          "[geometry][partition]") {
  const auto points = random_points(4096, 8);
  double volume = 0;
  const Cells parts = partition_triangles(points, 64);
  for (const auto& cell : parts) {
    Bounds bounds;
    for (const uint32_t i : cell) bounds.extend(points[i]);
    const glm::dvec3 side = bounds.high - bounds.low;
    volume += side.x * side.y * side.z;
  }
  // Boxes of disjoint cells cannot exceed the whole; random cells would fill it almost 64 times.
  CHECK(volume < 10 * 2.5 * 1.0);
}

TEST_CASE("the partition depends on positions, not on how often it is asked",
          "[geometry][partition]") {
  const auto points = random_points(3000, 9);
  const Cells first = partition_triangles(points, 17);
  CHECK(partition_triangles(points, 17) == first);
  // Adding a constant that floats hold exactly changes nothing.
  auto moved = points;
  for (auto& p : moved) p = 4.0 * p;
  CHECK(partition_triangles(moved, 17) == first);
}
