// Direct light on a plane: at the centres of its cells, which are the grid points of the codes, and
// as means over cells and plane, by adaptive quadrature with a bound of its own error. Every cell
// starts with the Gauss-Legendre rule of four points; cells across which something comes into sight
// or changes fast are quartered, in rounds, those first that may err most, until the bound is
// limits::plane_tolerance of the mean or the work is spent. What lies between all points of a cell
// shows in neither. The same bits for any number of threads. One call at a time per runner.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Of a plane's mean: the bound at which its quadrature ends.
inline constexpr double plane_tolerance = 1e-3;
/// Quarterings for each cell, for every plane besides, and of a plane at most; each takes 36
/// points, at which only emitters that are seen in part around them take shadow rays.
inline constexpr int64_t plane_splits_per_cell = 1;
inline constexpr int64_t plane_splits = 256;
inline constexpr int64_t max_plane_splits = 20'000;
/// So many times fewer where flames shine: each is looked at by hundreds of points.
inline constexpr int64_t plane_splits_by_flames = 4;
}  // namespace limits

/// Illuminance [lx] of one plane, cells by index v * cells_u + u. Clear: of luminaires alone, no
/// signs and no flames, as if there were no media: what codes calculate.
struct PlaneLight {
  std::vector<glm::dvec3> centres;  // scene coordinates
  std::vector<double> point_lx, point_clear_lx;
  std::vector<double> mean_lx, mean_clear_lx;
  std::vector<double> group_lx, group_clear_lx;  // means over the plane, by source group
  double bound_lx = 0, bound_clear_lx = 0;       // what the means over the plane may err by
};

/// Of plane `index` of the scene. `finished`: cells' rows that are done, before the quarterings.
/// `left_out`: by cell, whether it is no part of the plane: its values are NaN, and it is in no
/// mean; empty for none.
PlaneLight plane_light(const CompiledScene& scene, size_t index, const ParallelFor& runner,
                       const ParallelFor::Finished& finished = {},
                       const std::vector<char>& left_out = {});

}  // namespace luxodus
