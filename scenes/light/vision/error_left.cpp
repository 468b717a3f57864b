#include "scenes/light/vision/error_left.hpp"

namespace luxodus {

namespace {

/// Rows per work item.
constexpr int rows_at_once = 16;

/// Adds to each pixel of the rows the number of similar pixels in its small window, itself
/// included.
void add_alike(const UncertainLight& light, int height, const Rectangle& rows, float k2,
               std::vector<float>& alike) {
  const Rectangle area{0, std::max(0, rows.y0 - close_patch_px), rows.x1,
                       std::min(height, rows.y1 + close_patch_px)};
  std::vector<float> unlike(area.pixels()), pairs(area.pixels()), scratch;
  for (int dy = -close_window_px; dy <= close_window_px; ++dy)
    for (int dx = -close_window_px; dx <= close_window_px; ++dx) {
      std::fill(unlike.begin(), unlike.end(), 0.0f);
      add_unlikeness(light, height, area, dx, dy, k2, unlike);
      mark_pairs(height, area, dx, dy, pairs);
      const std::vector<float> inside = pairs;
      add_surroundings(unlike, area, close_patch_px, scratch);
      add_surroundings(pairs, area, close_patch_px, scratch);
      for (int y = rows.y0; y < rows.y1; ++y)
        for (int x = 0; x < rows.x1; ++x) {
          const size_t at = area.index(x, y);
          if (inside[at] > 0) alike[rows.index(x, y)] += likeness_weight(unlike[at] / pairs[at]);
        }
    }
}

}  // namespace

std::vector<float> error_left(UncertainLight light, int width, int height, double tolerance,
                              const ShareWork& share) {
  const Rectangle all{0, 0, width, height};
  std::vector<float> squares;
  for (const float value : light.light) squares.push_back(value * value);
  ask_surroundings(light.variance, squares, all);
  std::vector<float> left(all.pixels());
  share((height + rows_at_once - 1) / rows_at_once, [&](int64_t band) {
    const int first = static_cast<int>(band) * rows_at_once;
    const Rectangle rows{0, first, width, std::min(height, first + rows_at_once)};
    std::vector<float> alike(rows.pixels(), 0.0f);
    add_alike(light, height, rows, static_cast<float>(tolerance * tolerance), alike);
    for (size_t i = 0; i < alike.size(); ++i) {
      const size_t at = all.index(0, first) + i;
      left[at] = std::sqrt(light.variance[at] / alike[i]);
    }
  });
  return left;
}

}  // namespace luxodus
