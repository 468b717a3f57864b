#include "runtime/actor/blocking_calls.hpp"

#include <utility>

#include "runtime/core/check.hpp"
#include "runtime/core/denormals.hpp"

namespace luxodus {

BlockingThread::BlockingThread(Handoff& handoff) : handoff_(handoff), thread_([this] { work(); }) {}

BlockingThread::~BlockingThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void BlockingThread::begin(std::function<void()> call, const Task& done) {
  {
    const std::lock_guard lock(mutex_);
    LUX_CHECK(!call_, "a blocking call began before the last one had returned");
    call_ = std::move(call);
    done_ = done;
  }
  changed_.notify_all();
}

void BlockingThread::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !call_; });
}

void BlockingThread::work() {
  flush_denormals();
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return call_ || ends_; });
    if (!call_) return;
    lock.unlock();
    call_();
    lock.lock();
    call_ = nullptr;
    LUX_CHECK(handoff_.give(done_), "the handoff has room for a blocking call's end");
    changed_.notify_all();
  }
}

}  // namespace luxodus
