// Invariant: a timer lies at the level of the highest six-bit group in which its deadline differs
// from now_, in the slot that this group of the deadline names (level 0 if none differs). So all
// timers of a level are due before those of the levels above, the first occupied slot of the lowest
// occupied level comes next, and equal deadlines always share a slot, in the order in which they
// were set. now_ may move freely up to the start of that slot; there its timers move down, or fire.
#include "runtime/actor/timers.hpp"

#include <algorithm>
#include <bit>

#include "runtime/core/check.hpp"

namespace luxodus {

Timers::Timers(size_t capacity, Nanoseconds now)
    : pool_("timers", capacity, WhenEmpty::mistake), now_(now) {
  LUX_CHECK(now >= 0, "a clock that starts before zero");
}

Timers::Place Timers::place_of(Nanoseconds deadline) const {
  const auto differing = static_cast<uint64_t>(deadline ^ now_);
  const size_t level = static_cast<size_t>(std::bit_width(differing | 1) - 1) / level_bits;
  return {level, static_cast<size_t>(deadline >> (level * level_bits)) % slots};
}

void Timers::insert(Timer& timer) {
  const Place place = place_of(timer.deadline);
  list_at(place).push_back(timer);
  levels_[place.level].occupied |= uint64_t{1} << place.slot;
}

TimerId Timers::set(Nanoseconds deadline, const Task& task) {
  Timer& timer = *pool_.take();
  timer.deadline = std::max(deadline, now_);
  timer.task = task;
  insert(timer);
  return {pool_.loan_of(timer)};
}

bool Timers::cancel(TimerId id) {
  Timer* timer = pool_.find(id.value);
  if (timer == nullptr) return false;
  const Place place = place_of(timer->deadline);
  timer->unlink();
  if (list_at(place).empty()) levels_[place.level].occupied &= ~(uint64_t{1} << place.slot);
  pool_.give(*timer);
  return true;
}

Timers::Place Timers::first_place() const {
  size_t level = 0;
  while (level < levels && levels_[level].occupied == 0) ++level;
  if (level == levels) return {levels, 0};
  return {level, static_cast<size_t>(std::countr_zero(levels_[level].occupied))};
}

Nanoseconds Timers::start_of(Place place) const {
  if (place.level == levels) return never;
  const size_t below = place.level * level_bits;
  const size_t above = below + level_bits;
  // The groups of the top level reach beyond the 63 bits of a time: there is no prefix above them.
  const Nanoseconds prefix = above < 63 ? now_ >> above << above : 0;
  return prefix | static_cast<Nanoseconds>(place.slot << below);
}

Nanoseconds Timers::next() const {
  return start_of(first_place());
}

void Timers::move_down(Place place) {
  levels_[place.level].occupied &= ~(uint64_t{1} << place.slot);
  while (Timer* timer = list_at(place).pop_front()) insert(*timer);
}

void Timers::fire(Timer& timer) {
  const Task task = timer.task;
  cancel({pool_.loan_of(timer)});
  task();
}

size_t Timers::run_due(Nanoseconds now, size_t most) {
  size_t fired = 0;
  while (fired < most && set_now() > 0) {
    const Place place = first_place();
    const Nanoseconds start = start_of(place);
    if (start > now) break;
    now_ = start;
    if (place.level > 0) {
      move_down(place);
    } else {
      fire(list_at(place).front());
      ++fired;
    }
  }
  if (next() > now) now_ = std::max(now_, now);
  return fired;
}

}  // namespace luxodus
