// The only way into a node for other threads: threads that build or read files hand over tasks for
// the node to run. Bounded; the lock is held only while a task is copied. Everything else of a node
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

  /// Queues `task` to run on the node's thread, in order, and wakes the node. Returns false, and
  /// queues nothing, if it is full: do not start more work than there is room for its results. Any
  /// thread.
  [[nodiscard]] bool give(const Task& task) {
    {
      const std::lock_guard lock(mutex_);
      if (!tasks_.push(task)) return false;
      waiting_.store(tasks_.size(), std::memory_order_release);
    }
    source_.wake();
    return true;
  }

  /// Runs the tasks queued before the call and returns their number. On the node's thread.
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
  std::atomic<size_t> waiting_{0};  // lets a turn check without taking the lock
  EventSource& source_;
};

}  // namespace luxodus
