#include "scenes/light/vision/foveal_cells.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

constexpr double fovea_deg = 1.0;
constexpr double min_cells = 256;  // for a useful histogram

int cells_along(int pixels, int cell_px) {
  return (pixels + cell_px - 1) / cell_px;
}

}  // namespace

FovealCells::FovealCells(const XyzPicture& picture, double degrees_per_pixel)
    : width(picture.width), height(picture.height) {
  const auto n = static_cast<double>(picture.pixels());
  const double widest = std::max(1.0, std::floor(std::sqrt(n / min_cells)));
  const double wanted = degrees_per_pixel > 0 ? fovea_deg / degrees_per_pixel : 1;
  cell_px = static_cast<int>(std::clamp(std::round(wanted), 1.0, widest));
  wide = cells_along(width, cell_px);
  high = cells_along(height, cell_px);
}

void FovealCells::coarsen() {
  cell_px *= 2;
  wide = cells_along(width, cell_px);
  high = cells_along(height, cell_px);
}

double FovealCells::at_pixel(const std::vector<double>& by_cell, int x, int y) const {
  const auto place = [&](int pixel_index, int cells) {
    const double at = (pixel_index + 0.5) / cell_px - 0.5;
    return std::clamp(at, 0.0, static_cast<double>(cells - 1));
  };
  const double u = place(x, wide), v = place(y, high);
  const int i = std::min(static_cast<int>(u), std::max(0, wide - 2));
  const int j = std::min(static_cast<int>(v), std::max(0, high - 2));
  const double fu = u - i, fv = v - j;
  const auto m = [&](int a, int b) {
    return by_cell[static_cast<size_t>(std::min(b, high - 1)) * static_cast<size_t>(wide) +
                   static_cast<size_t>(std::min(a, wide - 1))];
  };
  return (1 - fv) * ((1 - fu) * m(i, j) + fu * m(i + 1, j)) +
         fv * ((1 - fu) * m(i, j + 1) + fu * m(i + 1, j + 1));
}

}  // namespace luxodus
