// Samples and densities of emitters for callers outside the tracing loops, compiled once. They are
// sampled as the tracer does. One thread or fiber at a time.
#pragma once

#include <vector>

#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Start and direction of an emitted particle [local coordinates].
struct EmittedRay {
  EmissionPoint point;
  Vec3 direction;
};

/// The first particles that an emitter sends for a seed, drawn from the stream `layout`.
std::vector<EmittedRay> emitted_rays(const CompiledScene& scene, const GeometryAccess& access,
                                     uint32_t emitter, uint64_t seed, int count);

/// Density [1/sr] of directions at a point of an emitter; 0 for collimated light.
Real emitted_density(const CompiledScene& scene, const GeometryAccess& access, uint32_t emitter,
                     const EmissionPoint& point, const Vec3& direction);

/// Transmittance of the media in the middle band along a line of this length.
double media_share(const CompiledScene& scene, const GeometryAccess& access, const Vec3& from,
                   const Vec3& direction, Real length_m);

}  // namespace luxodus
