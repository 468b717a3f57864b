#include "scenes/light/vision/likeness.hpp"

namespace luxodus {

namespace {

/// Reach of the neighbourhood for the variance of a pixel that no rare path has reached.
constexpr int variance_reach_px = 2;

/// Columns that have a neighbour at offset dx.
struct Columns {
  Columns(int width, int dx) : begin(std::max(0, -dx)), end(std::min(width, width - dx)) {}
  int begin, end;
};

}  // namespace

void add_surroundings(std::vector<float>& values, const Rectangle& area, int reach,
                      std::vector<float>& scratch) {
  scratch.assign(values.size(), 0.0f);
  for (int y = area.y0; y < area.y1; ++y)
    for (int d = -reach; d <= reach; ++d) {
      const int from = std::max(area.x0, area.x0 - d), to = std::min(area.x1, area.x1 - d);
      const float* in = &values[area.index(area.x0, y)];
      float* out = &scratch[area.index(area.x0, y)];
      for (int x = from - area.x0; x < to - area.x0; ++x) out[x] += in[x + d];
    }
  std::fill(values.begin(), values.end(), 0.0f);
  for (int y = area.y0; y < area.y1; ++y)
    for (int j = std::max(area.y0, y - reach); j < std::min(area.y1, y + reach + 1); ++j) {
      const float* in = &scratch[area.index(area.x0, j)];
      float* out = &values[area.index(area.x0, y)];
      for (int x = 0; x < area.width(); ++x) out[x] += in[x];
    }
}

void ask_surroundings(std::vector<float>& variance, const std::vector<float>& squares,
                      const Rectangle& area) {
  std::vector<float> mean = variance, mean_square = squares, count(variance.size(), 1.0f), scratch;
  add_surroundings(mean, area, variance_reach_px, scratch);
  add_surroundings(mean_square, area, variance_reach_px, scratch);
  add_surroundings(count, area, variance_reach_px, scratch);
  for (size_t i = 0; i < variance.size(); ++i) {
    mean[i] /= count[i];
    mean_square[i] /= count[i];
    if (squares[i] < mean_square[i]) mean[i] *= squares[i] / mean_square[i];
    variance[i] = std::max(variance[i], mean[i]);
  }
}

void add_unlikeness(const UncertainLight& of, int height, const Rectangle& rows, int dx, int dy,
                    float k2, std::vector<float>& to) {
  const Columns columns(rows.width(), dx);
  const Rectangle picture{0, 0, rows.width(), height};
  for (int y = std::max(rows.y0, -dy); y < std::min(rows.y1, height - dy); ++y) {
    const float* u = &of.light[picture.index(0, y)];
    const float* v = &of.variance[picture.index(0, y)];
    const float* u_there = &of.light[picture.index(0, y + dy)] + dx;
    const float* v_there = &of.variance[picture.index(0, y + dy)] + dx;
    float* out = &to[rows.index(0, y)];
    for (int x = columns.begin; x < columns.end; ++x)
      out[x] += unlikeness(u[x], v[x], u_there[x], v_there[x], k2);
  }
}

void mark_pairs(int height, const Rectangle& rows, int dx, int dy, std::vector<float>& pairs) {
  const Columns columns(rows.width(), dx);
  std::fill(pairs.begin(), pairs.end(), 0.0f);
  if (columns.begin >= columns.end) return;
  for (int y = std::max(rows.y0, -dy); y < std::min(rows.y1, height - dy); ++y) {
    float* const row = &pairs[rows.index(0, y)];
    std::fill(row + columns.begin, row + columns.end, 1.0f);
  }
}

}  // namespace luxodus
