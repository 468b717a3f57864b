// Work on a thread of its own, while the thread that called from Python waits without the
// interpreter's lock: other threads of Python go on, Ctrl-C stops the work, and a callable hears of
// its progress on the thread that called. The processor's treatment of denormal numbers, which
// tracing changes, stays as Python has it.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace luxodus::python {

/// What the work sees of the thread that waits for it. Any thread.
class Waiting {
 public:
  /// Makes what the callable gets. Requires: it holds no objects of Python; called with the lock.
  using Said = std::function<pybind11::object()>;

  /// Set when the work shall end early.
  const std::atomic<bool>& interrupt() const { return interrupt_; }
  /// Has the callable called with this, unless something newer is said before.
  void say(Said said);

 private:
  friend void work_apart(const pybind11::object& progress,
                         const std::function<void(Waiting&)>& work);
  void end();
  /// Until something is said, the end, or a moment later. True at the end.
  bool wait(Said& said);

  std::atomic<bool> interrupt_{false};
  std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  Said said_;
  bool ended_ = false;
};

/// Returns when the work has ended. `progress`: a callable of one argument, or None; where it
/// returns False, the work is asked to end. Requires: the interpreter's lock.
/// Errors: what the callable or a handler of signals raises, after the work was asked to end and
/// has; else what the work throws, as Refused.
void work_apart(const pybind11::object& progress, const std::function<void(Waiting&)>& work);

}  // namespace luxodus::python
