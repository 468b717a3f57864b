#include "scenes/light/transport/detectors.hpp"

#include <bit>
#include <cstring>

namespace luxodus {

namespace {

Real length_in_sphere(const Vec3& centre, Real radius, const FlightPiece& piece) {
  // From the distance of closest approach, so that nothing cancels for small spheres far away.
  const Vec3 to_centre = centre - piece.origin;
  const Real along = glm::dot(to_centre, piece.direction);
  const Vec3 offset = to_centre - piece.direction * along;
  const Real half_square = radius * radius - glm::dot(offset, offset);
  if (half_square <= 0) return 0;
  const Real half = std::sqrt(half_square);
  const Real first = std::max(0.0_r, along - half);
  const Real last = std::min(piece.length, along + half);
  return std::max(0.0_r, last - first);
}

}  // namespace

Real length_inside(const CompiledVolumeGroup& group, const FlightPiece& piece) {
  using GroupShape = VolumeGroupMeasure::Shape;
  switch (group.shape) {
    case GroupShape::layer: {
      const Real inverse = finite_inverse(piece.direction.z);
      const Real t0 = (group.low.z - piece.origin.z) * inverse;
      const Real t1 = (group.high.z - piece.origin.z) * inverse;
      const Real first = std::max(std::min(t0, t1), 0.0_r);
      const Real last = std::min(std::max(t0, t1), piece.length);
      return std::max(0.0_r, last - first);
    }
    case GroupShape::box: {
      const BoxSegment segment = segment_in_box(group.low, group.high, piece);
      return std::max(0.0_r, segment.last - segment.first);
    }
    case GroupShape::sphere:
      return length_in_sphere(group.centre, group.radius, piece);
    case GroupShape::shell:
      return length_in_sphere(group.centre, group.radius, piece) -
             length_in_sphere(group.centre, group.inner_radius, piece);
  }
  return 0;
}

bool inside(const CompiledVolumeGroup& group, const Vec3& p) {
  using GroupShape = VolumeGroupMeasure::Shape;
  if (group.shape == GroupShape::box || group.shape == GroupShape::layer) {
    return glm::all(glm::greaterThanEqual(p, group.low)) && glm::all(glm::lessThan(p, group.high));
  }
  const Vec3 d = p - group.centre;
  const Real r2 = glm::dot(d, d);
  const Real inner = group.shape == GroupShape::shell ? group.inner_radius : 0;
  return r2 < group.radius * group.radius && r2 >= inner * inner;
}

uint32_t crossed_cell(const CompiledPlane& plane, const FlightPiece& piece, Real t) {
  const Vec3 p = piece.origin + piece.direction * t - plane.corner;
  const Real u = glm::dot(p, plane.dual_u);
  const Real v = glm::dot(p, plane.dual_v);
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return none_index;
  const int i = std::min(static_cast<int>(u * static_cast<Real>(plane.cells_u)), plane.cells_u - 1);
  const int j = std::min(static_cast<int>(v * static_cast<Real>(plane.cells_v)), plane.cells_v - 1);
  return plane.first_bin + static_cast<uint32_t>(j * plane.cells_u + i);
}

void score_crossing(const CompiledScene& scene, size_t index, const FlightPiece& piece,
                    const Approach& approach, BatchScores& batch) {
  const size_t planes = scene.planes.size();
  const bool counting = index >= planes;
  const bool along = approach.cosine > 0;
  if (!counting && along) return;  // illuminance counts light on the front only
  const CompiledPlane& plane =
      counting ? scene.counting_planes[index - planes] : scene.planes[index];
  const uint32_t cell = crossed_cell(plane, piece, approach.height / approach.cosine);
  if (cell == none_index) return;
  const TallyLayout& layout = scene.layout;
  const int64_t at =
      counting
          ? layout.score_index(scene.blocks.counting, static_cast<uint32_t>(index - planes),
                               piece.band, (along ? 0u : 2u) + (piece.collided ? 1u : 0u))
          : layout.score_index(scene.blocks.plane_cells, cell, piece.band, piece.direct ? 0 : 1);
  batch.scores.data()[at] += static_cast<int64_t>(piece.weight);
}

void score_volumes(const CompiledScene& scene, const FlightPiece& piece, BatchScores& batch) {
  // Along an unbounded layer light may fly as long as single precision resolves heights, 1e9 m and
  // more, and the scores of a batch would exceed 63 bits. What lies beyond does not count.
  const auto longest = static_cast<Real>(1024 * scene.length_unit_m);
  for (uint32_t i = 0; i < scene.volume_groups.size(); ++i) {
    const Real length = std::min(length_inside(scene.volume_groups[i], piece), longest);
    if (length <= 0) continue;
    const auto at = scene.layout.score_index(scene.blocks.volume_length, i, piece.band, 0);
    batch.scores.data()[at] += length_score(scene, piece.weight, length);
  }
}

namespace {

/// A double below 2^51 in magnitude rounded to an integer, in two instructions instead of a call:
/// adding 1.5 * 2^52 leaves the integer in the lowest bits.
int64_t nearest_integer(double x) {
  constexpr double magic = 0x1.8p52;
  return std::bit_cast<int64_t>(x + magic) - std::bit_cast<int64_t>(magic);
}

/// Four scores of a voxel in one register.
using FourScores [[gnu::vector_size(32)]] = int64_t;

}  // namespace

void score_voxels(const CompiledScene& scene, const FlightPiece& piece, BatchScores& batch) {
  const VoxelPoints points = points_in_grid(scene.voxels, piece);
  // Fluence and its three components along the axes, for one point.
  const double length =
      to_double(piece.weight) * (static_cast<double>(points.length) * scene.scores_per_metre);
  const glm::dvec3 along = length * glm::dvec3(piece.direction);
  const FourScores share = {nearest_integer(length), nearest_integer(along.x),
                            nearest_integer(along.y), nearest_integer(along.z)};
  int64_t* scores =
      batch.scores.data() + scene.layout.score_index(scene.blocks.voxels, 0, piece.band, 0);
  const auto stride =
      static_cast<size_t>(voxel_quantities) * static_cast<size_t>(scene.bands.count());
  const auto add = [](const FourScores& four, int64_t* score) {
    FourScores sum;
    std::memcpy(&sum, score, sizeof sum);
    sum += four;
    std::memcpy(score, &sum, sizeof sum);
  };
  if (!piece.scattered) {
    for_each_voxel_point(scene.voxels, points,
                         [&](uint32_t voxel) { add(share, scores + voxel * stride); });
    return;
  }
  const glm::dvec3 d(piece.direction);
  const FourScores products = {nearest_integer(along.x * d.x), nearest_integer(along.y * d.y),
                               nearest_integer(along.x * d.y), nearest_integer(along.x * d.z)};
  const int64_t last_product = nearest_integer(along.y * d.z);
  for_each_voxel_point(scene.voxels, points, [&](uint32_t voxel) {
    int64_t* score = scores + voxel * stride;
    add(share, score);
    score += first_scattered_quantity;
    add(share, score);
    add(products, score + 4);
    score[8] += last_product;
  });
}

void score_collision(const CompiledScene& scene, const Vec3& place, int band, uint32_t medium,
                     Weight absorbed, Weight scattered, BatchScores& batch) {
  const auto add = [&](uint32_t block, uint32_t bin) {
    int64_t* score = batch.scores.data() + scene.layout.score_index(block, bin, band, 0);
    score[0] += static_cast<int64_t>(absorbed);
    score[1] += static_cast<int64_t>(scattered);
  };
  add(scene.blocks.media_power, medium);
  for (uint32_t i = 0; i < scene.volume_groups.size(); ++i) {
    if (inside(scene.volume_groups[i], place)) add(scene.blocks.volume_power, i);
  }
  if (scene.voxels.edge > 0) {
    const uint32_t voxel = voxel_of(scene.voxels, place);
    if (voxel != none_index) add(scene.blocks.voxel_power, voxel);
  }
}

}  // namespace luxodus
