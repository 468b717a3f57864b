// Calls that may block for long, such as fdatasync, made off the node's thread: a node that waited
// for a disk would miss its beats. One call at a time; an actor that makes them has its own.
// Thread rule: the node's thread.
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
  /// Begins `call`; when it has returned, `done` runs on the node's thread. Requires: none is under
  /// way; what `call` refers to lives until it has returned. It may let no exception out.
  virtual void begin(std::function<void()> call, const Task& done) = 0;
  /// Returns when no call is under way any more. Blocks: for a node that ends.
  virtual void finish() = 0;
};

/// On a thread of its own.
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
  std::function<void()> call_;  // empty: none is under way
  Task done_;
  bool ends_ = false;
  std::thread thread_;  // the last: it begins when all else is there
};

}  // namespace luxodus
