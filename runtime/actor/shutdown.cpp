#include "runtime/actor/shutdown.hpp"

#include <algorithm>

#include "runtime/actor/timers.hpp"
#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

constexpr Nanoseconds between_words = seconds(1);  // interval of progress lines of a waiting phase

}  // namespace

void Shutdown::add(ShutdownPhase phase) {
  LUX_CHECK(!begun_, "a phase added to a shutdown that has begun");
  LUX_CHECK(phase.done && phase.still_waits_for, "a phase that cannot say when it is done");
  phases_.push_back(std::move(phase));
}

void Shutdown::begin(const std::string& why) {
  if (begun_) return;
  begun_ = true;
  log_debug("event=shutdown phases={} why=\"{}\"", phases_.size(), why);
}

void Shutdown::start_phase(Nanoseconds now) {
  const ShutdownPhase& phase = phases_[current_];
  started_ = now;
  next_word_ = now + between_words;
  phase_started_ = true;
  log_debug("event=shutdown_phase phase=\"{}\"", phase.name);
  if (phase.begin) phase.begin();
}

void Shutdown::end_phase(bool done, Nanoseconds now) {
  const ShutdownPhase& phase = phases_[current_];
  outcomes_.push_back({phase.name, done, done ? std::string() : phase.still_waits_for()});
  if (!done)
    log_warning("event=shutdown_phase_given_up phase=\"{}\" after_ms={} waits_for=\"{}\"",
                phase.name, (now - started_) / milliseconds(1), outcomes_.back().waited_for);
  phase_started_ = false;
  ++current_;
}

Nanoseconds Shutdown::step(Nanoseconds now) {
  while (begun_ && !finished()) {
    if (!phase_started_) start_phase(now);
    const ShutdownPhase& phase = phases_[current_];
    const Nanoseconds deadline = started_ + phase.most;
    if (phase.done()) {
      end_phase(true, now);
    } else if (now >= deadline) {
      end_phase(false, now);
    } else {
      if (now >= next_word_) {
        log_info("event=shutdown_waits phase=\"{}\" waits_for=\"{}\"", phase.name,
                 phase.still_waits_for());
        next_word_ = now + between_words;
      }
      return std::min(deadline, next_word_);
    }
  }
  return never;
}

}  // namespace luxodus
