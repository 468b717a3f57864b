// Calls that may block for long, such as fdatasync, run off the node's thread: a node that waited
// for a disk would miss its heartbeats. One call at a time; each actor that makes such calls has
// its own instance. Thread rule: the node's thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "runtime/actor/scheduler.hpp"

namespace luxodus {

class BlockingCalls {
 public:
  virtual ~BlockingCalls() = default;
  /// Begins `call`; after it has returned, `done` runs on the node's thread. Requires: no call is
  /// in progress; what `call` refers to outlives it; `call` throws nothing.
  virtual void begin(std::function<void()> call, const Task& done) = 0;
  /// Blocks until no call is in progress: for shutdown.
  virtual void finish() = 0;
};

/// Runs the calls on a thread of its own.
class BlockingThread final : public BlockingCalls {
 public:
  /// Requires: `handoff` outlives it, with room for one task.
  explicit BlockingThread(Handoff& handoff);
  ~BlockingThread() override;

  void begin(std::function<void()> call, const Task& done) override;
  void finish() override;

 private:
  void work();

  Handoff& handoff_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> call_;  // empty: none in progress
  Task done_;
  bool ends_ = false;
  std::thread thread_;  // last member: starts when all others exist
};

}  // namespace luxodus
