// Parallel loops over rows, on threads or fibers. The assignment of rows is not deterministic, so a
// row's work must depend on its number alone; then the result is the same for any number of
// threads. Blocks until all rows are done; may be called from any thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "runtime/core/denormals.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

/// Calls `make()` once on each of `threads` threads, and the function it returns for every row of
/// [0, rows). `finished(n)` receives the number of rows done, from one thread at a time; may be
/// empty.
/// Requires: threads >= 1.
template <class Make>
void parallel_for(int64_t rows, int threads, const Make& make,
                  const std::function<void(int64_t)>& finished = {}) {
  std::atomic<int64_t> next{0};
  std::mutex mutex;
  int64_t done = 0;
  const auto work = [&] {
    // Always on new threads: the caller's floating-point mode is not changed, and every row is
    // computed in the same mode.
    flush_denormals();
    auto worker = make();
    for (int64_t row = next++; row < rows; row = next++) {
      worker(row);
      const std::lock_guard lock(mutex);
      ++done;
      if (finished) finished(done);
    }
  };
  std::vector<std::thread> all;
  for (int i = 0; i < threads; ++i) all.emplace_back(work);
  for (std::thread& t : all) t.join();
}

/// Receives the share of some work that is done, 0 to 1; from one thread at a time.
using ShareDone = std::function<void(double share)>;

/// Parallel loops for work that needs geometry, wherever the geometry is.
class ParallelFor {
 public:
  using Worker = std::function<void(int64_t row)>;
  using MakeWorker = std::function<Worker(const GeometryAccess&)>;
  using Finished = std::function<void(int64_t done)>;

  virtual ~ParallelFor() = default;
  /// Calls `make` once for every thread or fiber, and the function it returns for every row of [0,
  /// rows). `finished`: as in parallel_for. Errors (exception): geometry that is not available.
  virtual void run(int64_t rows, const MakeWorker& make, const Finished& finished = {}) const = 0;
};

/// All geometry in memory: uses threads.
class ResidentParallelFor final : public ParallelFor {
 public:
  ResidentParallelFor(const SceneIndex& index, int threads) : index_(index), threads_(threads) {}
  void run(int64_t rows, const MakeWorker& make, const Finished& finished) const override {
    const GeometryAccess access = GeometryAccess::resident(index_);
    parallel_for(
        rows, threads_, [&] { return make(access); }, finished);
  }

 private:
  const SceneIndex& index_;
  int threads_;
};

}  // namespace luxodus
