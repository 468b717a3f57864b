#include "scenes/light/vision/eye_glare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/light/vision/foveal_cells.hpp"

namespace luxodus {

namespace {

/// Every cell veils every other, so the time is quadratic. A view with more degrees uses coarser
/// cells: near neighbours are less exact, and far light veils by a fifth more, since the mean
/// excludes a cell's own light.
constexpr size_t max_veil_cells = 8192;

using SightLine = std::array<double, 3>;
constexpr size_t veil_channels = 4;  // X, Y, Z, scotopic
using VeilLight = std::array<double, veil_channels>;

double finite_light(float v) {
  return std::isfinite(v) && v > 0 ? static_cast<double>(v) : 0;
}

/// X, Y, Z and scotopic luminance of a pixel; 0 if the pixel is invalid.
VeilLight veil_light_at(const XyzPicture& picture, size_t i) {
  VeilLight out{};
  for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
    out[c] = finite_light(picture.xyz[3 * i + c]);
  if (!picture.scotopic.empty()) out[3] = finite_light(picture.scotopic[i]);
  return out;
}

/// cos(a) / a^2 of the angle between two directions; 0 from a right angle on. The squared angle is
/// a series in the squared chord, accurate to 1 % up to a right angle.
double veil_weight(const SightLine& a, const SightLine& b) {
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  if (cosine <= 0) return 0;
  const double chord2 = std::max(2 * (1 - cosine), 1e-12);
  const double angle2 = chord2 * (1 + chord2 * (1.0 / 12 + chord2 * (1.0 / 90 + chord2 / 560)));
  return cosine / angle2;
}

/// A cell's direction, light and size.
struct VeilCell {
  SightLine direction;
  VeilLight light{};       // mean over its pixels
  double solid_angle = 0;  // relative to a pixel in the middle
};

std::vector<VeilCell> veil_cells(const XyzPicture& picture, const FovealCells& cells,
                                 double degrees_per_pixel) {
  const double per_pixel = degrees_per_pixel * std::numbers::pi / 180;
  const auto direction_at = [&](double x, double y) {
    const SightLine d{(x - 0.5 * picture.width) * per_pixel, (y - 0.5 * picture.height) * per_pixel,
                      1};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + 1);
    return SightLine{d[0] / length, d[1] / length, 1 / length};
  };
  std::vector<VeilCell> out(cells.count());
  std::vector<double> members(cells.count(), 0.0);
  size_t i = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++i) {
      const size_t cell = cells.cell_of(x, y);
      const VeilLight light = veil_light_at(picture, i);
      for (size_t c = 0; c < veil_channels; ++c) out[cell].light[c] += light[c];
      members[cell] += 1;
    }
  for (int row = 0; row < cells.high; ++row)
    for (int column = 0; column < cells.wide; ++column) {
      const size_t cell =
          static_cast<size_t>(row) * static_cast<size_t>(cells.wide) + static_cast<size_t>(column);
      VeilCell& of = out[cell];
      const auto middle = [&](int index, int pixels) {
        const int from = index * cells.cell_px;
        return 0.5 * (from + std::min(pixels, from + cells.cell_px));
      };
      of.direction = direction_at(middle(column, picture.width), middle(row, picture.height));
      for (double& v : of.light) v /= members[cell];
      of.solid_angle = members[cell] * std::pow(of.direction[2], 3);
    }
  return out;
}

/// The veil of each channel, by cell: veil_share of the weighted mean over all other cells.
std::array<std::vector<double>, veil_channels> veils_of(const std::vector<VeilCell>& cells) {
  std::vector<VeilLight> sums(cells.size(), VeilLight{});
  std::vector<double> weights(cells.size(), 0.0);
  for (size_t i = 0; i < cells.size(); ++i)
    for (size_t j = i + 1; j < cells.size(); ++j) {
      const double weight = veil_weight(cells[i].direction, cells[j].direction);
      const double to_i = weight * cells[j].solid_angle, to_j = weight * cells[i].solid_angle;
      weights[i] += to_i;
      weights[j] += to_j;
      for (size_t c = 0; c < veil_channels; ++c) {
        sums[i][c] += to_i * cells[j].light[c];
        sums[j][c] += to_j * cells[i].light[c];
      }
    }
  std::array<std::vector<double>, veil_channels> out;
  for (size_t c = 0; c < veil_channels; ++c)
    for (size_t i = 0; i < cells.size(); ++i)
      out[c].push_back(veil_share * (weights[i] > 0 ? sums[i][c] / weights[i] : cells[i].light[c]));
  return out;
}

}  // namespace

XyzPicture with_eye_glare(const XyzPicture& picture, double degrees_per_pixel) {
  if (picture.pixels() == 0) return picture;
  FovealCells cells(picture, degrees_per_pixel);
  while (cells.count() > max_veil_cells) cells.coarsen();
  const auto veils = veils_of(veil_cells(picture, cells, degrees_per_pixel));
  XyzPicture out = picture;
  size_t i = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x, ++i) {
      const auto veiled = [&](float own, size_t c) {
        return static_cast<float>((1 - veil_share) * static_cast<double>(own) +
                                  cells.at_pixel(veils[c], x, y));
      };
      if (!is_light(picture, i)) continue;
      for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
        out.xyz[3 * i + c] = veiled(picture.xyz[3 * i + c], c);
      if (!picture.scotopic.empty()) out.scotopic[i] = veiled(picture.scotopic[i], 3);
    }
  return out;
}

}  // namespace luxodus
