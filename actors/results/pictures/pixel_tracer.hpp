// Traces the paths of pixels; the caller sums them up. A path carries all bands, and one of them,
// its hero, decides its directions. Positions in a pixel and heroes are drawn together from one
// scrambled Sobol' set, so that the paths of a pixel are spread evenly over its area and over the
// bands. Thread rule: one thread or fiber.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "actors/results/pictures/pixel_sums.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

namespace limits {
inline constexpr int max_paths_per_pixel = 1 << 16;  // 17 bits of a path's number
inline constexpr int max_picture_edge = 1 << 14;     // also of a scene's cameras
}  // namespace limits

/// A camera without a lens: every ray passes through one point.
class Pinhole {
 public:
  Pinhole(const Camera& camera, const glm::dvec3& local_origin);

  /// The ray through a position in pixels from the picture's upper left corner. Where the camera
  /// cuts, it begins at the cut; one that does not meet the cut meets nothing.
  Ray ray(double x, double y) const;
  /// The position in pixels of a place [m, local]; nothing if it is behind the camera or outside
  /// the picture.
  std::optional<glm::dvec2> pixel_of(const glm::dvec3& place) const;

 private:
  glm::dvec3 eye_, forward_, right_, up_;
  double width_, height_;      // of the picture [px]
  std::optional<double> cut_;  // local height
};

class PixelTracer {
 public:
  /// `number`: seeds the random numbers, one per camera; below 2^16. `flux`: the light that paths
  /// end in, or null.
  /// `sight`: from make_emitter_sight. `flames_at_s`: the moment of steady flames; nothing: their
  /// mean. Requires: what is referred to outlives this.
  PixelTracer(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed,
              const Camera& camera, uint64_t number, const RadianceCache* flux,
              std::shared_ptr<const EmitterSight> sight, std::optional<double> flames_at_s);

  /// Adds paths of a pixel; `pixel`: row * width + column, below 2^28.
  /// Requires: ends <= limits::max_paths_per_pixel.
  void trace(int column, int row, uint64_t pixel, const PathRange& paths, PixelSums& sums);

 private:
  void start(uint64_t first, int path);
  ChannelLight light_of(std::span<const double> radiance) const;
  std::array<double, picture_features> features() const;

  const CompiledScene& scene_;
  std::unique_ptr<PictureTracer> tracer_;
  Pinhole pinhole_;
  uint64_t first_path_;
  const RadianceCache* flux_;
  ChannelLight white_;  // of reflectance 1 in all bands
  FirstHit first_;      // of the last path
};

}  // namespace luxodus
