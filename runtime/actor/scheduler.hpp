// The loop of a node, which is one OS thread. A turn serves what may be waiting, the most urgent
// first and each with a budget, so that nothing starves and heartbeats are on time:
//   timers > what arrives > control messages > results of other threads > ready fibers
// When nothing is ready it waits for arrivals. A node's parts are owned by its scheduler and used
// only on its thread, except handoff().give(). The scheduler reads time only from its Clock and
// keeps no global state, so a simulation can run many schedulers on one thread.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/actor/event_source.hpp"
#include "runtime/actor/handoff.hpp"
#include "runtime/actor/shutdown.hpp"
#include "runtime/actor/timers.hpp"
#include "runtime/core/buggify.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/memory_plan.hpp"
#include "runtime/core/once_a_minute.hpp"
#include "runtime/fiber/fiber.hpp"
#include "runtime/observe/metrics.hpp"

namespace luxodus {

struct SchedulerLimits {
  FiberLimits fibers;
  size_t timers_beside_fibers = 64;  // for the node's parts; every fiber has one more
  size_t handoffs = 64;              // results of other threads that wait at once
  // A turn of fibers ends at either limit: short against a heartbeat of 250 ms, long against the
  // overhead of a turn, of the order of 100 ns.
  size_t resumes_per_turn = 256;
  Nanoseconds fibers_per_turn = milliseconds(1);
  size_t timers_per_turn = 256;
  Nanoseconds stall = milliseconds(20);  // a fiber that runs longer is reported
  Buggify* buggify = nullptr;            // rare paths of everything that runs here, or null
};

/// A receiver of control messages. The scheduler calls it back once a turn.
class ControlReceiver : public ListHook {
 public:
  virtual ~ControlReceiver() = default;
  /// Handles what is waiting now. On the scheduler's stack: it may not suspend.
  virtual void handle_control() = 0;
};

/// A fiber that ran for too long without suspending.
struct Stall {
  FiberId fiber;
  const char* tag = "";
  const char* reason = "";  // where it last suspended
  uint64_t subject = 0;
  Nanoseconds ran = 0;
};

class Scheduler {
 public:
  /// Allocates everything it will need. Requires: `clock` and `source` outlive this. Throws
  /// std::runtime_error if the system refuses.
  Scheduler(const SchedulerLimits& limits, const Clock& clock, EventSource& source);

  /// Adds the memory of a scheduler with these limits.
  static void plan_memory(MemoryPlan& plan, const SchedulerLimits& limits);

  // ---- the node's parts --------------------------------------------------------------------

  Fibers& fibers() { return fibers_; }
  const Fibers& fibers() const { return fibers_; }
  Timers& timers() { return timers_; }
  Handoff& handoff() { return handoff_; }
  Shutdown& shutdown() { return shutdown_; }
  const Shutdown& shutdown() const { return shutdown_; }
  const Clock& clock() const { return clock_; }

  /// Registers the scheduler's own numbers.
  void add_metrics(Metrics& metrics) const;
  /// The last phase of a shutdown: cancels all fibers and waits until they have returned.
  ShutdownPhase end_all_fibers(Nanoseconds most);
  /// Ends the start-up, in which parts are made, actors started and metrics registered. After it
  /// the node's thread allocates nothing.
  void seal() { sealed_ = true; }
  bool sealed() const { return sealed_; }

  /// Has `receiver` called in this turn if control is still to be handled, else in the next.
  void call_for_control(ControlReceiver& receiver);

  // ---- called on a fiber -------------------------------------------------------------------

  /// Sleeps until `deadline` and returns timed_out, unless cancelled before. Suspends.
  [[nodiscard]] Wake sleep_until(Nanoseconds deadline);
  /// Fibers::wait with a deadline. Suspends.
  [[nodiscard]] Wake wait_until(WaitList& list, Nanoseconds deadline, const char* reason);

  // ---- the loop ----------------------------------------------------------------------------

  /// How old the last reading of the CPU time may be when a turn begins. Reading it is a system
  /// call of 270 ns, several times a short turn; once in this time it costs half a percent.
  static constexpr Nanoseconds processor_resolution = microseconds(50);

  /// One turn, which never waits. Returns when the next is due: now or earlier if there is more to
  /// do, `never` if only the source can bring work.
  Nanoseconds turn();

  /// Runs turns and waits until the shutdown has finished.
  void run();

  struct Counters {
    uint64_t turns = 0;
    uint64_t resumes = 0;
    uint64_t controls = 0;
    uint64_t timers_fired = 0;
    uint64_t handed_over = 0;
    uint64_t stalls = 0;
    uint64_t waited = 0;            // [ns] idle
    uint64_t longest_turn = 0;      // [ns] of CPU time; too long by processor_resolution at most
    uint64_t fibers_live = 0;       // at the end of the last turn
    uint64_t fibers_suspended = 0;  // of those
  };
  const Counters& counters() const { return counters_; }
  const Stall& last_stall() const { return last_stall_; }

  /// Whether to take a rare path now; only in simulations.
  bool rarely(Buggify::Site site) const { return luxodus::rarely(limits_.buggify, site); }

 private:
  /// The CPU time of this thread, read now and then, and when that was.
  struct ProcessorMark {
    Nanoseconds at = 0;
    Nanoseconds taken = 0;
  };
  Nanoseconds take_turn(Nanoseconds began);
  void measure_turn(Nanoseconds began, Nanoseconds ended);
  bool handle_controls();
  void run_fibers();
  void report_stall(const Fiber& fiber, Nanoseconds ran);
  Task wake_by_deadline();

  SchedulerLimits limits_;
  const Clock& clock_;
  EventSource& source_;
  Fibers fibers_;
  Timers timers_;
  Handoff handoff_;
  Shutdown shutdown_;
  IntrusiveList<ControlReceiver> controls_;
  ProcessorMark processor_;
  Nanoseconds turn_ended_ = 0;
  Counters counters_;
  Stall last_stall_;
  OnceAMinute log_stall_;
  bool sealed_ = false;
};

}  // namespace luxodus
