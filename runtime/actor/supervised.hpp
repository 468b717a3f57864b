// What all actors have in common when one of them fails: an exception has left one of its handlers,
// or a task of its own (a timer, the end of a call). A failed actor handles nothing more. Who
// supervises it is told, and may have it begin anew: with an empty mailbox and the state that it
// had at its start. Without a supervisor exceptions leave, as from any function.
// Belongs to one node: all calls are made on its thread.
#pragma once

#include <cstdint>
#include <exception>
#include <stdexcept>
#include <utility>

#include "runtime/actor/scheduler.hpp"

namespace luxodus {

class Supervised;

/// Is told of failures.
class FailureListener {
 public:
  virtual ~FailureListener() = default;
  /// The actor has failed, and does nothing until it begins anew. Called where it failed: on its
  /// fiber, or on the scheduler's stack. It may not suspend.
  virtual void on_failure(Supervised& actor, const std::exception_ptr& why) noexcept = 0;
};

/// A failure on purpose, for rehearsals.
class FailedOnPurpose final : public std::runtime_error {
 public:
  FailedOnPurpose() : std::runtime_error("a failure on purpose") {}
};

class Supervised : public ControlReceiver {
 public:
  /// Requires: `listener` outlives the use of this.
  void supervise_by(FailureListener& listener) { listener_ = &listener; }

  bool failed() const { return failed_; }
  /// Its lives so far; the first is 1.
  uint32_t life() const { return life_; }
  /// Requires: the actor can, which is one whose handlers do not suspend.
  void begin_anew() {
    ++life_;
    failed_ = false;
    forget_mailbox();
    reset();
  }
  /// What it does next fails, on purpose.
  void fail_next() { fails_next_ = true; }

  /// Of who works for the actor elsewhere: this has left its work. Not within a catch block.
  void fail_with(const std::exception_ptr& why) {
    if (listener_ == nullptr) std::rethrow_exception(why);
    if (std::exchange(failed_, true)) return;
    listener_->on_failure(*this, why);
  }

  /// Does `work` as a part of the actor: what leaves it is a failure. A failed actor does nothing.
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

  /// The same later: on a timer, or when a call has returned. Not done by a later life.
  template <class Work>
  Task own_task(Work work) {
    return [this, work, life = life_] {
      if (life == life_) guarded(work);
    };
  }

 protected:
  /// Gives the actor the state that it had at its start.
  virtual void reset();
  virtual void forget_mailbox() {}

 private:
  FailureListener* listener_ = nullptr;
  uint32_t life_ = 1;
  bool failed_ = false;
  bool fails_next_ = false;
};

}  // namespace luxodus
