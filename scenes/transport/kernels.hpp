// Choosing a kernel at run time. Each medium need is compiled in a source of its own
// (kernel_*.cpp), so that the loops of each build side by side.
#pragma once

#include "scenes/transport/particle.hpp"
#include "scenes/transport/resolver.hpp"

namespace luxodus {

/// Particles only; what traces eyes is compiled once, not once per kernel.
class ParticleBatches {
 public:
  virtual ~ParticleBatches() = default;
  virtual void trace(int group, uint64_t first, int64_t count, BatchScores& scores) = 0;
};

template <class K, class Resolver>
class KernelBatches final : public ParticleBatches {
 public:
  KernelBatches(const CompiledScene& scene, Resolver resolver, uint64_t seed)
      : resolver_(std::move(resolver)), particles_(scene, resolver_, seed) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    particles_.trace_batch(group, first, count, scores);
  }

 private:
  Resolver resolver_;
  ParticleTracer<K, Resolver> particles_;
};

template <MediaNeed Media, bool Bands, bool Surfaces, bool Detectors>
std::unique_ptr<ParticleBatches> make_kernel(const CompiledScene& scene,
                                             const GeometryAccess& access, uint64_t seed) {
  using K = Kernel<Media, Bands, Surfaces, Detectors>;
  return with_resolver(scene, access, [&](auto resolver) -> std::unique_ptr<ParticleBatches> {
    return std::make_unique<KernelBatches<K, decltype(resolver)>>(scene, std::move(resolver), seed);
  });
}

template <MediaNeed Media, bool Bands, bool Surfaces>
std::unique_ptr<ParticleBatches> choose_detectors(const CompiledScene& scene,
                                                  const GeometryAccess& access, uint64_t seed) {
  if (scene.features.detectors)
    return make_kernel<Media, Bands, Surfaces, true>(scene, access, seed);
  return make_kernel<Media, Bands, Surfaces, false>(scene, access, seed);
}

template <MediaNeed Media>
std::unique_ptr<ParticleBatches> choose_kernel(const CompiledScene& scene,
                                               const GeometryAccess& access, uint64_t seed) {
  const Features& f = scene.features;
  if (f.bands && f.surfaces) return choose_detectors<Media, true, true>(scene, access, seed);
  if (f.bands) return choose_detectors<Media, true, false>(scene, access, seed);
  if (f.surfaces) return choose_detectors<Media, false, true>(scene, access, seed);
  return choose_detectors<Media, false, false>(scene, access, seed);
}

extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::none>(
    const CompiledScene&, const GeometryAccess&, uint64_t);
extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::homogeneous>(
    const CompiledScene&, const GeometryAccess&, uint64_t);
extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::layered>(
    const CompiledScene&, const GeometryAccess&, uint64_t);
extern template std::unique_ptr<ParticleBatches> choose_kernel<MediaNeed::general>(
    const CompiledScene&, const GeometryAccess&, uint64_t);

}  // namespace luxodus
