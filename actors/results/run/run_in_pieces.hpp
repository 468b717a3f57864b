// A run whose batches are given out as work, piece by piece, to an executor that traces states of a
// scene: nodes of a cluster that continue from one run to the next. Thread rule: one caller.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <set>

#include "actors/results/run/executor.hpp"
#include "actors/results/run/run_executor.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// The batches of a run up to the next wait for all.
class PiecesOfRun final : public Work {
 public:
  /// The executor's threads call `stops` and `report`, `report` with the batches merged so far;
  /// both without holding this object's lock, since they may ask the executor, which has locks of
  /// its own.
  /// Requires: the run is resident.
  PiecesOfRun(LocalRun& run, int64_t end, std::function<bool()> stops,
              std::function<void(int64_t)> report);

  std::unique_ptr<BatchWorker> worker() const override;
  Totals& totals() override { return run_.totals(); }
  std::optional<BatchRange> next(int64_t most) override;
  void give_back(const BatchRange& batches) override;
  void merged(int64_t batches) override;
  bool stopped() const override;

  /// Continues the run from what was merged. Requires: nobody traces.
  void settle();

 private:
  LocalRun& run_;
  const int64_t end_;
  const std::function<bool()> stops_;
  const std::function<void(int64_t)> report_;
  mutable std::mutex mutex_;  // guards all members below
  int64_t given_;
  std::set<int64_t> missing_;
  int64_t merged_ = 0;
};

class RunInPieces final : public RunExecutor {
 public:
  /// `goes_on`: an error where those who trace never will; then a run ends with it.
  /// Requires: `executor` outlives it.
  RunInPieces(Executor& executor, std::function<Result<void>()> goes_on)
      : executor_(executor), goes_on_(std::move(goes_on)) {}

  void enter(const StateObject& state) override { executor_.enter(state); }
  /// Requires: the state entered last is that of the run's scene and seed.
  /// Errors: those of `goes_on`.
  Result<StopReason> run(LocalRun& run, const StopRule& stop, const std::atomic<bool>& interrupt,
                         const std::function<void(const Progress&)>& report) override;

 private:
  Executor& executor_;
  const std::function<Result<void>()> goes_on_;
};

}  // namespace luxodus
