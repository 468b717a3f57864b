// The light that emitters send out, for whoever asks of emitters rather than of particles. It is
// drawn as the tracer draws it, by code that is compiled once. One thread or fiber at a time.
#pragma once

#include <vector>

#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Where and whither a particle is sent [local coordinates].
struct EmittedRay {
  EmissionPoint point;
  Vec3 direction;
};

/// The first particles of a seed that an emitter sends out, by draws of the stream `layout`.
std::vector<EmittedRay> emitted_rays(const CompiledScene& scene, const GeometryAccess& access,
                                     uint32_t emitter, uint64_t seed, int count);

/// Density [1/sr] of directions at a point of an emitter; 0 for collimated light.
Real emitted_density(const CompiledScene& scene, const GeometryAccess& access, uint32_t emitter,
                     const EmissionPoint& point, const Vec3& direction);

/// Share of light in the middle band that the media let pass along a line of that length.
double media_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& direction, Real length_m);

}  // namespace luxodus
