#include "runtime/actor/scheduler.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"
#include "runtime/fiber/overflow_report.hpp"

namespace luxodus {

namespace {

size_t timers_of(const SchedulerLimits& limits) {
  return limits.fibers.count + limits.timers_beside_fibers;
}

}  // namespace

Scheduler::Scheduler(const SchedulerLimits& limits, const Clock& clock, EventSource& source)
    : limits_(limits),
      clock_(clock),
      source_(source),
      fibers_(limits.fibers),
      timers_(timers_of(limits), clock.now()),
      handoff_(limits.handoffs, source) {}

void Scheduler::plan_memory(MemoryPlan& plan, const SchedulerLimits& limits) {
  const size_t fibers = limits.fibers.count;
  plan.add("fiber stacks", fibers * limits.fibers.stack_bytes,
           fmt::format("{} fibers x {} B, resident as they are touched", fibers,
                       limits.fibers.stack_bytes));
  plan.add("fibers", fibers * Fibers::bytes_each,
           fmt::format("{} fibers x {} B", fibers, Fibers::bytes_each));
  const size_t timers = timers_of(limits);
  plan.add("timers", timers * Timers::bytes_each,
           fmt::format("({} fibers + {} of parts) x {} B", fibers, limits.timers_beside_fibers,
                       Timers::bytes_each));
  plan.add("handoff", limits.handoffs * sizeof(Task),
           fmt::format("{} results x {} B", limits.handoffs, sizeof(Task)));
}

void Scheduler::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"turns", "", "Turns of the node's loop.", ""}, c.turns);
  metrics.add_counter({"fiber_resumes", "", "Times a fiber ran.", ""}, c.resumes);
  metrics.add_counter({"control_calls", "", "Times an actor handled control.", ""}, c.controls);
  metrics.add_counter({"timers_fired", "", "Timers that came due.", ""}, c.timers_fired);
  metrics.add_counter({"handed_over", "", "Results of other threads.", ""}, c.handed_over);
  metrics.add_counter({"waited", "nanoseconds", "Time with nothing to do.", ""}, c.waited);
  metrics.add_gauge({"longest_turn", "nanoseconds", "Processor time of the longest turn.", ""},
                    c.longest_turn);
  metrics.add_counter({"stalls", "", "Fibers that ran for too long at once.", ""}, c.stalls);
  metrics.add_gauge({"fibers_live", "", "Fibers that have work.", ""}, c.fibers_live);
  metrics.add_gauge({"fibers_suspended", "", "Fibers that wait.", ""}, c.fibers_suspended);
}

ShutdownPhase Scheduler::end_all_fibers(Nanoseconds most) {
  return {"end all fibers", most, [this] { fibers_.cancel_all(); },
          [this] { return fibers_.live() == 0; }, [this] { return fibers_.describe_live(); }};
}

void Scheduler::call_for_control(ControlReceiver& receiver) {
  if (!receiver.linked()) controls_.push_back(receiver);
}

// Runs on the scheduler's stack at the deadline. The fiber may have been woken just before, in the
// same turn: then it is no longer suspended, and that wake counts.
Task Scheduler::wake_by_deadline() {
  LUX_CHECK(fibers_.current() != nullptr, "waited for a deadline outside of any fiber");
  return [this, id = fibers_.current()->id()] { fibers_.time_out(id); };
}

Wake Scheduler::sleep_until(Nanoseconds deadline) {
  const TimerId timer = timers_.set(deadline, wake_by_deadline());
  const Wake how = fibers_.suspend("sleep");
  timers_.cancel(timer);
  return how;
}

Wake Scheduler::wait_until(WaitList& list, Nanoseconds deadline, const char* reason) {
  const TimerId timer = timers_.set(deadline, wake_by_deadline());
  const Wake how = fibers_.wait(list, reason);
  timers_.cancel(timer);
  return how;
}

Nanoseconds Scheduler::turn() {
  const Nanoseconds began = clock_.now();
  if (began - processor_.at >= processor_resolution) processor_ = {began, clock_.processor()};
  const Nanoseconds due = take_turn(began);
  measure_turn(began, turn_ended_);
  return due;
}

/// CPU time never exceeds elapsed time, so most turns need only a comparison. Two numbers bound a
/// turn's CPU time from above: the elapsed time, in which other programs may have run, and the CPU
/// time since the last reading, which includes turns since then. The smaller one is taken.
void Scheduler::measure_turn(Nanoseconds began, Nanoseconds ended) {
  const auto elapsed = static_cast<uint64_t>(ended - began);
  if (elapsed <= counters_.longest_turn) return;
  const auto taken = static_cast<uint64_t>(clock_.processor() - processor_.taken);
  counters_.longest_turn = std::max(counters_.longest_turn, std::min(elapsed, taken));
}

Nanoseconds Scheduler::take_turn(Nanoseconds began) {
  ++counters_.turns;
  const size_t timers = rarely(Buggify::Site::few_timers) ? 1 : limits_.timers_per_turn;
  counters_.timers_fired += timers_.run_due(began, timers);
  const bool more_arrives = source_.poll();
  // Replies are sent before fibers take their time.
  if (handle_controls()) source_.send_out();
  counters_.handed_over += handoff_.run();
  run_fibers();
  counters_.fibers_live = fibers_.live();
  counters_.fibers_suspended = fibers_.suspended();
  turn_ended_ = clock_.now();
  const Nanoseconds shutdown_due = shutdown_.step(turn_ended_);
  if (more_arrives || !controls_.empty() || fibers_.any_ready() || handoff_.waiting() > 0)
    return turn_ended_;
  return std::min(timers_.next(), shutdown_due);
}

/// Calls each receiver that waits now once: an actor that sends control to itself is called in the
/// next turn. Returns false if none waits.
bool Scheduler::handle_controls() {
  if (controls_.empty()) return false;
  IntrusiveList<ControlReceiver> waiting;
  while (ControlReceiver* receiver = controls_.pop_front()) waiting.push_back(*receiver);
  while (ControlReceiver* receiver = waiting.pop_front()) {
    receiver->handle_control();
    ++counters_.controls;
  }
  return true;
}

void Scheduler::run_fibers() {
  if (!fibers_.any_ready()) return;
  Nanoseconds before = clock_.now();
  const Nanoseconds end = before + limits_.fibers_per_turn;
  const size_t most = rarely(Buggify::Site::short_turn) ? 1 : limits_.resumes_per_turn;
  for (size_t i = 0; i < most && before < end && fibers_.any_ready(); ++i) {
    const Fiber& fiber = fibers_.run_next();
    const Nanoseconds after = clock_.now();
    if (after - before > limits_.stall) report_stall(fiber, after - before);
    before = after;
    ++counters_.resumes;
  }
}

void Scheduler::report_stall(const Fiber& fiber, Nanoseconds ran) {
  ++counters_.stalls;
  last_stall_ = {fiber.id(), fiber.tag(), fiber.reason(), fiber.subject(), ran};
  if (!log_stall_.may(clock_.now())) return;
  log_warning(
      "event=stall fiber={:#x} tag=\"{}\" subject={} last_suspend=\"{}\" ran_ms={} stalls={}",
      fiber.id().value, fiber.tag(), static_cast<int64_t>(fiber.subject()), fiber.reason(),
      ran / milliseconds(1), counters_.stalls);
}

void Scheduler::run() {
  const OverflowReport report;
  for (;;) {
    const Nanoseconds due = turn();
    if (shutdown_.finished()) return;
    if (due <= turn_ended_) continue;
    source_.wait_until(due);
    counters_.waited += static_cast<uint64_t>(clock_.now() - turn_ended_);
  }
}

}  // namespace luxodus
