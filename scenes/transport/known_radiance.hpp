// What a path in a picture may end in: light that is known from a run's flux (final gather).
#pragma once

#include "scenes/intersect/ray.hpp"
#include "scenes/optics/phase_function.hpp"

namespace luxodus {

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
};

}  // namespace luxodus
