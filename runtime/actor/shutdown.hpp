// Shutdown of a node: in named phases, one after another, each with a deadline. A phase that misses
// its deadline is abandoned with a warning that says what it still waited for, and the next begins:
// the shutdown always ends. A phase in progress logs every second what it waits for. Thread rule:
// belongs to one node; the scheduler drives it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/core/clock.hpp"

namespace luxodus {

/// One phase. All three functions are called on the node's thread, outside of any fiber.
struct ShutdownPhase {
  std::string name;                              // "flush commits"
  Nanoseconds most = 0;                          // its deadline, from its beginning
  std::function<void()> begin;                   // requests what shall happen; may be empty
  std::function<bool()> done;                    // whether it has happened
  std::function<std::string()> still_waits_for;  // "3 flushes unacknowledged", for the log
};

class Shutdown {
 public:
  /// Requires: not begun.
  void add(ShutdownPhase phase);

  /// Begins the first phase at the next step; further calls have no effect. `why` is for the log.
  void begin(const std::string& why);

  /// Advances as far as possible. Returns when to call it again at the latest: `never` before
  /// begin() and after the end.
  Nanoseconds step(Nanoseconds now);

  bool begun() const { return begun_; }
  bool finished() const { return begun_ && current_ == phases_.size(); }

  /// Outcomes of the phases so far, in order.
  struct Outcome {
    std::string phase;
    bool done = false;       // before its deadline
    std::string waited_for;  // if it was abandoned
  };
  const std::vector<Outcome>& outcomes() const { return outcomes_; }

 private:
  void start_phase(Nanoseconds now);
  void end_phase(bool done, Nanoseconds now);

  std::vector<ShutdownPhase> phases_;
  std::vector<Outcome> outcomes_;
  bool begun_ = false;
  bool phase_started_ = false;
  size_t current_ = 0;
  Nanoseconds started_ = 0;
  Nanoseconds next_word_ = 0;
};

}  // namespace luxodus
