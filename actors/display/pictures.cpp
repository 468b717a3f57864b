// Tracing. Pixels and bands are sampled together by Roberts' R3 sequence, shifted at random for
// every pixel: the paths of a pixel are spread over its area and over the bands at once, without
// making one depend on the other. Standard errors take them as independent, which errs on the safe
// side.
#include "actors/display/pictures.hpp"

#include <atomic>
#include <cmath>
#include <limits>

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

/// Light of one pixel.
struct PixelSums {
  double x = 0, y = 0, z = 0, scotopic = 0, y_squares = 0;

  void add(const Band& band, double radiance) {
    const double luminance = radiance * band.lm_per_w;
    x += radiance * band.x_per_w;
    y += luminance;
    z += radiance * band.z_per_w;
    scotopic += radiance * band.scotopic_lm_per_w;
    y_squares += luminance * luminance;
  }
  double standard_error(double paths) const {
    if (paths < 2) return std::numeric_limits<double>::quiet_NaN();
    const double mean = y / paths;
    return std::sqrt(std::max(0.0, y_squares / paths - mean * mean) / (paths - 1));
  }
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
        flux_(flux) {}

  PixelSums trace(int column, int row, uint64_t pixel) {
    const uint64_t first = first_path_ + (pixel << pixel_shift);
    PixelSums sums;
    for (int i = 0; i < paths_; ++i) {
      tracer_->start(first, static_cast<uint32_t>(paths_), static_cast<uint32_t>(i));
      const auto x = static_cast<double>(tracer_->uniform());
      const auto y = static_cast<double>(tracer_->uniform());
      const int band = tracer_->choose_band(static_cast<double>(tracer_->uniform()));
      const double probability = tracer_->band_probability(band);
      const Ray ray = pinhole_.ray(column + x, row + y);
      sums.add(scene_.bands[band], tracer_->radiance(ray, band, flux_) / probability);
    }
    return sums;
  }

 private:
  const CompiledScene& scene_;
  std::unique_ptr<PictureTracer> tracer_;
  Pinhole pinhole_;
  uint64_t first_path_;
  int paths_;
  const KnownRadiance* flux_;
};

}  // namespace

TracedPicture trace_picture(const LocalRun& run, size_t camera, const PictureOptions& options,
                            const KnownRadiance* flux, const ShareDone& progress) {
  const Camera& view = run.scene().description->cameras[camera];
  TracedPicture out;
  out.light.width = view.width;
  out.light.height = view.height;
  out.light.xyz.resize(3 * out.light.pixels());
  out.light.scotopic.resize(out.light.pixels());
  out.standard_error_y.resize(out.light.pixels());
  const double paths = options.paths_per_pixel;
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
        const PixelSums sums = tracer->trace(column, row, pixel);
        out.light.xyz[3 * pixel] = static_cast<float>(sums.x / paths);
        out.light.xyz[3 * pixel + 1] = static_cast<float>(sums.y / paths);
        out.light.xyz[3 * pixel + 2] = static_cast<float>(sums.z / paths);
        out.light.scotopic[pixel] = static_cast<float>(sums.scotopic / paths);
        out.standard_error_y[pixel] = static_cast<float>(sums.standard_error(paths));
      }
    };
  };
  const int64_t units = int64_t{view.height} * parts;
  run.rows().run(units, make, [&](int64_t done) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(units));
  });
  return out;
}

}  // namespace luxodus
