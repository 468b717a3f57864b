#include "scenes/transport/detectors.hpp"

#include <bit>

namespace luxodus {

namespace {

float length_in_sphere(const glm::vec3& centre, float radius, const FlightPiece& piece) {
  // Distance of closest approach first, so that nothing cancels for small spheres far away.
  const glm::vec3 to_centre = centre - piece.origin;
  const float along = glm::dot(to_centre, piece.direction);
  const glm::vec3 offset = to_centre - piece.direction * along;
  const float half_square = radius * radius - glm::dot(offset, offset);
  if (half_square <= 0) return 0;
  const float half = std::sqrt(half_square);
  const float first = std::max(0.0f, along - half);
  const float last = std::min(piece.length, along + half);
  return std::max(0.0f, last - first);
}

}  // namespace

float length_inside(const CompiledVolumeGroup& group, const FlightPiece& piece,
                    const glm::vec3& inverse) {
  using Shape = VolumeGroupMeasure::Shape;
  switch (group.shape) {
    case Shape::box:
    case Shape::layer: {
      const BoxStretch stretch = stretch_in_box(group.low, group.high, inverse, piece);
      return std::max(0.0f, stretch.last - stretch.first);
    }
    case Shape::sphere:
      return length_in_sphere(group.centre, group.radius, piece);
    case Shape::shell:
      return length_in_sphere(group.centre, group.radius, piece) -
             length_in_sphere(group.centre, group.inner_radius, piece);
  }
  return 0;
}

bool inside(const CompiledVolumeGroup& group, const glm::vec3& p) {
  using Shape = VolumeGroupMeasure::Shape;
  if (group.shape == Shape::box || group.shape == Shape::layer) {
    return glm::all(glm::greaterThanEqual(p, group.low)) && glm::all(glm::lessThan(p, group.high));
  }
  const glm::vec3 d = p - group.centre;
  const float r2 = glm::dot(d, d);
  const float inner = group.shape == Shape::shell ? group.inner_radius : 0;
  return r2 < group.radius * group.radius && r2 >= inner * inner;
}

namespace {

/// Reach beyond a flight's end, as a share of the scene's size: a plane that lies in a wall or on a
/// floor is crossed by the flights that end there, whichever way their ends are rounded (a few ulps
/// of a coordinate). Less than offset_ray's step, and what comes back crosses from behind.
constexpr float reach_share = 0x1p-21f;

void score_planes(const CompiledScene& scene, FlightPiece piece, BatchScores& batch) {
  const TallyLayout& layout = scene.layout;
  piece.length += scene.diagonal_m * reach_share;
  const auto score = static_cast<int64_t>(piece.weight);
  float cosine = 0;
  for (const CompiledPlane& plane : scene.planes) {
    const uint32_t bin = crossed_cell(plane, piece, cosine);
    if (bin == none_index || cosine > 0) continue;  // illuminance counts what falls on the front
    const auto at =
        layout.score_index(scene.blocks.plane_cells, bin, piece.band, piece.direct ? 0 : 1);
    batch.scores[static_cast<size_t>(at)] += score;
  }
  for (uint32_t i = 0; i < scene.counting_planes.size(); ++i) {
    if (crossed_cell(scene.counting_planes[i], piece, cosine) == none_index) continue;
    const uint32_t quantity = (cosine > 0 ? 0u : 2u) + (piece.collided ? 1u : 0u);
    const auto at = layout.score_index(scene.blocks.counting, i, piece.band, quantity);
    batch.scores[static_cast<size_t>(at)] += score;
  }
}

void score_volumes(const CompiledScene& scene, const FlightPiece& piece, const glm::vec3& inverse,
                   BatchScores& batch) {
  for (uint32_t i = 0; i < scene.volume_groups.size(); ++i) {
    const float length = length_inside(scene.volume_groups[i], piece, inverse);
    if (length <= 0) continue;
    const int64_t score = length_score(scene, piece.weight, length);
    const auto at = scene.layout.score_index(scene.blocks.volume_length, i, piece.band, 0);
    batch.scores[static_cast<size_t>(at)] += score;
    batch.length_score_sum += static_cast<double>(score);
  }
}

/// A double below 2^51 in size as an integer, to nearest, in two instructions that also exist for
/// vectors: adding 1.5 * 2^52 leaves the integer in the lowest bits.
int64_t nearest_integer(double x) {
  constexpr double magic = 0x1.8p52;
  return std::bit_cast<int64_t>(x + magic) - std::bit_cast<int64_t>(magic);
}

void score_voxels(const CompiledScene& scene, const FlightPiece& piece, const glm::vec3& inverse,
                  BatchScores& batch) {
  const double per_metre = static_cast<double>(piece.weight) / scene.length_unit_m;
  const glm::dvec3 d = per_metre * glm::dvec3(piece.direction);
  const double rate[4] = {per_metre, d.x, d.y, d.z};
  int64_t* scores =
      batch.scores.data() + scene.layout.score_index(scene.blocks.voxels, 0, piece.band, 0);
  const auto stride = static_cast<size_t>(4 * scene.bands.count());
  const float inside =
      for_each_voxel(scene.voxels, piece, inverse, [&](uint32_t voxel, float length) {
        int64_t* score = scores + voxel * stride;
        for (int q = 0; q < 4; ++q)
          score[q] += nearest_integer(rate[q] * static_cast<double>(length));
      });
  batch.length_score_sum += per_metre * static_cast<double>(inside);
}

}  // namespace

void score_flight(const CompiledScene& scene, const FlightPiece& piece, BatchScores& batch) {
  score_planes(scene, piece, batch);
  const glm::vec3 inverse = finite_inverse(piece.direction);
  score_volumes(scene, piece, inverse, batch);
  if (scene.voxels.edge > 0) score_voxels(scene, piece, inverse, batch);
}

void score_collision(const CompiledScene& scene, const glm::vec3& place, int band, uint32_t medium,
                     Weight absorbed, Weight scattered, BatchScores& batch) {
  const auto add = [&](uint32_t block, uint32_t bin) {
    int64_t* score =
        &batch.scores[static_cast<size_t>(scene.layout.score_index(block, bin, band, 0))];
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
