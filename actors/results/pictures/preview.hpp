// Pictures of a run in progress: at intervals, or on request, the totals are copied and rendered
// with few paths, on a thread of its own beside the tracing. The flux of a preview consists of
// whole batches; the run's result does not depend on it.
// Thread rule: made and destroyed by the thread that runs the run.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "actors/results/pictures/pictures.hpp"

namespace luxodus {

/// Renders into folder/preview/views. Errors are logged: the run goes on.
void render_preview(const std::filesystem::path& folder, const LocalRun& run,
                    const PictureOptions& options);

class Preview {
 public:
  /// Writes into folder/preview/views from now on, while `run` traces: every `every_s` seconds (0:
  /// never), and whenever `requested` is set, which it resets. Takes as much memory as the totals.
  /// Requires: `run` and `requested` outlive this.
  Preview(std::filesystem::path folder, LocalRun& run, double every_s, std::atomic<bool>& requested,
          const PictureOptions& options);
  /// Waits for pictures in progress.
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  int taken() const { return taken_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool due() const;
  void take();

  const std::filesystem::path folder_;
  LocalRun& run_;
  const std::unique_ptr<LocalRun> copy_;  // copy of its totals
  const std::chrono::duration<double> every_;
  std::atomic<bool>& requested_;
  const PictureOptions options_;
  Clock::time_point last_ = Clock::now();
  std::atomic<bool> rendering_{false};
  int taken_ = 0;
  std::thread thread_;
};

}  // namespace luxodus
