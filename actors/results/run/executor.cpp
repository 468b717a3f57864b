#include "actors/results/run/executor.hpp"

#include <thread>
#include <vector>

#include "runtime/core/denormals.hpp"

namespace luxodus {

void ThreadExecutor::trace(Work& work) {
  const auto one = [&] {
    flush_denormals();
    const auto worker = work.worker();
    while (const auto batch = work.next(1)) {
      worker->begin(*batch);
      while (worker->go_on()) {
      }
      worker->merge_into(work.totals(), [] {});
      work.merged(1);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < threads_; ++i) threads.emplace_back(one);
  one();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace luxodus
