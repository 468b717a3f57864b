// Choosing a kernel at run time. Each medium need is compiled in a source of its own (kernel_*.cpp), so that
// the sixteen loops of each build side by side.
#pragma once

#include "scenes/transport/particle.hpp"
#include "scenes/transport/trace.hpp"

namespace luxodus {

/// A batch tracer made of a particle kernel and an eye tracer over the same resolver.
template <class K, class Resolver>
class KernelTracer final : public BatchTracer {
 public:
  KernelTracer(const CompiledScene& scene, const SceneIndex& index, uint64_t seed)
      : resolver_(scene, index),
        particles_(scene, resolver_, seed),
        eyes_(scene, resolver_, seed, RandomStream::eye) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    particles_.trace_batch(group, first, count, scores);
  }
  void look(int64_t batch, BatchScores& scores) override { eyes_.score_batch(batch, scores); }

 private:
  Resolver resolver_;
  ParticleTracer<K, Resolver> particles_;
  EyeTracer<Resolver> eyes_;
};

template <MediaNeed Media, bool Bands, bool Surfaces, bool Detectors>
std::unique_ptr<BatchTracer> make_kernel(const CompiledScene& scene, const SceneIndex& index,
                                         uint64_t seed) {
  using K = Kernel<Media, Bands, Surfaces, Detectors>;
  if (index.cells() > 1) return std::make_unique<KernelTracer<K, PartitionResolver>>(scene, index, seed);
  return std::make_unique<KernelTracer<K, MergedResolver>>(scene, index, seed);
}

template <MediaNeed Media, bool Bands, bool Surfaces>
std::unique_ptr<BatchTracer> choose_detectors(const CompiledScene& scene, const SceneIndex& index,
                                              uint64_t seed) {
  if (scene.features.detectors) return make_kernel<Media, Bands, Surfaces, true>(scene, index, seed);
  return make_kernel<Media, Bands, Surfaces, false>(scene, index, seed);
}

template <MediaNeed Media>
std::unique_ptr<BatchTracer> choose_kernel(const CompiledScene& scene, const SceneIndex& index,
                                           uint64_t seed) {
  const Features& f = scene.features;
  if (f.bands && f.surfaces) return choose_detectors<Media, true, true>(scene, index, seed);
  if (f.bands) return choose_detectors<Media, true, false>(scene, index, seed);
  if (f.surfaces) return choose_detectors<Media, false, true>(scene, index, seed);
  return choose_detectors<Media, false, false>(scene, index, seed);
}

extern template std::unique_ptr<BatchTracer> choose_kernel<MediaNeed::none>(const CompiledScene&,
                                                                            const SceneIndex&,
                                                                            uint64_t);
extern template std::unique_ptr<BatchTracer> choose_kernel<MediaNeed::homogeneous>(
    const CompiledScene&, const SceneIndex&, uint64_t);
extern template std::unique_ptr<BatchTracer> choose_kernel<MediaNeed::layered>(const CompiledScene&,
                                                                               const SceneIndex&,
                                                                               uint64_t);
extern template std::unique_ptr<BatchTracer> choose_kernel<MediaNeed::general>(const CompiledScene&,
                                                                               const SceneIndex&,
                                                                               uint64_t);

}  // namespace luxodus
