// How a node ends: in named phases, one after another, each with a deadline. A phase that is not
// done at its deadline is given up with a warning that says what it still waited for, and the next
// begins: a node that shall end, ends. While a phase lasts it says every second what it waits for.
// Belongs to one node; the scheduler drives it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/core/clock.hpp"

namespace luxodus {

/// One step of the end. All three are called on the node's thread, outside of any fiber.
struct ShutdownPhase {
  std::string name;                              // "flush commits"
  Nanoseconds most = 0;                          // time for it
  std::function<void()> begin;                   // asks for what shall happen; may be empty
  std::function<bool()> done;                    // whether it has
  std::function<std::string()> still_waits_for;  // "3 flushes unacknowledged", for the log
};

class Shutdown {
 public:
  /// Requires: not begun.
  void add(ShutdownPhase phase);

  /// Begins the first phase at the next step; a second call changes nothing. `why` is for the log.
  void begin(const std::string& why);

  /// Goes on as far as it can. Returns when to call it again at the latest: `never` before it has
  /// begun and after it has finished.
  Nanoseconds step(Nanoseconds now);

  bool begun() const { return begun_; }
  bool finished() const { return begun_ && current_ == phases_.size(); }

  /// What became of the phases so far, in order.
  struct Outcome {
    std::string phase;
    bool done = false;       // before its deadline
    std::string waited_for;  // where it was given up
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
