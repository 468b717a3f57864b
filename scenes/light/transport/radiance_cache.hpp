// The radiance cache in which paths of a picture may end: light known from a run's flux (final
// gather). Thread rules: RadianceCache any thread; the others are plain values.
#pragma once

#include <cstdint>

#include "scenes/light/intersect/ray.hpp"
#include "scenes/light/optics/phase_function.hpp"

namespace luxodus {

/// Error of a cached value; paths that end in the same bin share that error.
struct CachedError {
  uint64_t bin = 0;
  double relative = 0;  // relative standard error of the luminance
};

/// Cached light at which a path, or a part of one, has ended.
struct CachedEnd {
  CachedError error;
  double luminance = 0;  // its contribution [cd/m2]
};

/// Which of the light at a place in a medium is in the cache.
enum class CachedLight : uint8_t {
  nothing,
  scattered,  // light from other collisions
  all,
};

/// Implemented where flux is tallied. Any thread.
class RadianceCache {
 public:
  virtual ~RadianceCache() = default;

  /// Outgoing radiance of a surface [W/(m2 sr)].
  virtual double of_surface(const Hit& hit, bool front, int band) const = 0;

  /// `diffused`: whether an event has scattered the path diffusely.
  virtual CachedLight cached_at(const Vec3& place, bool diffused) const = 0;
  /// Chooses a voxel to represent a place, by three uniform numbers, among voxels with as much in
  /// the cache: the mean over them changes continuously with the place.
  virtual uint32_t choose_voxel(const Vec3& place, const Vec3& chance, CachedLight which) const = 0;
  /// Radiance [W/(m2 sr)] against `direction` after one scattering of the light in a voxel, of the
  /// light that `which` names. Requires: choose_voxel chose it for the same `which`.
  virtual double of_medium(uint32_t voxel, const Vec3& direction, const PhaseFunction& phase,
                           int band, CachedLight which) const = 0;

  /// Errors of `of_surface` and `of_medium`, for all bands together.
  virtual CachedError error_of_surface(const Hit& hit, bool front) const = 0;
  virtual CachedError error_of_medium(uint32_t voxel, const Vec3& direction,
                                      const PhaseFunction& phase, CachedLight which) const = 0;
};

/// Rules for ending a path of a picture in the cache.
struct PathEnds {
  const RadianceCache* cache = nullptr;  // null: nowhere
  bool diffused = false;                 // an event has scattered the path diffusely

  /// Which cached light may be used at a collision. Seen directly or through mirrors alone, light
  /// straight from emitters and surfaces is sampled instead: beams, shadows and reflections in
  /// smoke stay sharp.
  CachedLight in_medium(const Vec3& place) const {
    return cache != nullptr ? cache->cached_at(place, diffused) : CachedLight::nothing;
  }
  bool on_surfaces() const { return cache != nullptr && diffused; }
};

}  // namespace luxodus
