// Chooses the kernel at run time, within a given need of media (particle_batches.hpp). Each need is
// compiled in a source of its own (kernel_*.cpp), so that they compile in parallel. One
// KernelBatches per thread or fiber.
#pragma once

#include "scenes/light/transport/particle.hpp"
#include "scenes/light/transport/particle_batches.hpp"

namespace luxodus {

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
  const bool any_surface = f.surfaces || f.bodies;
  if (f.bands && any_surface) return choose_detectors<Media, true, true>(scene, access, seed);
  if (f.bands) return choose_detectors<Media, true, false>(scene, access, seed);
  if (any_surface) return choose_detectors<Media, false, true>(scene, access, seed);
  return choose_detectors<Media, false, false>(scene, access, seed);
}

}  // namespace luxodus
