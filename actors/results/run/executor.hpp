// Who traces: threads of this process, or nodes. What is to be traced is Work: batches of one state
// of a scene, given out piece by piece, and the totals that they are merged into. What executors
// give is the same to the bit. Thread rule: an executor is called by one thread; Work may be called
// from any.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "actors/results/run/batch_worker.hpp"
#include "actors/results/run/scene_state.hpp"

namespace luxodus {

/// What is to be traced now.
class Work {
 public:
  virtual ~Work() = default;
  /// Does batches of it in this process.
  virtual std::unique_ptr<BatchWorker> worker() const = 0;
  /// Up to `most` batches; none where there are no more, or somebody wants it to stop. Whoever
  /// takes some merges what they give into totals(), or gives them back.
  virtual std::optional<BatchRange> next(int64_t most) = 0;
  virtual void give_back(const BatchRange& batches) = 0;
  virtual bool stopped() const = 0;
  virtual Totals& totals() = 0;
  /// So many batches more are in totals(). Called by whoever merges.
  virtual void merged(int64_t /*batches*/) {}
};

class Executor {
 public:
  virtual ~Executor() = default;
  /// A state that may be entered next: what takes time may begin.
  virtual void foresee(const StateObject& state) = 0;
  /// The state of what is traced from now on.
  virtual void enter(const StateObject& state) = 0;
  /// Returns when next() has given none, and all that it gave is merged or given back.
  /// Requires: the work is of the state entered last.
  virtual void trace(Work& work) = 0;
};

/// Threads of this process: they merge into the same totals.
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
