// Tracing. A path carries all bands, and one of them, its hero, decides how it goes on. Places in a
// pixel and heroes are drawn together by points of one scrambled Sobol' set, so that the paths of a
// pixel are spread over its area and over the bands at once. Standard errors take them as
// independent, which errs on the safe side.
#include "actors/display/pictures.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>

#include "actors/run/parallel_for.hpp"
#include "scenes/optics/sampling.hpp"

namespace luxodus {

namespace {

/// A path's number: camera, pixel (28 bits), path.
constexpr int camera_shift = 48;
constexpr int pixel_shift = 17;

/// A camera without a lens: every ray passes through one point.
class Pinhole {
 public:
  Pinhole(const Camera& camera, const glm::dvec3& local_origin)
      : eye_(camera.eye - local_origin), width_(camera.width), height_(camera.height) {
    forward_ = glm::normalize(camera.target - camera.eye);
    glm::dvec3 right = glm::cross(forward_, camera.up);
    if (glm::length(right) < 1e-9 * glm::length(camera.up)) {
      // Looking along `up`: any direction across will do; y is up on a plan.
      const glm::dvec3 other =
          std::abs(forward_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
      right = glm::cross(forward_, other);
    }
    right = glm::normalize(right);
    const double half = std::tan(glm::radians(camera.vertical_fov_deg) / 2);
    up_ = glm::cross(right, forward_) * half;
    right_ = right * (half * camera.width / camera.height);
  }

  /// Through a place in pixels from the picture's upper left corner.
  Ray ray(double x, double y) const {
    const glm::dvec3 d = forward_ + right_ * (2 * x / width_ - 1) + up_ * (1 - 2 * y / height_);
    return {glm::vec3(eye_), glm::vec3(glm::normalize(d))};
  }

 private:
  glm::dvec3 eye_, forward_, right_, up_;
  double width_, height_;
};

/// Pixels that one fiber traces in one go.
constexpr int columns_at_once = 32;

/// Light by channels of a picture: X, Y, Z, scotopic.
struct ChannelLight {
  std::array<double, light_channels> values{};

  void add(const Bands& bands, std::span<const double> radiance) {
    for (size_t b = 0; b < radiance.size(); ++b) {
      const Band& band = bands[static_cast<int>(b)];
      values[0] += radiance[b] * band.x_per_w;
      values[1] += radiance[b] * band.lm_per_w;
      values[2] += radiance[b] * band.z_per_w;
      values[3] += radiance[b] * band.scotopic_lm_per_w;
    }
  }
};

/// Sums over some of a pixel's paths.
struct PathSums {
  double paths = 0;
  std::array<double, light_channels> light{}, squares{};

  void add(const ChannelLight& path) {
    paths += 1;
    for (size_t c = 0; c < light_channels; ++c) {
      light[c] += path.values[c];
      squares[c] += path.values[c] * path.values[c];
    }
  }
  double mean(size_t c) const { return light[c] / paths; }
  /// Of the mean. NaN with one path.
  double variance(size_t c) const {
    if (paths < 2) return std::numeric_limits<double>::quiet_NaN();
    return std::max(0.0, squares[c] / paths - mean(c) * mean(c)) / (paths - 1);
  }
};

/// What the paths of one pixel have found.
struct PixelSums {
  PathSums all;                  // everything
  std::array<PathSums, 2> half;  // of half of the paths each, without what emitters send straight
  PathSums emitted;              // that
  std::array<double, picture_features> features{};
};

/// Traces the pixels of one picture; one per thread.
class PixelTracer {
 public:
  PixelTracer(const LocalRun& run, const GeometryAccess& access, size_t camera,
              const PictureOptions& options, const KnownRadiance* flux)
      : scene_(run.scene()),
        tracer_(make_picture_tracer(run.scene(), access, run.seed())),
        pinhole_(run.scene().description->cameras[camera], run.scene().local_origin),
        first_path_(static_cast<uint64_t>(camera) << camera_shift),
        paths_(options.paths_per_pixel),
        flux_(flux) {
    white_.add(scene_.bands, std::vector<double>(static_cast<size_t>(scene_.bands.count()), 1.0));
  }

  PixelSums trace(int column, int row, uint64_t pixel) {
    const uint64_t first = first_path_ + (pixel << pixel_shift);
    PixelSums sums;
    for (int i = 0; i < paths_; ++i) {
      tracer_->start(first, static_cast<uint32_t>(paths_), static_cast<uint32_t>(i));
      const auto x = static_cast<double>(tracer_->uniform());
      const auto y = static_cast<double>(tracer_->uniform());
      const int hero = tracer_->choose_band(static_cast<double>(tracer_->uniform()));
      const Ray ray = pinhole_.ray(column + x, row + y);
      ChannelLight turned;
      turned.add(scene_.bands, tracer_->radiance(ray, hero, flux_));
      sums.half[i < paths_ / 2 ? 0 : 1].add(turned);
      tracer_->meet_first(ray, first_);
      ChannelLight straight;
      straight.add(scene_.bands, first_.emitted);
      sums.emitted.add(straight);
      for (size_t c = 0; c < light_channels; ++c) turned.values[c] += straight.values[c];
      sums.all.add(turned);
      add_features(sums.features);
    }
    return sums;
  }

 private:
  /// Means over the paths of the normal, the nearness, the transmittance and the albedo's X, Y, Z.
  void add_features(std::array<double, picture_features>& into) const {
    ChannelLight reflected;
    reflected.add(scene_.bands, first_.reflectance);
    const std::array<double, picture_features> own{static_cast<double>(first_.normal.x),
                                                   static_cast<double>(first_.normal.y),
                                                   static_cast<double>(first_.normal.z),
                                                   first_.nearness,
                                                   first_.transmittance,
                                                   reflected.values[0] / white_.values[0],
                                                   reflected.values[1] / white_.values[1],
                                                   reflected.values[2] / white_.values[2]};
    for (size_t k = 0; k < picture_features; ++k) into[k] += own[k] / paths_;
  }

  const CompiledScene& scene_;
  std::unique_ptr<PictureTracer> tracer_;
  Pinhole pinhole_;
  uint64_t first_path_;
  int paths_;
  const KnownRadiance* flux_;
  ChannelLight white_;  // of a reflectance of 1 in all bands
  FirstHit first_;      // of the last path
};

/// Room for a picture of so many pixels.
TracedPicture empty_picture(const Camera& view) {
  TracedPicture out;
  out.light.width = out.noisy.width = view.width;
  out.light.height = out.noisy.height = view.height;
  const size_t pixels = out.light.pixels();
  out.light.xyz.resize(3 * pixels);
  out.light.scotopic.resize(pixels);
  out.standard_error_y.resize(pixels);
  out.emitted.resize(light_channels * pixels);
  for (HalfPicture& half : out.noisy.half) {
    half.light.resize(light_channels * pixels);
    half.variance.resize(3 * pixels);
  }
  out.noisy.feature_count = picture_features;
  out.noisy.features.resize(picture_features * pixels);
  return out;
}

void store(const PixelSums& sums, size_t pixel, TracedPicture& out) {
  for (size_t c = 0; c < light_channels; ++c) {
    const size_t at = light_channels * pixel + c;
    (c < 3 ? out.light.xyz[3 * pixel + c] : out.light.scotopic[pixel]) =
        static_cast<float>(sums.all.mean(c));
    out.emitted[at] = static_cast<float>(sums.emitted.mean(c));
    for (size_t h : {size_t{0}, size_t{1}}) {
      if (sums.half[h].paths == 0) continue;
      out.noisy.half[h].light[at] = static_cast<float>(sums.half[h].mean(c));
      if (c < 3)
        out.noisy.half[h].variance[3 * pixel + c] = static_cast<float>(sums.half[h].variance(c));
    }
  }
  out.standard_error_y[pixel] = static_cast<float>(std::sqrt(sums.all.variance(1)));
  for (size_t k = 0; k < picture_features; ++k)
    out.noisy.features[picture_features * pixel + k] = static_cast<float>(sums.features[k]);
}

}  // namespace

TracedPicture trace_picture(const LocalRun& run, size_t camera, const PictureOptions& options,
                            const KnownRadiance* flux, const ShareDone& progress) {
  const Camera& view = run.scene().description->cameras[camera];
  TracedPicture out = empty_picture(view);
  // Parts of a row, so that there is work for many fibers.
  const int parts = (view.width + columns_at_once - 1) / columns_at_once;
  const auto make = [&](const GeometryAccess& access) {
    auto tracer = std::make_shared<PixelTracer>(run, access, camera, options, flux);
    return [&, tracer](int64_t unit) {
      const int row = static_cast<int>(unit / parts);
      const int first = static_cast<int>(unit % parts) * columns_at_once;
      for (int column = first; column < std::min(first + columns_at_once, view.width); ++column) {
        if (options.interrupted()) return;
        const auto pixel = static_cast<size_t>(int64_t{row} * view.width + column);
        store(tracer->trace(column, row, pixel), pixel, out);
      }
    };
  };
  const int64_t units = int64_t{view.height} * parts;
  run.rows().run(units, make, [&](int64_t done) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(units));
  });
  return out;
}

namespace {

/// Features as the smoke lets them be seen: a surface behind it must not show in the fit more than
/// its light does in the picture.
NoisyPicture seen_through_smoke(NoisyPicture noisy) {
  constexpr size_t transmittance = 4;
  for (size_t i = 0; i < noisy.pixels(); ++i) {
    float* features = &noisy.features[picture_features * i];
    for (size_t k = 0; k < picture_features; ++k)
      if (k != transmittance) features[k] *= features[transmittance];
  }
  return noisy;
}

}  // namespace

FilteredView filter_traced(const TracedPicture& traced, int threads) {
  const ShareWork share = [&](int64_t count, const std::function<void(int64_t)>& work) {
    parallel_for(count, threads, [&] { return work; });
  };
  FilteredPicture filtered = filter_picture(seen_through_smoke(traced.noisy), {}, share);
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
  out.standard_error_y = std::move(filtered.standard_error_y);
  return out;
}

}  // namespace luxodus
