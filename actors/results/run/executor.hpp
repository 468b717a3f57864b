// Executors trace: threads of this process, or nodes. Work is what they trace: batches of one state
// of a scene, given out piece by piece, and the totals that they are merged into. All executors
// give the same bits. Thread rule: one thread calls an executor; any thread may call Work.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "actors/results/run/batch_worker.hpp"
#include "actors/results/run/scene_state.hpp"

namespace luxodus {

/// The batches to be traced now.
class Work {
 public:
  virtual ~Work() = default;
  /// Makes a worker for its batches in this process.
  virtual std::unique_ptr<BatchWorker> worker() const = 0;
  /// Up to `most` batches; none if no more are left, or it shall stop. The caller merges their
  /// results into totals(), or gives them back.
  virtual std::optional<BatchRange> next(int64_t most) = 0;
  virtual void give_back(const BatchRange& batches) = 0;
  virtual bool stopped() const = 0;
  virtual Totals& totals() = 0;
  /// Reports that this many more batches are in totals(). Called by whoever merges.
  virtual void merged(int64_t /*batches*/) {}
};

class Executor {
 public:
  virtual ~Executor() = default;
  /// Announces a state that may be entered next, so that slow preparations can begin.
  virtual void foresee(const StateObject& state) = 0;
  /// Sets the state of what is traced from now on.
  virtual void enter(const StateObject& state) = 0;
  /// Returns when next() has given none, and all given batches are merged or given back.
  /// Requires: the work belongs to the state entered last.
  virtual void trace(Work& work) = 0;
};

/// Threads of this process, which merge into the same totals.
class ThreadExecutor final : public Executor {
 public:
  /// Requires: threads >= 1.
  explicit ThreadExecutor(int threads) : threads_(threads) {}
  void foresee(const StateObject&) override {}
  void enter(const StateObject&) override {}
  void trace(Work& work) override;

 private:
  int threads_;
};

}  // namespace luxodus
