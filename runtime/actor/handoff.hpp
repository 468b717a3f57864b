// The one door into a node for other threads: builders and readers of files hand over what the node
// shall do with their results. Bounded; a lock is held for a copy only. Everything else of a node
// belongs to its thread.
#pragma once

#include <atomic>
#include <mutex>

#include "runtime/actor/event_source.hpp"
#include "runtime/core/ring.hpp"
#include "runtime/core/task.hpp"

namespace luxodus {

class Handoff {
 public:
  /// Requires: `source` outlives this.
  Handoff(size_t capacity, EventSource& source) : tasks_(capacity), source_(source) {}

  /// Has `task` run on the node's thread, in the order of handing over, and wakes the node; false,
  /// and nothing is taken, where the handoff is full: whoever gives out work gives out no more than
  /// its results find room. Any thread.
  [[nodiscard]] bool give(const Task& task) {
    {
      const std::lock_guard lock(mutex_);
      if (!tasks_.push(task)) return false;
      waiting_.store(tasks_.size(), std::memory_order_release);
    }
    source_.wake();
    return true;
  }

  /// Runs what was handed over before the call. Returns how many. On the node's thread.
  size_t run() {
    const size_t count = waiting();
    for (size_t i = 0; i < count; ++i) take()();
    return count;
  }

  size_t waiting() const { return waiting_.load(std::memory_order_acquire); }

 private:
  Task take() {
    const std::lock_guard lock(mutex_);
    const Task task = tasks_.pop();
    waiting_.store(tasks_.size(), std::memory_order_release);
    return task;
  }

  std::mutex mutex_;
  Ring<Task> tasks_;
  std::atomic<size_t> waiting_{0};  // so that a turn looks without taking the lock
  EventSource& source_;
};

}  // namespace luxodus
