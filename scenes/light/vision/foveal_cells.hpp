// Cells of a picture of about one degree of view, the size of the fovea: the unit of adaptation,
// and of scattering within the eye. Plain values; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/light/vision/picture.hpp"

namespace luxodus {

struct FovealCells {
  /// `degrees_per_pixel`: in the middle of the picture; 0 if unknown. A small picture has smaller
  /// cells, since a histogram needs many of them.
  FovealCells(const XyzPicture& picture, double degrees_per_pixel);

  size_t count() const { return static_cast<size_t>(wide) * static_cast<size_t>(high); }
  size_t cell_of(int x, int y) const {
    return static_cast<size_t>(y / cell_px) * static_cast<size_t>(wide) +
           static_cast<size_t>(x / cell_px);
  }
  /// A cell value at a pixel, bilinear between the centres of the cells, so that cells are not
  /// visible. Requires: by_cell.size() == count().
  double at_pixel(const std::vector<double>& by_cell, int x, int y) const;
  /// Doubles the edge of the cells.
  void coarsen();

  int width, height;  // size of the picture [px]
  int cell_px;        // edge of a cell
  int wide, high;     // number of cells
};

}  // namespace luxodus
