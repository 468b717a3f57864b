// Work that runs in processes of its own, so that one library's threads, memory and settings of the
// C library do not reach another's figures. Requires of all: this process has one thread.
#pragma once

#include <sys/types.h>

#include <optional>
#include <vector>

#include "runtime/core/clock.hpp"
#include "tests/bench/peers/peer.hpp"

namespace luxodus::bench {

/// What a while of work took.
struct Sample {
  double count = 0;
  double wall_s = 0;
  double processor_s = 0;  // of all threads of the processes that work

  double rate() const { return count / wall_s; }
  double processor_ns() const { return processor_s * 1e9 / count; }
};

/// Any thread.
void let_pass(Nanoseconds span);

/// Waits until `warm` is done, lets a fifth of `span` pass, and takes `span`. `others` work beside
/// this process. Nothing if the work does not begin within 20 s. Any thread.
std::optional<Sample> sample(const Count& work, uint64_t warm, Nanoseconds span,
                             const std::vector<pid_t>& others);

/// Objects that a second process asks a first for, or what the peer's own command says.
std::optional<Sample> transfer(const Peer& peer, const Transfer& work, Nanoseconds span);
/// Messages that two actors send each other.
std::optional<Sample> play(void (*plays)(Count&), Nanoseconds span);
/// Resident memory of each of so many [bytes].
std::optional<double> bytes_of_each(void (*holds)(size_t, const std::function<void()>&),
                                    size_t count);
/// How long after it was killed, on a link that was idle for `idle`, the other process knew [s].
std::optional<double> known_after(const Peer& peer, const Transfer& link, Nanoseconds idle);

}  // namespace luxodus::bench
