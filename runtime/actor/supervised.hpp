// Failure of actors: an exception has left a handler, or one of the actor's own tasks (a timer, the
// completion of a call). A failed actor handles nothing more. Its supervisor is notified and may
// restart it, with an empty mailbox and its initial state. Without a supervisor the exception
// propagates. Thread rule: belongs to one node; all calls are made on its thread.
#pragma once

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <utility>

#include "runtime/actor/scheduler.hpp"

namespace luxodus {

class Supervised;

/// Receives failures.
class FailureListener {
 public:
  virtual ~FailureListener() = default;
  /// The actor has failed, and does nothing until it is restarted. Called where it failed: on its
  /// fiber, or on the scheduler's stack. It may not suspend.
  virtual void on_failure(Supervised& actor, const std::exception_ptr& why) noexcept = 0;
};

/// An injected failure, for tests and drills.
class FailedOnPurpose final : public std::runtime_error {
 public:
  FailedOnPurpose() : std::runtime_error("a failure on purpose") {}
};

class Supervised : public ControlReceiver {
 public:
  /// Requires: `listener` outlives the use of this.
  void supervise_by(FailureListener& listener) { listener_ = &listener; }

  bool failed() const { return failed_; }
  /// Number of the current life; the first is 1.
  uint32_t life() const { return life_; }
  /// Restarts the actor. Requires: its handlers do not suspend.
  void begin_anew() {
    ++life_;
    failed_ = false;
    forget_mailbox();
    reset();
  }
  /// Makes the next handler or task fail.
  void fail_next() { fails_next_ = true; }

  /// Reports an exception of code that works for the actor elsewhere. Not within a catch block.
  void fail_with(const std::exception_ptr& why) {
    if (listener_ == nullptr) std::rethrow_exception(why);
    if (std::exchange(failed_, true)) return;
    listener_->on_failure(*this, why);
  }

  /// Runs `work` as part of the actor: an exception is a failure. A failed actor does nothing.
  template <class Work>
  void guarded(Work&& work) {
    if (failed_) return;
    if (listener_ == nullptr) return work();
    std::exception_ptr why;
    try {
      if (std::exchange(fails_next_, false)) throw FailedOnPurpose();
      work();
    } catch (...) {
      why = std::current_exception();
    }
    if (why) fail_with(why);
  }

  /// A task that runs guarded(work) later, on a timer or after a call. It does nothing in a later
  /// life.
  template <class Work>
  Task own_task(Work work) {
    return [this, work, life = life_] {
      if (life == life_) guarded(work);
    };
  }

 protected:
  /// Restores the actor's initial state.
  virtual void reset();
  virtual void forget_mailbox() {}

 private:
  FailureListener* listener_ = nullptr;
  uint32_t life_ = 1;
  bool failed_ = false;
  bool fails_next_ = false;
};

}  // namespace luxodus
