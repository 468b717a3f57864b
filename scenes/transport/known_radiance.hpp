// What a path in a picture may end in: light that is known from a run's flux (final gather).
#pragma once

#include <cstdint>

#include "scenes/intersect/ray.hpp"
#include "scenes/optics/phase_function.hpp"

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

/// Implemented where flux is collected. Any thread.
class KnownRadiance {
 public:
  virtual ~KnownRadiance() = default;

  /// Outgoing radiance of a surface [W/(m2 sr)].
  virtual double of_surface(const Hit& hit, bool front, int band) const = 0;

  /// Whether the light that passes a place in a medium is known.
  virtual bool knows(const Vec3& place) const = 0;
  /// Radiance [W/(m2 sr)] that one scattering of all light there sends against `direction`, direct
  /// light included. Requires: knows(place).
  virtual double of_medium(const Vec3& place, const Vec3& direction, const PhaseFunction& phase,
                           int band) const = 0;

  /// Of `of_surface` and `of_medium`, all bands together.
  virtual KnownError error_of_surface(const Hit& hit, bool front) const = 0;
  virtual KnownError error_of_medium(const Vec3& place, const Vec3& direction,
                                     const PhaseFunction& phase) const = 0;
};

}  // namespace luxodus
