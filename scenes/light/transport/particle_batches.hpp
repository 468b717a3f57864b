// What a kernel is called by. Knows nothing of the particle loop (particle.hpp), so that a change
// of the loop compiles the sources of the kernels (kernel_*.cpp) again, and no other of the
// program.
#pragma once

#include <memory>

#include "scenes/light/tally/batch_scores.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Particles only; what traces eyes is compiled once, not once per kernel.
class ParticleBatches {
 public:
  virtual ~ParticleBatches() = default;
  virtual void trace(int group, uint64_t first, int64_t count, BatchScores& scores) = 0;
};

/// The kernel for such media that the scene's other features ask for; in a source for each need.
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
