#include "scenes/light/transport/detectors.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <map>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

VoxelGrid small_grid() {
  VoxelGrid grid;
  grid.low = {-1, -2, 0.5f};
  grid.edge = 0.5f;
  grid.nx = 5;
  grid.ny = 7;
  grid.nz = 3;
  return grid;
}

FlightPiece piece_of(const glm::vec3& origin, const glm::vec3& direction, float length) {
  return {origin, direction, length, unit_weight, 0, true, false, false, 0.5f};
}

/// Length of a piece in a box, in double, by clipping axis by axis.
double clipped(const glm::dvec3& low, const glm::dvec3& high, const FlightPiece& piece) {
  double first = 0, last = static_cast<double>(piece.length);
  for (int a = 0; a < 3; ++a) {
    const double o = static_cast<double>(piece.origin[a]);
    const double d = static_cast<double>(piece.direction[a]);
    if (d == 0) {
      if (o < low[a] || o >= high[a]) return 0;
      continue;
    }
    const double t0 = (low[a] - o) / d, t1 = (high[a] - o) / d;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
  return std::max(0.0, last - first);
}

/// Mean length that sample points give to each voxel, over `starts` evenly spaced offsets.
std::map<uint32_t, double> mean_lengths(const VoxelGrid& grid, FlightPiece piece, int starts) {
  std::map<uint32_t, double> out;
  for (int i = 0; i < starts; ++i) {
    piece.chance = (static_cast<float>(i) + 0.5f) / static_cast<float>(starts);
    const VoxelPoints points = points_in_grid(grid, piece);
    CHECK(points.length <= grid.edge * voxel_point_spacing * 1.0001f);
    for_each_voxel_point(grid, points, [&](uint32_t voxel) {
      REQUIRE(voxel < grid.count());
      out[voxel] += static_cast<double>(points.length) / starts;
    });
  }
  return out;
}

/// The ends of a segment are resolved to half a spacing over the number of starts, plus rounding.
void check_against_clipping(const VoxelGrid& grid, const FlightPiece& piece) {
  constexpr int starts = 64;
  auto lengths = mean_lengths(grid, piece, starts);
  const double edge = static_cast<double>(grid.edge);
  for (uint32_t v = 0; v < grid.count(); ++v) {
    const auto nx = static_cast<uint32_t>(grid.nx), ny = static_cast<uint32_t>(grid.ny);
    const glm::dvec3 cell(v % nx, v / nx % ny, v / (nx * ny));
    const glm::dvec3 low = glm::dvec3(grid.low) + edge * cell;
    REQUIRE(lengths[v] == Approx(clipped(low, low + edge, piece)).margin(1.2 * edge / starts));
  }
}

}  // namespace

TEST_CASE("averaged over the offset of its points, every voxel gets the flight's length in it",
          "[transport][detectors]") {
  const VoxelGrid grid = small_grid();
  Random random(5, RandomStream::test);
  for (uint64_t i = 0; i < 2000; ++i) {
    random.start(i);
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    const float u = random.uniform(), v = random.uniform(), length = random.uniform();
    const glm::vec3 origin = glm::vec3(-2, -3, 0) + glm::vec3(4.5f, 5.5f, 3) * glm::vec3(x, y, z);
    check_against_clipping(grid, piece_of(origin, uniform_sphere(u, v), 6 * length));
  }
}

TEST_CASE("a flight along an axis stays in its row of voxels, and in a face in the row above it",
          "[transport][detectors]") {
  const VoxelGrid grid = small_grid();
  for (int a = 0; a < 3; ++a) {
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 direction(sign * 0.0f);  // zeros of either sign
      direction[a] = sign;
      check_against_clipping(grid, piece_of({0.1f, 0.2f, 1.1f}, direction, 10));
      check_against_clipping(grid, piece_of({0, 0.5f, 1}, direction, 0.7f));
      check_against_clipping(grid, piece_of({-1, -2, 0.5f}, direction, 10));
    }
  }
}

TEST_CASE("points of a flight from far outside are placed only where the voxels are",
          "[transport][detectors]") {
  const VoxelGrid grid = small_grid();
  const VoxelPoints points = points_in_grid(grid, piece_of({-1e3f, -1, 1}, {1, 0, 0}, 2e3f));
  CHECK(points.count <= 11);  // 2.5 m at a quarter of a metre
  CHECK(static_cast<float>(points.count) * points.length == Approx(2.5f).epsilon(1e-3));
  CHECK(points_in_grid(grid, piece_of({-1e6f, -1, 5}, {1, 0, 0}, 2e6f)).count == 0);
}

TEST_CASE("a flight much shorter than a voxel is one point that counts its whole length",
          "[transport][detectors]") {
  const VoxelGrid grid = small_grid();
  const VoxelPoints points = points_in_grid(grid, piece_of({0.1f, 0.1f, 1.1f}, {0, 1, 0}, 1e-3f));
  CHECK(points.count == 1);
  CHECK(points.length == Approx(1e-3f));
}

TEST_CASE("adjacent layers divide a flight without gap or overlap", "[transport][detectors]") {
  CompiledVolumeGroup below, above;
  below.low = {-1e30f, -1e30f, 0};
  below.high = above.low = glm::vec3(1e30f, 1e30f, 1);
  above.low.x = above.low.y = -1e30f;
  above.high = {1e30f, 1e30f, 2};
  const auto lengths = [&](const FlightPiece& piece) {
    return glm::vec2(length_inside(below, piece), length_inside(above, piece));
  };
  CHECK(lengths(piece_of({0, 0, 0}, {0, 0, 1}, 1.5f)) == glm::vec2(1, 0.5f));
  CHECK(lengths(piece_of({0, 0, 2}, {0, 0, -1}, 1.5f)) == glm::vec2(0.5f, 1));
  CHECK(lengths(piece_of({5, 6, 1}, {1, 0, 0}, 3)) == glm::vec2(0, 3));
  CHECK(lengths(piece_of({5, 6, 1}, {1, 0, -0.0f}, 3)) == glm::vec2(0, 3));
  CHECK(lengths(piece_of({5, 6, 2}, {0, 1, 0}, 3)) == glm::vec2(0, 0));
}

TEST_CASE("an endless flight along a layer leaves room for those of a whole batch",
          "[transport][detectors]") {
  CompiledScene scene;
  CompiledVolumeGroup& layer = scene.volume_groups.emplace_back();
  layer.low = glm::vec3(-1e30f, -1e30f, 0);
  layer.high = {1e30f, 1e30f, 1};
  scene.blocks.volume_length =
      scene.layout.add_block({"volume_length", 1, 1, ScoreUnit::weight_length});
  BatchScores batch;
  const auto score_of = [&](float length) {
    batch.reset(scene.layout);
    score_volumes(scene, piece_of({0, 0, 0.5f}, {1, 0, 0}, length), batch);
    return batch.scores[0];
  };
  CHECK(score_of(1000) == 1000 * static_cast<int64_t>(unit_weight));
  constexpr int64_t largest_batch = 1'000'000;  // the most that a scene file may request
  CHECK(score_of(1e9f) > 0);
  CHECK(score_of(1e9f) < std::numeric_limits<int64_t>::max() / largest_batch);
}

TEST_CASE("a plane's cell is scored only by flights that cross it", "[transport][detectors]") {
  CompiledPlane plane;  // the unit square in z = 0, in 4 x 2 cells from bin 10
  plane.cells_u = 4;
  plane.cells_v = 2;
  plane.first_bin = 10;
  const PlaneTest test{plane.normal, glm::dot(plane.normal, plane.corner)};
  float cosine = 0;
  const auto cell = [&](const glm::vec3& origin, const glm::vec3& direction, float length) {
    const FlightPiece piece = piece_of(origin, direction, length);
    const Approach a = approach(test, piece);
    cosine = a.cosine;
    return meets(a, length) ? crossed_cell(plane, piece, a.height / a.cosine) : none_index;
  };
  CHECK(cell({0.3f, 0.7f, 1}, {0, 0, -1}, 2) == 10 + 4 + 1);
  CHECK(cosine == -1);
  CHECK(cell({0.9f, 0.1f, -1}, {0, 0, 1}, 2) == 10 + 3);
  CHECK(cosine == 1);
  CHECK(cell({0.3f, 0.7f, 1}, {0, 0, -1}, 0.9f) == none_index);
  CHECK(cell({0.3f, 0.7f, 1}, {0, 0, 1}, 2) == none_index);
  CHECK(cell({1.3f, 0.7f, 1}, {0, 0, -1}, 2) == none_index);
  CHECK(cell({0.3f, 0.7f, 1}, {1, 0, 0}, 2) == none_index);
  CHECK(cell({-0.5f, 0.5f, 1}, {0.6f, 0, -0.8f}, 2) == 10 + 4 + 1);
}
