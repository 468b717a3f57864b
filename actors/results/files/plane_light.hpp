// Direct light on a plane: at the centres of its cells, which are the grid points of the codes, and
// as means over cells and plane, by adaptive quadrature with a bound of its own error. Every cell
// starts with the four-point Gauss-Legendre rule; cells with visibility edges or steep gradients
// are quartered in rounds, those with the largest bound first, until the bound is
// limits::plane_tolerance of the mean or the work limit is reached. Anything that lies between all
// points of a cell is missed, in the mean and in the bound. The same bits for any number of
// threads. One call at a time per runner.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// The quadrature ends at this bound, relative to a plane's mean.
inline constexpr double plane_tolerance = 1e-3;
/// Limits on quarterings: for each cell, in addition for every plane, and in all of a plane. Each
/// takes 36 points, at which only emitters that are seen in part around them take shadow rays.
inline constexpr int64_t plane_splits_per_cell = 1;
inline constexpr int64_t plane_splits = 256;
inline constexpr int64_t max_plane_splits = 20'000;
/// Divides these limits if flames shine: each flame is sampled by hundreds of points.
inline constexpr int64_t plane_splits_by_flames = 4;
}  // namespace limits

/// Illuminance [lx] of one plane, cells by index v * cells_u + u. Clear: luminaires only, without
/// signs and flames, as if there were no media: the quantity of the codes.
struct PlaneLight {
  std::vector<glm::dvec3> centres;  // scene coordinates
  std::vector<double> point_lx, point_clear_lx;
  std::vector<double> mean_lx, mean_clear_lx;
  std::vector<double> group_lx, group_clear_lx;  // means over the plane, by source group
  double bound_lx = 0, bound_clear_lx = 0;       // bounds of the errors of the means over the plane
};

/// The light of plane `index` of the scene. `finished`: rows of cells that are done, before the
/// quarterings. `left_out`: for each cell, whether it is excluded: its values are NaN, and means
/// omit it; empty for none.
PlaneLight plane_light(const CompiledScene& scene, size_t index, const ParallelFor& runner,
                       const ParallelFor::Finished& finished = {},
                       const std::vector<char>& left_out = {});

}  // namespace luxodus
