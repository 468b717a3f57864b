// Batches: the door through which callers trace a scene, whatever its kernel and its partition. It
// includes no template of a resolver, so that callers compile quickly: those stay behind it.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "scenes/light/geometry/real.hpp"
#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/direct_light.hpp"
#include "scenes/light/transport/first_hit.hpp"
#include "scenes/light/transport/known_radiance.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Traces batches of one scene, one thread or fiber at a time.
class BatchTracer {
 public:
  virtual ~BatchTracer() = default;
  /// Particles [first, first + count) of a source group, into `scores`.
  virtual void trace(int group, uint64_t first, int64_t count, BatchScores& scores) = 0;
  /// The eye paths that belong to a batch number fall into units that stand alone: parts of signs,
  /// and probes.
  virtual uint32_t look_units() const = 0;
  /// Those of one unit, into `scores`.
  virtual void look(int64_t batch, uint32_t unit, BatchScores& scores) = 0;
};

/// The kernel that the scene's features ask for. All that is referred to must outlive it.
std::unique_ptr<BatchTracer> make_batch_tracer(const CompiledScene& scene,
                                               const GeometryAccess& access, uint64_t seed);

/// Direct light through whichever resolver the access needs; one thread or fiber at a time.
DirectLight direct_light_at(const CompiledScene& scene, const GeometryAccess& access,
                            const Vec3& point, const Vec3& normal, const DirectOptions& options);

/// Radiance along one ray of a picture [W/(m2 sr)]; see PathTracer.
class PictureTracer {
 public:
  virtual ~PictureTracer() = default;
  /// Begins path number `path` of `count` in a set, whose first draws are low-discrepancy points.
  virtual void start(uint64_t set, uint32_t count, uint32_t path) = 0;
  virtual Real uniform() = 0;
  /// The hero of a path of all bands, from a uniform number.
  virtual int choose_band(double u) const = 0;
  /// By band, from one path that goes as the hero's; until the next call. But for what emitters
  /// send straight to the eye: `first` has that without chance, where it is asked for (not null).
  /// It keeps its memory.
  virtual std::span<const double> radiance(const Ray& ray, int hero, const KnownRadiance* gather,
                                           FirstHit* first) = 0;
  /// Where the parts of the path of the last radiance() have ended in known light.
  virtual std::span<const KnownEnd> ends() const = 0;
  /// The same in one band, from a path of that band alone.
  virtual double radiance_in_band(const Ray& ray, int band, const KnownRadiance* gather) = 0;
};

class EmitterSight;
/// What paths of pictures choose emitters by, learned as they go; for all tracers of a scene.
/// Requires: the scene outlives it. Null where there is nothing to choose.
std::shared_ptr<const EmitterSight> make_emitter_sight(const CompiledScene& scene);

/// Memory that it takes at most [bytes]; 0 where there is nothing to choose.
uint64_t emitter_sight_bytes(const CompiledScene& scene);

/// `sight`: of the scene, or null where emitters are chosen by power and distance alone.
std::unique_ptr<PictureTracer> make_picture_tracer(const CompiledScene& scene,
                                                   const GeometryAccess& access, uint64_t seed,
                                                   std::shared_ptr<const EmitterSight> sight);

/// "layered media, 8 bands, ...": what the chosen kernel contains, and what it leaves out.
std::string describe_kernel(const CompiledScene& scene);

}  // namespace luxodus
