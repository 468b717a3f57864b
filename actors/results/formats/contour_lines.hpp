// Lines of equal value through a grid of points: marching squares with linear interpolation. Pure;
// any thread.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace luxodus {

/// Points in the units of the grid's coordinates; a closed line repeats its first point at its end.
struct ContourLine {
  std::vector<glm::dvec2> points;
  bool closed = false;
};

/// All lines where the values cross `level`. values[j * x.size() + i] belongs to (x[i], y[j]);
/// squares with a corner that is not finite are left out. A saddle is decided by the mean of its
/// corners. Requires: values.size() == x.size() * y.size(), x and y ascending.
std::vector<ContourLine> contour_lines(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> values, double level);

}  // namespace luxodus
