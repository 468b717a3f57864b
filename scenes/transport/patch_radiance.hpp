// What a path in a picture ends in: the light that patches send out, known from their flux.
#pragma once

#include "scenes/intersect/ray.hpp"

namespace luxodus {

/// Outgoing radiance of a patch, for final gathers: [W/(m2 sr)]. Implemented where flux is
/// collected.
class PatchRadiance {
 public:
  virtual ~PatchRadiance() = default;
  virtual double radiance(const Hit& hit, bool front, int band) const = 0;
};

}  // namespace luxodus
