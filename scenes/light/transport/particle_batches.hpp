// The interface of a kernel, independent of the particle loop (particle.hpp), so that a change of
// the loop recompiles only the kernels' sources (kernel_*.cpp). One object per thread or fiber.
#pragma once

#include <memory>

#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Particles only; eye paths are compiled once, not once per kernel.
class ParticleBatches {
 public:
  virtual ~ParticleBatches() = default;
  virtual void trace(int group, uint64_t first, int64_t count, BatchScores& scores) = 0;
};

/// The kernel for this need of media and the scene's other features; defined in one source per
/// need.
template <MediaNeed Media>
std::unique_ptr<ParticleBatches> choose_kernel(const CompiledScene& scene,
                                               const GeometryAccess& access, uint64_t seed);

extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::none>(
    const CompiledScene&, const GeometryAccess&, uint64_t);
extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::homogeneous>(
    const CompiledScene&, const GeometryAccess&, uint64_t);
extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::layered>(
    const CompiledScene&, const GeometryAccess&, uint64_t);
extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::general>(
    const CompiledScene&, const GeometryAccess&, uint64_t);

}  // namespace luxodus
