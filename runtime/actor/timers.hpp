// Timers: a hierarchical timing wheel (Varghese, Lauck, "Hashed and hierarchical timing wheels",
// SOSP 1987, scheme 7) with a tick of one nanosecond. Setting and cancelling are O(1) and allocate
// nothing. Timers fire in the exact order of their deadlines, equal ones in the order in which they
// were set, so that simulated runs are reproducible. They never fire early; they are late only if
// the caller is. Thread rule: belongs to one node.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "runtime/core/clock.hpp"
#include "runtime/core/fixed_pool.hpp"
#include "runtime/core/ids.hpp"
#include "runtime/core/intrusive_list.hpp"
#include "runtime/core/task.hpp"

namespace luxodus {

/// A timer, until it fires or is cancelled.
using TimerId = Id<struct TimerTag, Loan>;

/// Later than every deadline.
inline constexpr Nanoseconds never = std::numeric_limits<Nanoseconds>::max();

class Timers {
  struct Timer : ListHook {
    Nanoseconds deadline = 0;
    Task task;
  };

 public:
  /// For a memory plan.
  static constexpr size_t bytes_each = sizeof(Timer) + FixedPool<Timer>::bytes_beside;

  /// At most `capacity` timers at once: one for each fiber that waits with a deadline, plus those
  /// of the node's parts; one more aborts the process. Requires: now >= 0.
  Timers(size_t capacity, Nanoseconds now);

  /// Calls `task` from run_due() at or after `deadline`; a deadline in the past counts as now.
  TimerId set(Nanoseconds deadline, const Task& task);
  /// Returns false, and does nothing, if the timer has fired or was cancelled.
  bool cancel(TimerId id);

  /// Fires due timers, at most `most`; what a task sets for now is due in the same call. Returns
  /// the number fired. Requires: now never goes back.
  size_t run_due(Nanoseconds now, size_t most);

  /// When to call run_due() next: at or before the earliest deadline; `never` if no timer is set.
  Nanoseconds next() const;

  size_t set_now() const { return pool_.in_use(); }
  size_t capacity() const { return pool_.capacity(); }

 private:
  // Six bits of the deadline choose the slot of a level; eleven levels cover 63 bits.
  static constexpr size_t level_bits = 6;
  static constexpr size_t slots = size_t{1} << level_bits;
  static constexpr size_t levels = 11;
  struct Level {
    uint64_t occupied = 0;  // bit i: slot i is not empty
    std::array<IntrusiveList<Timer>, slots> slot;
  };
  struct Place {
    size_t level;
    size_t slot;
  };

  Place place_of(Nanoseconds deadline) const;
  IntrusiveList<Timer>& list_at(Place place) { return levels_[place.level].slot[place.slot]; }
  void insert(Timer& timer);
  Place first_place() const;
  Nanoseconds start_of(Place place) const;
  void move_down(Place place);
  void fire(Timer& timer);

  FixedPool<Timer> pool_;
  Nanoseconds now_;
  std::array<Level, levels> levels_;
};

}  // namespace luxodus
