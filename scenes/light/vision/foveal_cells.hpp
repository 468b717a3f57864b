// Cells of a picture of about one degree of view, the size of the fovea: what an eye adapts to, and
// from where light scatters within it. Plain values; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/light/vision/picture.hpp"

namespace luxodus {

struct FovealCells {
  /// `degrees_per_pixel`: in the middle of the picture; 0: not known. A small picture has smaller
  /// cells: a histogram of ten is none.
  FovealCells(const XyzPicture& picture, double degrees_per_pixel);

  size_t count() const { return static_cast<size_t>(wide) * static_cast<size_t>(high); }
  size_t cell_of(int x, int y) const {
    return static_cast<size_t>(y / cell_px) * static_cast<size_t>(wide) +
           static_cast<size_t>(x / cell_px);
  }
  /// A value of cells at a pixel, bilinear between the centres of the cells, so that no cell shows
  /// as a square. Requires: by_cell.size() == count().
  double at_pixel(const std::vector<double>& by_cell, int x, int y) const;
  /// Cells of twice the edge.
  void coarsen();

  int width, height;  // of the picture [px]
  int cell_px;        // edge
  int wide, high;     // cells
};

}  // namespace luxodus
