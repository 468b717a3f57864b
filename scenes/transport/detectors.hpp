// What a flight passes on its way: planes and probes never stop light, so they are scored here,
// together with voxels and volume groups. All work is on one straight piece of a path, from
// `origin` for `length`. Pure functions on a batch's scores; one thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "scenes/optics/sampling.hpp"
#include "scenes/tally/totals.hpp"
#include "scenes/transport/compiled_scene.hpp"

namespace luxodus {

/// A straight piece of a history.
struct FlightPiece {
  glm::vec3 origin;
  glm::vec3 direction;
  float length;
  Weight weight;
  int band;
  bool direct;    // not scattered or reflected yet (glass panes passed straight do not count)
  bool collided;  // has collided with a medium
};

/// Fixed-point score of weight times length; rounded to nearest, one part in 2^32 of the scene's
/// size.
inline int64_t length_score(const CompiledScene& scene, Weight weight, double length_m) {
  return static_cast<int64_t>(static_cast<double>(weight) * (length_m / scene.length_unit_m) + 0.5);
}

/// Where the piece crosses the plane's parallelogram, as a bin of it; none_index where it does not.
inline uint32_t crossed_cell(const CompiledPlane& plane, const FlightPiece& piece, float& cosine) {
  cosine = glm::dot(plane.normal, piece.direction);
  if (cosine == 0) return none_index;
  const float height = glm::dot(plane.normal, plane.corner - piece.origin);
  // Most pieces stay on one side: told without a division.
  if (!(height * cosine > 0 && std::abs(height) <= piece.length * std::abs(cosine)))
    return none_index;
  const float t = height / cosine;
  const glm::vec3 p = piece.origin + piece.direction * t - plane.corner;
  const float u = glm::dot(p, plane.dual_u);
  const float v = glm::dot(p, plane.dual_v);
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return none_index;
  const int i =
      std::min(static_cast<int>(u * static_cast<float>(plane.cells_u)), plane.cells_u - 1);
  const int j =
      std::min(static_cast<int>(v * static_cast<float>(plane.cells_v)), plane.cells_v - 1);
  return plane.first_bin + static_cast<uint32_t>(j * plane.cells_u + i);
}

/// 1 / direction, finite: no product with a finite length is NaN. A direction of zero counts as the
/// smallest rise, so that a piece in a face belongs to the side above it.
inline glm::vec3 finite_inverse(const glm::vec3& direction) {
  constexpr float least = 1e-30f;
  const auto inverse = [](float d) { return 1.0f / (std::abs(d) < least ? least : d); };
  return {inverse(direction.x), inverse(direction.y), inverse(direction.z)};
}

/// The part of the piece inside an axis-aligned box, low <= p < high; empty where last <= first.
struct BoxStretch {
  float first, last;
};
inline BoxStretch stretch_in_box(const glm::vec3& low, const glm::vec3& high,
                                 const glm::vec3& inverse, const FlightPiece& piece) {
  const glm::vec3 t0 = (low - piece.origin) * inverse;
  const glm::vec3 t1 = (high - piece.origin) * inverse;
  const glm::vec3 near = glm::min(t0, t1);
  const glm::vec3 far = glm::max(t0, t1);
  return {std::max(std::max(near.x, near.y), std::max(near.z, 0.0f)),
          std::min(std::min(far.x, far.y), std::min(far.z, piece.length))};
}

/// Length of the piece inside a volume group [m]; `inverse` is finite_inverse of its direction.
float length_inside(const CompiledVolumeGroup& group, const FlightPiece& piece,
                    const glm::vec3& inverse);
/// Whether a point lies inside.
bool inside(const CompiledVolumeGroup& group, const glm::vec3& p);

/// Index of the voxel that holds a point, or none_index outside the grid.
inline uint32_t voxel_of(const VoxelGrid& grid, const glm::vec3& p) {
  const glm::vec3 q = (p - grid.low) / grid.edge;
  const int x = static_cast<int>(std::floor(q.x));
  const int y = static_cast<int>(std::floor(q.y));
  const int z = static_cast<int>(std::floor(q.z));
  if (x < 0 || y < 0 || z < 0 || x >= grid.nx || y >= grid.ny || z >= grid.nz) return none_index;
  return static_cast<uint32_t>((z * grid.ny + y) * grid.nx + x);
}

/// Calls visit(voxel, length_m) for every voxel on the piece, in order; a voxel that is only
/// touched may be visited with length 0. `inverse` is finite_inverse of the direction. Returns the
/// length inside the grid. Steps are counted in whole cells (Amanatides and Woo 1987), so that it
/// ends whatever the rounding; which axis is next is chance, hence no branch on it.
template <class Visit>
float for_each_voxel(const VoxelGrid& grid, const FlightPiece& piece, const glm::vec3& inverse,
                     Visit&& visit) {
  const glm::vec3 high =
      grid.low + grid.edge * glm::vec3(static_cast<float>(grid.nx), static_cast<float>(grid.ny),
                                       static_cast<float>(grid.nz));
  const auto [first, last] = stretch_in_box(grid.low, high, inverse, piece);
  if (!(first < last)) return 0;
  const int n[3] = {grid.nx, grid.ny, grid.nz};
  const int stride[3] = {1, grid.nx, grid.nx * grid.ny};
  int step[3], left[3];  // of the voxel's index; cells left on the way out
  float next[3], delta[3];
  int voxel = 0;
  const glm::vec3 start = piece.origin + piece.direction * first;
  const float cells_per_metre = 1.0f / grid.edge;
  for (int a = 0; a < 3; ++a) {
    const bool up = inverse[a] > 0;
    const int cell =
        std::clamp(static_cast<int>((start[a] - grid.low[a]) * cells_per_metre), 0, n[a] - 1);
    voxel += cell * stride[a];
    step[a] = up ? stride[a] : -stride[a];
    left[a] = up ? n[a] - 1 - cell : cell;
    const float face = grid.low[a] + grid.edge * static_cast<float>(cell + (up ? 1 : 0));
    next[a] = (face - piece.origin[a]) * inverse[a];
    delta[a] = grid.edge * std::abs(inverse[a]);
  }
  float t = first;
  while (true) {
    const float end = std::min(std::min(next[0], next[1]), next[2]);
    const float stop = std::max(t, std::min(end, last));
    visit(static_cast<uint32_t>(voxel), stop - t);
    t = stop;
    if (end >= last) return last - first;
    for (int a = 0; a < 3; ++a) {
      const int crossed = next[a] <= end ? -1 : 0;
      voxel += step[a] & crossed;
      left[a] += crossed;
      next[a] += choose(crossed != 0, delta[a], 0.0f);
    }
    if ((left[0] | left[1] | left[2]) < 0) return t - first;
  }
}

/// Scores planes, counting planes, volume groups and voxels along the piece.
void score_flight(const CompiledScene& scene, const FlightPiece& piece, BatchScores& batch);

/// Scores a collision's absorbed and scattered weight where it happens.
void score_collision(const CompiledScene& scene, const glm::vec3& place, int band, uint32_t medium,
                     Weight absorbed, Weight scattered, BatchScores& batch);

}  // namespace luxodus
