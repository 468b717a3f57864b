#include "actors/results/pictures/pictures.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "actors/results/run/parallel_for.hpp"
#include "scenes/light/optics/sampling.hpp"

namespace luxodus {

namespace {

/// Pixels that one fiber traces without a pause.
constexpr int columns_at_once = 32;

ShareWork shared_by(int threads) {
  return [threads](int64_t count, const std::function<void(int64_t)>& work) {
    parallel_for(count, threads, [&] { return work; });
  };
}

/// Variance of a mean, from the number of values, their sum and the sum of their squares. NaN with
/// one.
double variance_of_mean(double sum, double squares, double count) {
  if (count < 2) return std::numeric_limits<double>::quiet_NaN();
  const double mean = sum / count;
  return std::max(0.0, squares / count - mean * mean) / (count - 1);
}

}  // namespace

int even_paths(const PictureOptions& options) {
  return options.raw ? options.paths_per_pixel : even_paths(options.paths_per_pixel);
}

int next_pass(int paths) {
  if (paths < 32) return std::max(min_pass, 2 * paths);
  return paths + static_cast<int>(std::bit_floor(static_cast<unsigned>(paths))) / 2;
}

ViewPasses::ViewPasses(const LocalRun& run, const Camera& camera, uint64_t number,
                       const RadianceCache* flux, std::shared_ptr<const EmitterSight> sight,
                       std::optional<double> flames_at_s)
    : run_(run),
      camera_(camera),
      number_(number),
      flux_(flux),
      sight_(std::move(sight)),
      flames_at_s_(flames_at_s),
      sums_(pixels()) {}

size_t ViewPasses::pixels() const {
  return static_cast<size_t>(camera_.width) * static_cast<size_t>(camera_.height);
}

uint64_t ViewPasses::bytes_of(const Camera& camera) {
  return static_cast<uint64_t>(camera.width) * static_cast<uint64_t>(camera.height) *
         sizeof(PixelSums);
}

template <class PathsOf>
bool ViewPasses::trace(const PictureOptions& options, const ShareDone& progress,
                       const PathsOf& paths_of) {
  // An interrupted pass leaves no trace, so earlier sums are kept; at first there are none.
  const bool keeps = paths_ + first_paths_ > 0 && options.may_end_early();
  const std::vector<PixelSums> before = keeps ? sums_ : decltype(sums_)();
  // Rows are divided, so that many fibers have work.
  const int parts = (camera_.width + columns_at_once - 1) / columns_at_once;
  const auto make = [&](const GeometryAccess& access) {
    auto tracer = std::make_shared<PixelTracer>(run_.scene(), access, run_.seed(), camera_, number_,
                                                flux_, sight_, flames_at_s_);
    return [&, tracer](int64_t unit) {
      const int row = static_cast<int>(unit / parts);
      const int first = static_cast<int>(unit % parts) * columns_at_once;
      for (int column = first; column < std::min(first + columns_at_once, camera_.width);
           ++column) {
        if (options.interrupted()) return;
        const auto pixel = static_cast<size_t>(int64_t{row} * camera_.width + column);
        tracer->trace(column, row, pixel, paths_of(column, row), sums_[pixel]);
      }
    };
  };
  const int64_t units = int64_t{camera_.height} * parts;
  run_.rows().run(units, make, [&](int64_t done) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(units));
  });
  if (!options.interrupted()) return true;
  if (keeps)
    sums_ = before;
  else
    sums_.assign(pixels(), {});
  return false;
}

bool ViewPasses::add_first(int paths, const PictureOptions& options, const ShareDone& progress) {
  const bool whole = trace(options, progress, [&](int column, int row) {
    return all_paths(0, comes_first(column, row) ? paths : 0);
  });
  if (whole) first_paths_ = paths;
  return whole;
}

bool ViewPasses::add(int paths, const PictureOptions& options, const ShareDone& progress) {
  const bool whole = trace(options, progress, [&](int column, int row) {
    return all_paths(paths_ + (comes_first(column, row) ? first_paths_ : 0), paths_ + paths);
  });
  if (!whole) return false;
  paths_ += paths;
  first_paths_ = 0;
  return true;
}

std::vector<HalfEnds> ViewPasses::allocate(int more) const {
  return allocate_paths(sums_, camera_.width, camera_.height, paths_, more,
                        shared_by(run_.threads()));
}

bool ViewPasses::add_allocated(const std::vector<HalfEnds>& ends, int more,
                               const PictureOptions& options, const ShareDone& progress) {
  const bool whole = trace(options, progress, [&](int column, int row) {
    return PathRange{paths_, ends[static_cast<size_t>(int64_t{row} * camera_.width + column)]};
  });
  if (whole) allocated_ = more;
  return whole;
}

void ViewPasses::take_sums(Totals& totals, int group) {
  const auto end = static_cast<int64_t>(sums_.size() * PixelSums::bins);
  totals.take_bins(group, 0, end, [&](int64_t index, const Total& total) {
    const auto at = static_cast<size_t>(index);
    sums_[at / PixelSums::bins].add_bin(at % PixelSums::bins, total);
  });
  totals.take_batches(group);
}

void ViewPasses::take_first(Totals& totals, int group, int paths) {
  take_sums(totals, group);
  first_paths_ = paths;
}

void ViewPasses::take(Totals& totals, int group, int paths) {
  take_sums(totals, group);
  paths_ += paths;
  first_paths_ = 0;
}

void ViewPasses::take_allocated(Totals& totals, int group, int more) {
  take_sums(totals, group);
  allocated_ = more;
}

namespace {

/// An empty picture of this size.
TracedPicture empty_picture(int width, int height) {
  TracedPicture out;
  out.light.width = out.noisy.width = width;
  out.light.height = out.noisy.height = height;
  const size_t pixels = out.light.pixels();
  out.light.xyz.resize(3 * pixels);
  out.light.scotopic.resize(pixels);
  out.standard_error_y.resize(pixels);
  out.flux_error_y.resize(pixels);
  out.emitted.resize(light_channels * pixels);
  for (HalfPicture& half : out.noisy.half) {
    half.light.resize(light_channels * pixels);
    half.variance.resize(3 * pixels);
    half.paths.resize(pixels);
  }
  out.noisy.feature_count = picture_features;
  out.noisy.features.resize(picture_features * pixels);
  return out;
}

/// Sums for each value of a row those up to `reach` away, including itself.
void add_neighbours(const std::vector<double>& values, size_t begin, size_t stride, size_t count,
                    size_t reach, std::vector<double>& into) {
  for (size_t i = 0; i < count; ++i)
    for (size_t j = i > reach ? i - reach : 0; j <= std::min(i + reach, count - 1); ++j)
      into[begin + i * stride] += values[begin + j * stride];
}

/// Sums over the (2 reach + 1)^2 surroundings of each pixel.
std::vector<double> around(const std::vector<double>& values, size_t width, size_t reach) {
  std::vector<double> rows(values.size(), 0.0), out(values.size(), 0.0);
  const size_t height = values.size() / width;
  for (size_t y = 0; y < height; ++y) add_neighbours(values, y * width, 1, width, reach, rows);
  for (size_t x = 0; x < width; ++x) add_neighbours(rows, x, width, height, reach, out);
  return out;
}

/// Radius in pixels over which the errors of known light are averaged, relative to it: a few sign
/// draws alone would know an error only to a third.
constexpr size_t known_reach_px = 3;

}  // namespace

TracedPicture ViewPasses::picture() const {
  std::vector<const PixelSums*> all;
  for (const PixelSums& sums : sums_) all.push_back(&sums);
  return picture_of(all, camera_.width, camera_.height, paths_);
}

TracedPicture ViewPasses::first_picture() const {
  std::vector<const PixelSums*> some;
  for (size_t i = 0; i < sums_.size(); ++i) {
    const auto at = static_cast<int64_t>(i);
    if (comes_first(static_cast<int>(at % camera_.width), static_cast<int>(at / camera_.width)))
      some.push_back(&sums_[i]);
  }
  return picture_of(some, (camera_.width + 1) / 2, (camera_.height + 1) / 2, first_paths_);
}

namespace {

/// The relative variance of the mean known luminance of each pixel that is common to many pixels'
/// paths.
std::vector<double> known_variances(const std::vector<const PixelSums*>& all, size_t width) {
  std::vector<double> squares, variances;
  for (const PixelSums* sums : all) {
    const double count = sums->paths();
    squares.push_back(sums->known() * sums->known() / (count * count));
    variances.push_back(sums->known_variance() / (count * count));
  }
  squares = around(squares, width, known_reach_px);
  variances = around(variances, width, known_reach_px);
  for (size_t i = 0; i < all.size(); ++i)
    variances[i] = squares[i] > 0 ? std::max(0.0, variances[i]) / squares[i] : 0;
  return variances;
}

/// Puts the light of a pixel's paths into a picture; `share`: the weight of each half in the mean.
void put_light(const PixelSums& sums, size_t pixel, const HalfShares& share, TracedPicture& out) {
  for (const size_t h : {size_t{0}, size_t{1}}) {
    if (sums.paths(h) == 0) continue;
    const double count = sums.paths(h);
    HalfPicture& half = out.noisy.half[h];
    half.paths[pixel] = static_cast<float>(count);
    for (size_t c = 0; c < light_channels; ++c) {
      const size_t at = light_channels * pixel + c;
      out.emitted[at] += static_cast<float>(share[h] * sums.straight(h, c) / count);
      half.light[at] = static_cast<float>(sums.turned(h, c) / count);
      if (c == 3) continue;
      half.variance[3 * pixel + c] =
          static_cast<float>(variance_of_mean(sums.turned(h, c), sums.turned_squares(h, c), count));
    }
  }
  const ChannelLight light = sums.mean(share);
  for (const size_t c : {size_t{0}, size_t{1}, size_t{2}})
    out.light.xyz[3 * pixel + c] = static_cast<float>(light[c]);
  out.light.scotopic[pixel] = static_cast<float>(light[3]);
}

}  // namespace

TracedPicture ViewPasses::picture_of(const std::vector<const PixelSums*>& all, int width,
                                     int height, int paths_of_all) const {
  TracedPicture out = empty_picture(width, height);
  const HalfShares share = shares_of_halves(paths_of_all);
  const std::vector<double> of_known = known_variances(all, static_cast<size_t>(width));
  for (size_t i = 0; i < all.size(); ++i) {
    const PixelSums& sums = *all[i];
    const double paths = sums.paths();
    put_light(sums, i, share, out);
    const double known = sums.known() / paths;
    const double of_flux = paths < 2 ? 0 : of_known[i] * known * known * paths / (paths - 1);
    out.flux_error_y[i] = static_cast<float>(std::sqrt(of_flux));
    out.standard_error_y[i] =
        static_cast<float>(std::sqrt(sums.luminance_variance(share) + of_flux));
    for (size_t k = 0; k < picture_features; ++k)
      out.noisy.features[picture_features * i + k] = static_cast<float>(sums.feature(k) / paths);
  }
  return out;
}

TracedPicture trace_picture(const LocalRun& run, size_t camera, const PictureOptions& options,
                            const RadianceCache* flux, const ShareDone& progress) {
  ViewPasses view(run, run.scene().description->cameras[camera], camera, flux,
                  make_emitter_sight(run.scene()), options.flames_at_s);
  const int even = even_paths(options), more = options.paths_per_pixel - even;
  const double share = static_cast<double>(even) / options.paths_per_pixel;
  const auto tell = [&](double done) {
    if (progress) progress(done);
  };
  bool whole = view.add(even, options, [&](double done) { tell(share * done); });
  if (whole && more > 0)
    whole = view.add_allocated(view.allocate(more), more, options,
                               [&](double done) { tell(share + (1 - share) * done); });
  return whole ? view.picture() : TracedPicture{};
}

double relative_error(const XyzPicture& light, const std::vector<float>& standard_error_y) {
  constexpr double darkest = 0.01, left_out = 0.01;
  const auto luminance = [&](size_t i) { return static_cast<double>(light.xyz[3 * i + 1]); };
  double mean = 0;
  for (size_t i = 0; i < light.pixels(); ++i)
    mean += luminance(i) / static_cast<double>(light.pixels());
  std::vector<double> squares;
  for (size_t i = 0; i < light.pixels(); ++i) {
    const double against = std::max(luminance(i), darkest * mean);
    const auto error = static_cast<double>(standard_error_y[i]);
    if (std::isnan(error)) return error;
    squares.push_back(against > 0 ? error * error / (against * against) : 0);
  }
  std::sort(squares.begin(), squares.end());
  squares.resize(squares.size() -
                 static_cast<size_t>(left_out * static_cast<double>(squares.size())));
  double sum = 0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

namespace {

double mean_turned_luminance(const NoisyPicture& noisy) {
  double sum = 0;
  for (const HalfPicture& half : noisy.half)
    for (size_t i = 0; i < noisy.pixels(); ++i)
      sum += static_cast<double>(half.light[light_channels * i + luminance_channel]);
  return sum / (2 * static_cast<double>(noisy.pixels()));
}

/// Attenuates features by smoke: a surface behind smoke must not weigh more in the fit than its
/// light does in the picture. Adds a feature of emitted light, in [0, 1), which separates the glow
/// on a lamp from its surroundings.
NoisyPicture with_seen_features(const TracedPicture& traced) {
  constexpr size_t transmittance = 4, count = picture_features + 1;
  NoisyPicture out = traced.noisy;
  out.feature_count = count;
  out.features.resize(count * out.pixels());
  const double mean = mean_turned_luminance(out);
  for (size_t i = 0; i < out.pixels(); ++i) {
    const float* features = &traced.noisy.features[picture_features * i];
    float* seen = &out.features[count * i];
    for (size_t k = 0; k < picture_features; ++k)
      seen[k] = k == transmittance ? features[k] : features[k] * features[transmittance];
    const auto emitted =
        static_cast<double>(traced.emitted[light_channels * i + luminance_channel]);
    seen[picture_features] = emitted > 0 ? static_cast<float>(emitted / (emitted + mean)) : 0;
  }
  return out;
}

}  // namespace

FilteredView filter_traced(const TracedPicture& traced, int threads,
                           const RegressionFilter& filter) {
  FilteredPicture filtered = filter_picture(with_seen_features(traced), filter, shared_by(threads));
  FilteredView out;
  out.light.width = traced.light.width;
  out.light.height = traced.light.height;
  for (size_t i = 0; i < traced.light.pixels(); ++i) {
    const auto value = [&](size_t c) {
      return filtered.light[light_channels * i + c] + traced.emitted[light_channels * i + c];
    };
    for (const size_t c : {size_t{0}, size_t{1}, size_t{2}}) out.light.xyz.push_back(value(c));
    out.light.scotopic.push_back(value(3));
  }
  // Both halves end in the same flux: its error does not show in their difference, and filtering
  // does not increase it.
  for (size_t i = 0; i < traced.light.pixels(); ++i)
    out.standard_error_y.push_back(
        std::hypot(filtered.standard_error_y[i], traced.flux_error_y[i]));
  return out;
}

}  // namespace luxodus
