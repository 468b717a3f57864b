#include "scenes/light/vision/regression_filter.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/core/check.hpp"
#include "scenes/light/vision/likeness.hpp"
#include "scenes/light/vision/outliers.hpp"

namespace luxodus {

namespace {

/// Rows of window centres per work item.
constexpr int rows_of_a_band = 8;
/// Ridge of the regression, relative to the features' own spread: features that do not vary in a
/// window explain nothing.
constexpr double ridge = 1e-4;
/// Features that vary less than this are not scaled up further.
constexpr double min_spread = 0.1;
/// Reach of the neighbourhood in which stated variances are compared with the difference of the
/// halves.
constexpr int calibration_reach_px = 8;
/// Weight of a pixel's own light beside its windows' fits: decides if no window is similar to it.
constexpr double own_weight = 0.25;
/// A pixel whose windows give it less weight than this gets a small window of its own: at an edge
/// or a thin line, few large patches are similar, but those of the nearest pixels are.
constexpr double min_said = 12;
/// Weight of a similar pixel in a small window, relative to a large one.
constexpr double said_by_close_pixel = 0.25;
/// Share of the mean luminance of its windows: a fit below it is due to noise around the pixel.
constexpr double min_coloured = 0.1;
constexpr size_t max_features = 16;
constexpr size_t colour_channels = 3;

/// One half, channel by channel, in the form that comparisons read.
using Compared = std::array<UncertainLight, colour_channels>;

/// Variances of one channel of a half, calibrated by the difference of the halves around each
/// pixel: low-discrepancy paths have a smaller error than the spread of their values suggests.
std::vector<float> borne_out_variance(const NoisyPicture& picture, const HalfPicture& half,
                                      size_t channel) {
  const Rectangle all{0, 0, picture.width, picture.height};
  std::vector<float> is(picture.pixels()), said(picture.pixels()), variance(picture.pixels());
  std::vector<float> scratch;
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const float difference = picture.half[0].light[light_channels * i + channel] -
                             picture.half[1].light[light_channels * i + channel];
    is[i] = difference * difference;
    said[i] = picture.half[0].variance[colour_channels * i + channel] +
              picture.half[1].variance[colour_channels * i + channel];
    variance[i] = half.variance[colour_channels * i + channel];
  }
  add_surroundings(is, all, calibration_reach_px, scratch);
  add_surroundings(said, all, calibration_reach_px, scratch);
  for (size_t i = 0; i < picture.pixels(); ++i)
    if (said[i] > is[i]) variance[i] *= is[i] / said[i];
  return variance;
}

/// Squared mean of both halves in a channel [(cd/m2)2].
std::vector<float> squared_light(const NoisyPicture& picture, size_t channel) {
  std::vector<float> out(picture.pixels());
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const float light = (picture.half[0].light[light_channels * i + channel] +
                         picture.half[1].light[light_channels * i + channel]) /
                        2;
    out[i] = light * light;
  }
  return out;
}

Compared compared(const NoisyPicture& picture, const HalfPicture& half) {
  const Rectangle all{0, 0, picture.width, picture.height};
  Compared out;
  for (size_t c = 0; c < colour_channels; ++c) {
    for (size_t i = 0; i < picture.pixels(); ++i)
      out[c].light.push_back(half.light[light_channels * i + c]);
    out[c].variance = borne_out_variance(picture, half, c);
    ask_surroundings(out[c].variance, squared_light(picture, c), all);
  }
  return out;
}

/// Features shifted and scaled to a spread of 1 over the picture, except that nearly constant ones
/// are not scaled up: they must not explain more than they do.
std::vector<float> standardised(const NoisyPicture& picture) {
  const size_t n = picture.feature_count;
  std::vector<double> mean(n, 0.0), squares(n, 0.0);
  for (size_t i = 0; i < picture.pixels(); ++i)
    for (size_t k = 0; k < n; ++k) {
      const auto value = static_cast<double>(picture.features[n * i + k]);
      mean[k] += value;
      squares[k] += value * value;
    }
  const auto pixels = static_cast<double>(picture.pixels());
  std::vector<float> out(picture.features.size());
  for (size_t k = 0; k < n; ++k) {
    mean[k] /= pixels;
    const double spread = std::sqrt(std::max(0.0, squares[k] / pixels - mean[k] * mean[k]));
    const double scale = 1 / std::max(spread, min_spread);
    for (size_t i = 0; i < picture.pixels(); ++i)
      out[n * i + k] =
          static_cast<float>((static_cast<double>(picture.features[n * i + k]) - mean[k]) * scale);
  }
  return out;
}

/// A symmetric system of equations with several right-hand sides, solved by Cholesky's method.
template <size_t MaxUnknowns, size_t Sides>
class NormalEquations {
 public:
  explicit NormalEquations(size_t unknowns) : n_(unknowns) {}

  void add(double weight, const double* row, const float* sides) {
    for (size_t i = 0; i < n_; ++i) {
      const double scaled = weight * row[i];
      for (size_t j = 0; j <= i; ++j) matrix_[i][j] += scaled * row[j];
      for (size_t c = 0; c < Sides; ++c) side_[i][c] += scaled * static_cast<double>(sides[c]);
    }
  }
  void add_to_diagonal(size_t i, double amount) { matrix_[i][i] += amount; }
  double diagonal(size_t i) const { return matrix_[i][i]; }
  const std::array<double, Sides>& side(size_t i) const { return side_[i]; }

  /// Solves in place; a vanishing pivot sets its unknown to 0.
  void solve() {
    for (size_t i = 0; i < n_; ++i) {
      for (size_t j = 0; j <= i; ++j) {
        double sum = matrix_[i][j];
        for (size_t k = 0; k < j; ++k) sum -= matrix_[i][k] * matrix_[j][k];
        if (j < i)
          matrix_[i][j] = matrix_[j][j] > 0 ? sum / matrix_[j][j] : 0;
        else
          matrix_[i][i] = sum > 1e-12 * matrix_[i][i] ? std::sqrt(sum) : 0;
      }
    }
    for (size_t c = 0; c < Sides; ++c) {
      for (size_t i = 0; i < n_; ++i) {
        double sum = side_[i][c];
        for (size_t k = 0; k < i; ++k) sum -= matrix_[i][k] * side_[k][c];
        side_[i][c] = matrix_[i][i] > 0 ? sum / matrix_[i][i] : 0;
      }
      for (size_t i = n_; i-- > 0;) {
        double sum = side_[i][c];
        for (size_t k = i + 1; k < n_; ++k) sum -= matrix_[k][i] * side_[k][c];
        side_[i][c] = matrix_[i][i] > 0 ? sum / matrix_[i][i] : 0;
      }
    }
  }
  const std::array<double, Sides>& solution(size_t i) const { return side_[i]; }

 private:
  size_t n_;
  std::array<std::array<double, MaxUnknowns>, MaxUnknowns> matrix_{};
  std::array<std::array<double, Sides>, MaxUnknowns> side_{};
};

/// A pixel of a window and its weight there.
struct Member {
  size_t pixel = 0;
  double weight = 0;
};

using Light = std::array<double, light_channels>;

/// The light of a window as a linear function of features.
class Fit {
 public:
  /// Requires: the picture outlives it.
  Fit(const NoisyPicture& picture, const HalfPicture& light, size_t centre,
      const std::vector<Member>& window)
      : picture_(picture), centre_(centre), equations_(picture.feature_count + 1) {
    for (const Member& member : window)
      equations_.add(member.weight * light.paths_of(member.pixel), row_of(member.pixel).data(),
                     &light.light[light_channels * member.pixel]);
    const double weight_of_all = equations_.diagonal(0);
    mean_ = equations_.side(0);
    for (double& channel : mean_) channel /= weight_of_all;
    for (size_t k = 1; k <= picture.feature_count; ++k)
      equations_.add_to_diagonal(k, ridge * weight_of_all);
    equations_.solve();
  }

  /// [cd/m2]
  Light at(size_t pixel) const {
    const Row row = row_of(pixel);
    Light out{};
    for (size_t c = 0; c < light_channels; ++c)
      for (size_t k = 0; k <= picture_.feature_count; ++k)
        out[c] += row[k] * equations_.solution(k)[c];
    return out;
  }
  /// The weighted mean without features [cd/m2].
  const Light& mean() const { return mean_; }

 private:
  using Row = std::array<double, max_features + 1>;

  /// 1, followed by the difference of each feature of a pixel from the centre's.
  Row row_of(size_t pixel) const {
    const size_t n = picture_.feature_count;
    Row row;
    row[0] = 1;
    for (size_t k = 0; k < n; ++k)
      row[k + 1] = static_cast<double>(picture_.features[n * pixel + k] -
                                       picture_.features[n * centre_ + k]);
    return row;
  }

  const NoisyPicture& picture_;
  const size_t centre_;
  NormalEquations<max_features + 1, light_channels> equations_;
  Light mean_{};
};

/// Filters one half, with weights from the other half.
class HalfFilter {
 public:
  HalfFilter(const NoisyPicture& picture, const RegressionFilter& filter, const Compared& likeness,
             const HalfPicture& light)
      : picture_(picture),
        filter_(filter),
        likeness_(likeness),
        light_(light),
        offsets_(static_cast<size_t>(2 * filter.window_px + 1) *
                 static_cast<size_t>(2 * filter.window_px + 1)),
        sums_((light_channels + 1) * picture.pixels(), 0.0),
        means_(light_channels * picture.pixels(), 0.0) {}

  int bands() const {
    const int centres = (picture_.height + filter_.stride_px - 1) / filter_.stride_px;
    return (centres + rows_of_a_band - 1) / rows_of_a_band;
  }

  /// Adds the fits of a band's windows to all their pixels. Bands that are not adjacent may run
  /// concurrently.
  void filter_band(int band) {
    const int rows = rows_of_a_band * filter_.stride_px;
    const Rectangle centres{0, band * rows, picture_.width,
                            std::min(picture_.height, (band + 1) * rows)};
    const std::vector<float> weights = weigh(centres);
    size_t centre = 0;
    for_each_centre(centres,
                    [&](int x, int y) { add_window(x, y, &weights[offsets_ * centre++]); });
  }

  bool has_close_windows() const { return filter_.closely; }
  int rows() const { return picture_.height; }
  /// After all bands: adds the small windows for the pixels of a row. Any rows may run
  /// concurrently.
  void filter_closely(int row) {
    for (int x = 0; x < picture_.width; ++x) add_close_window(x, row);
  }

  /// [cd/m2]
  double value(size_t pixel, size_t channel) const {
    const double* sums = &sums_[(light_channels + 1) * pixel];
    const auto own = static_cast<double>(light_.light[light_channels * pixel + channel]);
    return (sums[channel] + own_weight * own) / (sums[light_channels] + own_weight);
  }
  /// The weighted mean of the windows around a pixel, without features [cd/m2].
  double mean(size_t pixel, size_t channel) const {
    const double weight = sums_[(light_channels + 1) * pixel + light_channels];
    return weight > 0 ? means_[light_channels * pixel + channel] / weight : 0;
  }

 private:
  /// Calls with(x, y) for every window centre of the rows: the middle of each stride, clamped to
  /// the picture.
  template <class With>
  void for_each_centre(const Rectangle& rows, const With& with) const {
    const int stride = filter_.stride_px;
    for (int y = std::min(rows.y0 + stride / 2, rows.y1 - 1); y < rows.y1; y += stride)
      for (int x = std::min(stride / 2, picture_.width - 1); x < picture_.width; x += stride)
        with(x, y);
  }

  /// Weights of all pixels of all windows with centres in the rows.
  std::vector<float> weigh(const Rectangle& rows) const {
    const int reach = filter_.patch_px;
    const Rectangle area{0, std::max(0, rows.y0 - reach), picture_.width,
                         std::min(picture_.height, rows.y1 + reach)};
    std::vector<float> inside(area.pixels(), 1.0f), distance(area.pixels()), scratch;
    const auto lines =
        static_cast<size_t>((rows.y1 - rows.y0 + filter_.stride_px - 1) / filter_.stride_px);
    const auto columns =
        static_cast<size_t>((picture_.width + filter_.stride_px - 1) / filter_.stride_px);
    std::vector<float> weights(lines * columns * offsets_, 0.0f);
    size_t at_offset = 0;
    for (int dy = -filter_.window_px; dy <= filter_.window_px; ++dy)
      for (int dx = -filter_.window_px; dx <= filter_.window_px; ++dx, ++at_offset) {
        measure(area, dx, dy, distance, inside);
        add_surroundings(distance, area, reach, scratch);
        add_surroundings(inside, area, reach, scratch);
        size_t centre = 0;
        for_each_centre(rows, [&](int x, int y) {
          const size_t of_centre = centre++;
          if (x + dx < 0 || x + dx >= picture_.width || y + dy < 0 || y + dy >= picture_.height)
            return;
          const size_t at = area.index(x, y);
          weights[offsets_ * of_centre + at_offset] =
              likeness_weight(distance[at] / (inside[at] * float{colour_channels}));
        });
      }
    return weights;
  }

  /// Unlikeness of every pixel of the area to the pixel offset by (dx, dy), relative to their
  /// errors; `inside` is 1 if both are in the picture.
  void measure(const Rectangle& area, int dx, int dy, std::vector<float>& distance,
               std::vector<float>& inside) const {
    std::fill(distance.begin(), distance.end(), 0.0f);
    for (const UncertainLight& channel : likeness_)
      add_unlikeness(channel, picture_.height, area, dx, dy, squared_tolerance(), distance);
    mark_pairs(picture_.height, area, dx, dy, inside);
  }

  float squared_tolerance() const {
    return static_cast<float>(filter_.tolerance * filter_.tolerance);
  }
  size_t pixel_at(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(picture_.width) + static_cast<size_t>(x);
  }
  bool is_inside(int x, int y) const {
    return x >= 0 && x < picture_.width && y >= 0 && y < picture_.height;
  }

  /// The weight of one pixel in the small window of another, by small patches.
  float likeness_of(int x, int y, int other_x, int other_y) const {
    float unlike = 0;
    int count = 0;
    for (int dy = -close_patch_px; dy <= close_patch_px; ++dy)
      for (int dx = -close_patch_px; dx <= close_patch_px; ++dx) {
        if (!is_inside(x + dx, y + dy) || !is_inside(other_x + dx, other_y + dy)) continue;
        const size_t i = pixel_at(x + dx, y + dy), k = pixel_at(other_x + dx, other_y + dy);
        for (const UncertainLight& of : likeness_)
          unlike += unlikeness(of.light[i], of.variance[i], of.light[k], of.variance[k],
                               squared_tolerance());
        ++count;
      }
    return likeness_weight(unlike / static_cast<float>(count * int{colour_channels}));
  }

  /// Fits the light of a window, and adds the fit to all of its pixels.
  void add_window(int x, int y, const float* weights) {
    std::vector<Member> window;
    window.reserve(offsets_);
    size_t at_offset = 0;
    for (int dy = -filter_.window_px; dy <= filter_.window_px; ++dy)
      for (int dx = -filter_.window_px; dx <= filter_.window_px; ++dx, ++at_offset)
        if (weights[at_offset] > 0)
          window.push_back({pixel_at(x + dx, y + dy), static_cast<double>(weights[at_offset])});
    const Fit fit(picture_, light_, pixel_at(x, y), window);
    for (const Member& member : window) add(fit, member);
  }

  /// Adds the small window around a pixel with little weight, for the missing weight.
  void add_close_window(int x, int y) {
    const size_t centre = pixel_at(x, y);
    const double missing = min_said - said_of(centre);
    if (!(missing > 0)) return;
    std::vector<Member> window;
    double said = 0;
    for (int v = y - close_window_px; v <= y + close_window_px; ++v)
      for (int u = x - close_window_px; u <= x + close_window_px; ++u) {
        if (!is_inside(u, v)) continue;
        const float weight = likeness_of(x, y, u, v);
        if (!(weight > 0)) continue;
        window.push_back({pixel_at(u, v), static_cast<double>(weight)});
        said += said_by_close_pixel * static_cast<double>(weight);
      }
    add(Fit(picture_, light_, centre, window), {centre, std::min(missing, said)});
  }

  double said_of(size_t pixel) const {
    return sums_[(light_channels + 1) * pixel + light_channels];
  }

  /// Adds a window's fit for one pixel.
  void add(const Fit& fit, const Member& of) {
    const Light light = fit.at(of.pixel);
    double* sums = &sums_[(light_channels + 1) * of.pixel];
    for (size_t c = 0; c < light_channels; ++c) {
      sums[c] += of.weight * light[c];
      means_[light_channels * of.pixel + c] += of.weight * fit.mean()[c];
    }
    sums[light_channels] += of.weight;
  }

  const NoisyPicture& picture_;
  const RegressionFilter& filter_;
  const Compared& likeness_;
  const HalfPicture& light_;
  const size_t offsets_;
  std::vector<double> sums_;   // per pixel: light_channels weighted values, and the weights
  std::vector<double> means_;  // per pixel: weighted means of windows
};

/// Windows of a band extend into the adjacent bands only, so every second band runs concurrently.
void filter_half(HalfFilter& half, const ShareWork& share) {
  for (const int parity : {0, 1}) {
    const int64_t count = (half.bands() + 1 - parity) / 2;
    share(count, [&](int64_t i) { half.filter_band(static_cast<int>(2 * i) + parity); });
  }
  if (half.has_close_windows())
    share(half.rows(), [&](int64_t row) { half.filter_closely(static_cast<int>(row)); });
}

/// Mean of both halves' fits at a pixel. If the fit has too little light to have a colour, or a
/// negative channel, the pixel takes the colour of its windows' means.
Light filtered_light(const std::vector<HalfFilter>& halves, size_t pixel) {
  Light fit{}, mean{};
  for (const HalfFilter& half : halves)
    for (size_t c = 0; c < light_channels; ++c) {
      fit[c] += half.value(pixel, c) / 2;
      mean[c] += half.mean(pixel, c) / 2;
    }
  const double luminance = std::max(0.0, fit[1]);
  const bool coloured =
      *std::min_element(fit.begin(), fit.end()) >= 0 && luminance > min_coloured * mean[1];
  if (coloured || !(mean[1] > 0)) {
    for (double& light : fit) light = std::max(0.0, light);
    return fit;
  }
  for (size_t c = 0; c < light_channels; ++c) fit[c] = luminance * std::max(0.0, mean[c]) / mean[1];
  return fit;
}

/// Scales each channel so that its sum is that of the halves: weights that depend on light remove
/// some of what is bright by chance, and so reduce the mean a little.
void keep_means(const NoisyPicture& picture, std::vector<float>& light) {
  for (size_t c = 0; c < light_channels; ++c) {
    double traced = 0, filtered = 0;
    for (size_t i = c; i < light.size(); i += light_channels) {
      for (const HalfPicture& half : picture.half) traced += static_cast<double>(half.light[i]) / 2;
      filtered += static_cast<double>(light[i]);
    }
    if (!(traced > 0 && filtered > 0)) continue;
    const auto factor = static_cast<float>(traced / filtered);
    for (size_t i = c; i < light.size(); i += light_channels) light[i] *= factor;
  }
}

}  // namespace

FilteredPicture filter_picture(NoisyPicture picture, const RegressionFilter& filter,
                               const ShareWork& share) {
  LUX_CHECK(picture.feature_count <= max_features, "a filter takes 16 features at most");
  LUX_CHECK(filter.stride_px >= 1 && filter.stride_px <= filter.window_px &&
                2 * filter.window_px <= rows_of_a_band * filter.stride_px,
            "windows of two bands that are no neighbours must not meet");
  picture.features = standardised(picture);
  spread_outliers(picture);
  const std::array<Compared, 2> likeness{compared(picture, picture.half[0]),
                                         compared(picture, picture.half[1])};
  std::vector<HalfFilter> halves;
  for (const size_t h : {size_t{0}, size_t{1}})
    halves.emplace_back(picture, filter, likeness[1 - h], picture.half[h]);
  for (HalfFilter& half : halves) filter_half(half, share);

  FilteredPicture out;
  out.light.resize(light_channels * picture.pixels());
  std::vector<float> squares(picture.pixels()), count(picture.pixels(), 1.0f), scratch;
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const Light light = filtered_light(halves, i);
    for (size_t c = 0; c < light_channels; ++c)
      out.light[light_channels * i + c] = static_cast<float>(light[c]);
    const double half_difference = (halves[0].value(i, 1) - halves[1].value(i, 1)) / 2;
    squares[i] = static_cast<float>(half_difference * half_difference);
  }
  keep_means(picture, out.light);
  const Rectangle all{0, 0, picture.width, picture.height};
  add_surroundings(squares, all, filter.patch_px, scratch);
  add_surroundings(count, all, filter.patch_px, scratch);
  out.standard_error_y.resize(picture.pixels());
  for (size_t i = 0; i < picture.pixels(); ++i)
    out.standard_error_y[i] = std::sqrt(squares[i] / count[i]);
  return out;
}

}  // namespace luxodus
