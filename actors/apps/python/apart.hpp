// Runs work on a thread of its own, while the thread that called from Python waits without the
// interpreter's lock: other Python threads continue, Ctrl-C stops the work, and a callable receives
// its progress on the calling thread. The processor's mode for denormal numbers, which tracing
// changes, stays as in Python. Thread rule: call it with the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace luxodus::python {

/// The work's view of the waiting thread. Any thread.
class WaitingThread {
 public:
  /// Makes the argument of the callable. Requires: it holds no Python objects; called with the
  /// lock.
  using Said = std::function<pybind11::object()>;

  /// Set when the work shall end early.
  const std::atomic<bool>& interrupt() const { return interrupt_; }
  /// Calls the callable with this, unless a newer message replaces it.
  void say(Said said);

 private:
  friend void work_apart(const pybind11::object& progress,
                         const std::function<void(WaitingThread&)>& work);
  void end();
  /// Waits for a message, the end, or a short time. True at the end.
  bool wait(Said& said);

  std::atomic<bool> interrupt_{false};
  std::mutex mutex_;  // guards all members below
  std::condition_variable changed_;
  Said said_;
  bool ended_ = false;
};

/// Returns when the work has ended. `progress`: a callable of one argument, or None; if it returns
/// False, the work is asked to end. Requires: the interpreter's lock.
/// Errors: exceptions of the callable or of a signal handler, after the work has ended on request;
/// else those of the work, as Refused.
void work_apart(const pybind11::object& progress, const std::function<void(WaitingThread&)>& work);

}  // namespace luxodus::python
