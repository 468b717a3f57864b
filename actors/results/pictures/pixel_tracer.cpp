#include "actors/results/pictures/pixel_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace luxodus {

namespace {

/// A path's number: camera, pixel (28 bits), path.
constexpr int camera_shift = 48;
constexpr int pixel_shift = 17;
/// So far above an eye there is nothing.
constexpr double far_m = 1e6;

}  // namespace

Pinhole::Pinhole(const Camera& camera, const glm::dvec3& local_origin)
    : eye_(camera.eye - local_origin), width_(camera.width), height_(camera.height) {
  forward_ = glm::normalize(camera.target - camera.eye);
  glm::dvec3 right = glm::cross(forward_, camera.up);
  if (glm::length(right) <= 1e-9 * glm::length(camera.up)) {
    // If the gaze is along `up`, any perpendicular direction will do; y is up on a plan.
    const glm::dvec3 other = std::abs(forward_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    right = glm::cross(forward_, other);
  }
  right = glm::normalize(right);
  if (camera.cut_m) cut_ = *camera.cut_m - local_origin.z;
  const double half = std::tan(glm::radians(camera.vertical_fov_deg) / 2);
  up_ = glm::cross(right, forward_) * half;
  right_ = right * (half * camera.width / camera.height);
}

Ray Pinhole::ray(double x, double y) const {
  const glm::dvec3 d = forward_ + right_ * (2 * x / width_ - 1) + up_ * (1 - 2 * y / height_);
  const glm::dvec3 direction = glm::normalize(d);
  if (!cut_) return {glm::vec3(eye_), glm::vec3(direction)};
  if (!(direction.z < 0)) return {glm::vec3(eye_ + glm::dvec3(0, 0, far_m)), {0, 0, 1}};
  const double to_cut = (*cut_ - eye_.z) / direction.z;
  return {glm::vec3(eye_ + direction * to_cut), glm::vec3(direction)};
}

std::optional<glm::dvec2> Pinhole::pixel_of(const glm::dvec3& place) const {
  const glm::dvec3 way = place - eye_;
  const double ahead = glm::dot(way, forward_);
  if (!(ahead > 0)) return std::nullopt;
  // `right_` and `up_` are half the picture's width and height at a distance of 1.
  const double right = glm::dot(way, right_) / (ahead * glm::dot(right_, right_));
  const double up = glm::dot(way, up_) / (ahead * glm::dot(up_, up_));
  const glm::dvec2 at{(right + 1) / 2 * width_, (1 - up) / 2 * height_};
  if (!(at.x >= 0 && at.x < width_ && at.y >= 0 && at.y < height_)) return std::nullopt;
  return at;
}

PixelTracer::PixelTracer(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed,
                         const Camera& camera, uint64_t number, const RadianceCache* flux,
                         std::shared_ptr<const EmitterSight> sight,
                         std::optional<double> flames_at_s)
    : scene_(scene),
      tracer_(make_picture_tracer(scene, access, seed, std::move(sight))),
      pinhole_(camera, scene.local_origin),
      first_path_(number << camera_shift),
      flux_(flux),
      white_(light_of(std::vector<double>(static_cast<size_t>(scene.bands.count()), 1.0))) {
  if (flames_at_s) tracer_->show_flames_at(*flames_at_s);
}

void PixelTracer::trace(int column, int row, uint64_t pixel, const PathRange& paths,
                        PixelSums& sums) {
  const uint64_t first = first_path_ + (pixel << pixel_shift);
  for (int i = paths.begin; i < std::max(paths.ends[0], paths.ends[1]); ++i) {
    if (i >= paths.ends[half_of(i)]) continue;
    start(first, i);
    const auto x = static_cast<double>(tracer_->uniform());
    const auto y = static_cast<double>(tracer_->uniform());
    const int hero = tracer_->choose_band(static_cast<double>(tracer_->uniform()));
    const Ray ray = pinhole_.ray(column + x, row + y);
    const ChannelLight turned = light_of(tracer_->radiance(ray, hero, flux_, &first_));
    sums.add(i, turned, light_of(first_.emitted), tracer_->ends(), features());
  }
}

/// The first paths use a smaller set of points: making one for all paths takes longer than tracing
/// them. Points do not depend on the size of the set.
void PixelTracer::start(uint64_t first, int path) {
  constexpr int few = 64;
  if (path < few) return tracer_->start(first, few, static_cast<uint32_t>(path));
  tracer_->start(first + limits::max_paths_per_pixel, limits::max_paths_per_pixel,
                 static_cast<uint32_t>(path - few));
}

ChannelLight PixelTracer::light_of(std::span<const double> radiance) const {
  ChannelLight out{};
  for (size_t b = 0; b < radiance.size(); ++b) {
    const Band& band = scene_.bands[static_cast<int>(b)];
    out[0] += radiance[b] * band.x_per_w;
    out[1] += radiance[b] * band.lm_per_w;
    out[2] += radiance[b] * band.z_per_w;
    out[3] += radiance[b] * band.scotopic_lm_per_w;
  }
  return out;
}

/// The normal, the nearness, the transmittance and the albedo's X, Y, Z.
std::array<double, picture_features> PixelTracer::features() const {
  const ChannelLight reflected = light_of(first_.reflectance);
  return {static_cast<double>(first_.normal.x),
          static_cast<double>(first_.normal.y),
          static_cast<double>(first_.normal.z),
          first_.nearness,
          first_.transmittance,
          reflected[0] / white_[0],
          reflected[1] / white_[1],
          reflected[2] / white_[2]};
}

}  // namespace luxodus
