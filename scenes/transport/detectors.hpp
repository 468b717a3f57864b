// What a flight passes on its way: planes and probes never stop light, so they are scored here, together with
// voxels and volume groups. All work is on one straight piece of a path, from `origin` for `length`.
// Pure functions on a batch's scores; one thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

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

/// Fixed-point score of weight times length; rounded to nearest, one part in 2^32 of the scene's size.
inline int64_t length_score(const CompiledScene& scene, Weight weight, double length_m) {
  return static_cast<int64_t>(static_cast<double>(weight) * (length_m / scene.length_unit_m) + 0.5);
}

/// Where the piece crosses the plane's parallelogram, as a bin of it; none_index where it does not.
inline uint32_t crossed_cell(const CompiledPlane& plane, const FlightPiece& piece, float& cosine) {
  cosine = glm::dot(plane.normal, piece.direction);
  if (cosine == 0) return none_index;
  const float t = glm::dot(plane.normal, plane.corner - piece.origin) / cosine;
  if (!(t > 0 && t <= piece.length)) return none_index;
  const glm::vec3 p = piece.origin + piece.direction * t - plane.corner;
  const float u = glm::dot(p, plane.dual_u);
  const float v = glm::dot(p, plane.dual_v);
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return none_index;
  const int i = std::min(static_cast<int>(u * static_cast<float>(plane.cells_u)), plane.cells_u - 1);
  const int j = std::min(static_cast<int>(v * static_cast<float>(plane.cells_v)), plane.cells_v - 1);
  return plane.first_bin + static_cast<uint32_t>(j * plane.cells_u + i);
}

/// Length of the piece inside a volume group [m].
float length_inside(const CompiledVolumeGroup& group, const FlightPiece& piece);
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

/// Calls visit(voxel, length_m) for every voxel on the piece, in order (Amanatides and Woo 1987, stepping by
/// integer cells, so that it ends whatever the rounding).
template <class Visit>
void for_each_voxel(const VoxelGrid& grid, const FlightPiece& piece, Visit&& visit) {
  // Clip to the grid.
  const glm::vec3 high = grid.low + grid.edge * glm::vec3(static_cast<float>(grid.nx),
                                                          static_cast<float>(grid.ny),
                                                          static_cast<float>(grid.nz));
  float first = 0, last = piece.length;
  for (int a = 0; a < 3; ++a) {
    if (piece.direction[a] == 0) {
      if (piece.origin[a] < grid.low[a] || piece.origin[a] >= high[a]) return;
      continue;
    }
    const float inverse = 1.0f / piece.direction[a];
    float t0 = (grid.low[a] - piece.origin[a]) * inverse;
    float t1 = (high[a] - piece.origin[a]) * inverse;
    if (t0 > t1) std::swap(t0, t1);
    first = std::max(first, t0);
    last = std::min(last, t1);
  }
  if (!(first < last)) return;
  const int n[3] = {grid.nx, grid.ny, grid.nz};
  int cell[3], step[3];
  float next[3], delta[3];
  const glm::vec3 start = piece.origin + piece.direction * first;
  for (int a = 0; a < 3; ++a) {
    cell[a] = std::clamp(static_cast<int>(std::floor((start[a] - grid.low[a]) / grid.edge)), 0, n[a] - 1);
    step[a] = piece.direction[a] > 0 ? 1 : -1;
    if (piece.direction[a] == 0) {
      next[a] = delta[a] = std::numeric_limits<float>::infinity();
      continue;
    }
    const float face = grid.low[a] + grid.edge * static_cast<float>(cell[a] + (step[a] > 0 ? 1 : 0));
    next[a] = (face - piece.origin[a]) / piece.direction[a];
    delta[a] = grid.edge / std::abs(piece.direction[a]);
  }
  float t = first;
  while (true) {
    const int a = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const float end = std::min(next[a], last);
    if (end > t) {
      visit(static_cast<uint32_t>((cell[2] * grid.ny + cell[1]) * grid.nx + cell[0]), end - t);
      t = end;
    }
    if (next[a] >= last) return;
    cell[a] += step[a];
    if (cell[a] < 0 || cell[a] >= n[a]) return;
    next[a] += delta[a];
  }
}

/// Scores planes, counting planes, volume groups and voxels along the piece.
void score_flight(const CompiledScene& scene, const FlightPiece& piece, BatchScores& batch);

/// Scores a collision's absorbed and scattered weight where it happens.
void score_collision(const CompiledScene& scene, const glm::vec3& place, int band, uint32_t medium,
                     Weight absorbed, Weight scattered, BatchScores& batch);

}  // namespace luxodus
