// Ctrl-C as a program meets it that listens while it plans.
#pragma once

#include <sys/time.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <string>

#include "actors/judge/design/solve_layout.hpp"

namespace luxodus::test {

/// Listens to SIGINT, and looks every millisecond whether it still does.
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

  /// What a search is given to look at.
  const std::atomic<bool>& interrupt() const { return pressed(); }
  /// How often was looked, and how often somebody else listened in the program's place.
  int times_looked() const { return looks(); }
  int times_taken() const { return taken(); }

  /// Pressed when progress of this kind is told for so many times.
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
