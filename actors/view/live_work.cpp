#include "actors/view/live_work.hpp"

#include <thread>
#include <vector>

#include "runtime/core/denormals.hpp"
#include "scenes/transport/history.hpp"

namespace luxodus {

uint64_t first_particle_of(const CompiledScene& scene, int stream, int64_t batch) {
  return (static_cast<uint64_t>(stream) << limits::group_id_shift) +
         static_cast<uint64_t>(batch * scene.batch_particles);
}

void LiveThreads::trace(LiveWork& work) {
  const auto one = [&] {
    flush_denormals();
    const CompiledScene& scene = work.scene();
    const auto tracer = make_batch_tracer(scene, work.access(), work.seed());
    BatchScores scores;
    while (const auto batch = work.next(1)) {
      scores.reset(scene.layout);
      tracer->trace(batch->group, first_particle_of(scene, batch->stream, batch->first),
                    scene.batch_particles, scores);
      work.totals().merge(scores, batch->group);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < threads_; ++i) threads.emplace_back(one);
  one();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace luxodus
