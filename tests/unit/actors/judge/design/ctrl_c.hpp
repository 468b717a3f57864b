// Simulates Ctrl-C for a program that handles SIGINT while it plans.
#pragma once

#include <sys/time.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <string>

#include "actors/judge/design/solve_layout.hpp"

namespace luxodus::test {

/// Handles SIGINT, and checks every millisecond that its handler is still installed.
class CtrlC {
 public:
  CtrlC() {
    pressed() = false;
    looks() = taken() = 0;
    struct sigaction ours {};
    ours.sa_handler = on_press;
    ours.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &ours, &before_press_);
    ours.sa_handler = on_look;
    ::sigaction(SIGALRM, &ours, &before_look_);
    const itimerval each_ms{{0, 1000}, {0, 1000}};
    ::setitimer(ITIMER_REAL, &each_ms, nullptr);
  }
  ~CtrlC() {
    const itimerval never{};
    ::setitimer(ITIMER_REAL, &never, nullptr);
    ::sigaction(SIGALRM, &before_look_, nullptr);
    ::sigaction(SIGINT, &before_press_, nullptr);
  }
  CtrlC(const CtrlC&) = delete;
  CtrlC& operator=(const CtrlC&) = delete;

  /// The flag that a search tests.
  const std::atomic<bool>& interrupt() const { return pressed(); }
  /// Number of checks, and of checks that found another handler.
  int times_looked() const { return looks(); }
  int times_taken() const { return taken(); }

  /// Sends SIGINT at the n-th progress message of this kind.
  SolveProgress pressed_at(const std::string& kind, int times) {
    return [kind, left = times](const std::string& what, double, double) mutable {
      if (what.starts_with(kind) && --left == 0) ::raise(SIGINT);
    };
  }

 private:
  static void on_press(int) { pressed() = true; }
  static void on_look(int) {
    struct sigaction now {};
    ::sigaction(SIGINT, nullptr, &now);
    ++looks();
    if (now.sa_handler != on_press) ++taken();
  }
  static std::atomic<bool>& pressed() {
    static std::atomic<bool> flag{false};
    return flag;
  }
  static std::atomic<int>& looks() {
    static std::atomic<int> count{0};
    return count;
  }
  static std::atomic<int>& taken() {
    static std::atomic<int> count{0};
    return count;
  }

  struct sigaction before_press_ {};
  struct sigaction before_look_ {};
};

}  // namespace luxodus::test
