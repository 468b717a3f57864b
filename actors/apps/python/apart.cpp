#include "actors/apps/python/apart.hpp"

#include <chrono>
#include <exception>
#include <new>
#include <thread>
#include <utility>

#include "actors/apps/python/errors.hpp"

namespace luxodus::python {

namespace py = pybind11;

namespace {

/// Interval of signal handlers: short enough that Ctrl-C seems immediate.
constexpr std::chrono::milliseconds between_signals{50};

/// Turns exceptions of the work that are not problems of the scene into problems.
void rethrow(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Refused&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw Refused(problem(e.what()));
  }
}

}  // namespace

void WaitingThread::say(Said said) {
  const std::lock_guard lock(mutex_);
  said_ = std::move(said);
  changed_.notify_one();
}

void WaitingThread::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_one();
}

bool WaitingThread::wait(Said& said) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, between_signals, [&] { return ended_ || said_; });
  said = std::exchange(said_, nullptr);
  return ended_;
}

void work_apart(const py::object& progress, const std::function<void(WaitingThread&)>& work) {
  WaitingThread waiting;
  std::exception_ptr thrown;
  std::thread worker([&] {
    try {
      work(waiting);
    } catch (...) {
      thrown = std::current_exception();
    }
    waiting.end();
  });
  std::exception_ptr raised;  // raised here, where Python objects may be used
  for (bool ended = false; !ended;) {
    WaitingThread::Said said;
    {
      const py::gil_scoped_release others_go_on;
      ended = waiting.wait(said);
    }
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (said && !progress.is_none() && progress(said()).is(py::bool_(false)))
        waiting.interrupt_ = true;
    } catch (...) {
      raised = std::current_exception();
      waiting.interrupt_ = true;
    }
  }
  worker.join();  // after its last message
  if (raised) std::rethrow_exception(raised);
  if (thrown) rethrow(thrown);
}

}  // namespace luxodus::python
