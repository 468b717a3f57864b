#include "actors/run/executor.hpp"

#include <thread>
#include <vector>

#include "runtime/core/denormals.hpp"

namespace luxodus {

void ThreadExecutor::trace(Work& work) {
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
      work.merged(1);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < threads_; ++i) threads.emplace_back(one);
  one();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace luxodus
