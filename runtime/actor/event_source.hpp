// What comes to a node from outside its thread, and where it waits when it has nothing to do: the
// seam at which a simulation takes the place of sockets.
#pragma once

#include "runtime/core/clock.hpp"

namespace luxodus {

class EventSource {
 public:
  virtual ~EventSource() = default;

  /// Takes in what has arrived, without waiting, a bounded part at a time; true where there may be
  /// more. On the node's thread.
  virtual bool poll() = 0;

  /// Sends what was given away since poll(). On the node's thread.
  virtual void send_out() {}

  /// Waits until something arrives, `deadline` passes, or wake() was called since the last wait; it
  /// may return earlier. On the node's thread.
  virtual void wait_until(Nanoseconds deadline) = 0;

  /// Ends the wait that is on, or else the next. Any thread.
  virtual void wake() noexcept = 0;
};

/// For a node without a network: nothing ever arrives but wake().
class QuietSource final : public EventSource {
 public:
  /// Throws std::runtime_error where the system refuses.
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
