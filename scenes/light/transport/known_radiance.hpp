// What a path in a picture may end in: light that is known from a run's flux (final gather).
#pragma once

#include <cstdint>

#include "scenes/light/intersect/ray.hpp"
#include "scenes/light/optics/phase_function.hpp"

namespace luxodus {

/// What known light errs by: whoever ends in the same bin errs alike.
struct KnownError {
  uint64_t bin = 0;
  double relative = 0;  // standard error of the luminance, by the luminance
};

/// Where a path, or a part of one, has ended in known light.
struct KnownEnd {
  KnownError error;
  double luminance = 0;  // that it brings from there [cd/m2]
};

/// What is known of the light that passes a place in a medium.
enum class Known : uint8_t {
  nothing,
  scattered,  // what comes from other collisions
  all,
};

/// Implemented where flux is collected. Any thread.
class KnownRadiance {
 public:
  virtual ~KnownRadiance() = default;

  /// Outgoing radiance of a surface [W/(m2 sr)].
  virtual double of_surface(const Hit& hit, bool front, int band) const = 0;

  /// `diffused`: for a path that an event has spread over directions.
  virtual Known known_at(const Vec3& place, bool diffused) const = 0;
  /// A voxel that stands for a place where as much is known, by three uniform numbers: the mean
  /// over them changes continuously with the place.
  virtual uint32_t choose_voxel(const Vec3& place, const Vec3& chance, Known which) const = 0;
  /// Radiance [W/(m2 sr)] that one scattering of the light in a voxel, as `which` says, sends
  /// against `direction`. Requires: choose_voxel has chosen it for as much.
  virtual double of_medium(uint32_t voxel, const Vec3& direction, const PhaseFunction& phase,
                           int band, Known which) const = 0;

  /// Of `of_surface` and `of_medium`, all bands together.
  virtual KnownError error_of_surface(const Hit& hit, bool front) const = 0;
  virtual KnownError error_of_medium(uint32_t voxel, const Vec3& direction,
                                     const PhaseFunction& phase, Known which) const = 0;
};

/// Where a path of a picture may end.
struct PathEnds {
  const KnownRadiance* known = nullptr;  // null: nowhere
  bool diffused = false;                 // an event has spread the path over directions

  /// Of what the eye sees at first, or by mirrors alone, light straight from emitters and surfaces
  /// is sampled: beams, shadows and reflections in smoke keep their edges.
  Known in_medium(const Vec3& place) const {
    return known != nullptr ? known->known_at(place, diffused) : Known::nothing;
  }
  bool on_surfaces() const { return known != nullptr && diffused; }
};

}  // namespace luxodus
