// Rays answered by Embree alone: the yardstick that benchmarks hold the tracer against. Nothing of
// a hit is read but what proves that the work was done. Any thread.
#pragma once

#include <cstdint>
#include <span>

#include "scenes/intersect/embree_scene.hpp"

namespace luxodus {

/// Calls rtcIntersect1 for every ray, in order; the sum of the triangles hit.
uint64_t replay_rays(const CellScene& scene, std::span<const Ray> rays);

}  // namespace luxodus
