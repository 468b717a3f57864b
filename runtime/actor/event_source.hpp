// Where a node receives from outside its thread and waits when it is idle. A simulation replaces
// sockets here.
#pragma once

#include "runtime/core/clock.hpp"

namespace luxodus {

class EventSource {
 public:
  virtual ~EventSource() = default;

  /// Takes in a bounded part of what has arrived, without waiting. Returns true if there may be
  /// more. On the node's thread.
  virtual bool poll() = 0;

  /// Sends what was queued since poll(). On the node's thread.
  virtual void send_out() {}

  /// Waits until something arrives, `deadline` passes, or wake() was called since the last wait;
  /// may return earlier. On the node's thread.
  virtual void wait_until(Nanoseconds deadline) = 0;

  /// Ends the current wait, or the next one if there is none. Any thread.
  virtual void wake() noexcept = 0;
};

/// For a node without a network: only wake() ends a wait.
class QuietSource final : public EventSource {
 public:
  /// Throws std::runtime_error if the system gives no eventfd.
  explicit QuietSource(const Clock& clock);
  QuietSource(const QuietSource&) = delete;
  QuietSource& operator=(const QuietSource&) = delete;
  ~QuietSource() override;

  bool poll() override { return false; }
  void wait_until(Nanoseconds deadline) override;
  void wake() noexcept override;

 private:
  const Clock& clock_;
  int event_;  // an eventfd
};

}  // namespace luxodus
