// The random numbers of a history: a pure function of (scene, seed, particle id), so that tracing a
// particle, or only finding where it starts, draws the same numbers anywhere. If the scene's
// particles are stratified, the first draws of a batch's particles are the points of one
// low-discrepancy set. Thread rule: one HistoryRandom per thread or fiber.
#pragma once

#include "runtime/core/random.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Id ranges of source groups are disjoint: 2^44 particles each.
inline constexpr int group_id_shift = 44;
}  // namespace limits

/// Random numbers, restarted for each history.
class HistoryRandom : public Random {
 public:
  HistoryRandom(const CompiledScene& scene, uint64_t seed)
      : Random(seed, RandomStream::particle),
        set_(seed, RandomStream::particle),
        batch_particles_(static_cast<uint64_t>(scene.batch_particles)),
        stratified_(scene.description->run.stratified) {}

  void start(uint64_t particle) {
    if (!stratified_) return Random::start(particle);
    const uint64_t in_group = particle & ((uint64_t{1} << limits::group_id_shift) - 1);
    const auto index = static_cast<uint32_t>(in_group % batch_particles_);
    set_.choose(particle - index, static_cast<uint32_t>(batch_particles_));
    Random::start(particle, set_, index);
  }

 private:
  SobolSet set_;
  uint64_t batch_particles_;
  bool stratified_;
};

}  // namespace luxodus
