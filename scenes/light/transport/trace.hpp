// The entry point for callers that trace a scene, for any kernel and partition. It includes no
// template of a resolver, so that callers compile quickly. Thread rule: one tracer per thread or
// fiber.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/direct_light.hpp"
#include "scenes/light/transport/first_hit.hpp"
#include "scenes/light/transport/radiance_cache.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Traces batches of one scene, one thread or fiber at a time.
class BatchTracer {
 public:
  virtual ~BatchTracer() = default;
  /// Traces particles [first, first + count) of a source group into `scores`: a batch, or a portion
  /// of one, whose scores add up.
  virtual void trace(int group, uint64_t first, int64_t count, BatchScores& scores) = 0;
  /// The eye paths of a batch number are divided into independent units: parts of signs, and
  /// probes.
  virtual uint32_t look_units() const = 0;
  /// Traces the eye paths of one unit into `scores`.
  virtual void look(int64_t batch, uint32_t unit, BatchScores& scores) = 0;
  /// Has look() call `rest` after every path. In near-white rooms a unit takes seconds, and a fiber
  /// must let others run meanwhile.
  virtual void rest_between_paths(std::function<void()> /*rest*/) {}
};

/// The kernel for the scene's features. All references must outlive it.
std::unique_ptr<BatchTracer> make_batch_tracer(const CompiledScene& scene,
                                               const GeometryAccess& access, uint64_t seed);

/// Direct light through whichever resolver the access needs; one thread or fiber at a time.
DirectLight direct_light_at(const CompiledScene& scene, const GeometryAccess& access,
                            const Vec3& point, const Vec3& normal, const DirectOptions& options);

/// Radiance along one ray of a picture [W/(m2 sr)]; see PathTracer.
class PictureTracer {
 public:
  virtual ~PictureTracer() = default;
  /// Shows steady flames at a moment (flame_shape.hpp) instead of their mean.
  virtual void show_flames_at(double time_s) = 0;
  /// Starts path number `path` of `count` in a set whose first draws are low-discrepancy points.
  virtual void start(uint64_t set, uint32_t count, uint32_t path) = 0;
  virtual Real uniform() = 0;
  /// Chooses the hero of a path of all bands, from a uniform number.
  virtual int choose_band(double u) const = 0;
  /// Radiance by band, from one path sampled for the hero; valid until the next call. Light that
  /// emitters send straight to the eye is excluded and returned in `first`, free of noise, if that
  /// is not null. `first` keeps its memory.
  virtual std::span<const double> radiance(const Ray& ray, int hero, const RadianceCache* gather,
                                           FirstHit* first) = 0;
  /// Cached light at which the parts of the last path of radiance() have ended.
  virtual std::span<const CachedEnd> ends() const = 0;
  /// Radiance in one band, from a path of that band alone.
  virtual double radiance_in_band(const Ray& ray, int band, const RadianceCache* gather) = 0;
};

class EmitterSight;
/// Data for the light sampler of pictures, learned during tracing; shared by all tracers of a
/// scene. Requires: the scene outlives it. Null if there is nothing to choose.
std::shared_ptr<const EmitterSight> make_emitter_sight(const CompiledScene& scene);

/// Largest memory that it takes [bytes]; 0 if there is nothing to choose.
uint64_t emitter_sight_bytes(const CompiledScene& scene);

/// `sight`: that of the scene, or null to choose emitters by power and distance alone.
std::unique_ptr<PictureTracer> make_picture_tracer(const CompiledScene& scene,
                                                   const GeometryAccess& access, uint64_t seed,
                                                   std::shared_ptr<const EmitterSight> sight);

/// "layered media, 8 bands, ...": what the chosen kernel contains, and what it omits.
std::string describe_kernel(const CompiledScene& scene);

}  // namespace luxodus
