// Rare paths taken on purpose: places in the code where a simulation forces what may happen at any
// time but nearly never does in practice, such as a full queue or a small grant. Two seeds differ
// in which places are active at all, so that one kind of trouble does not hide another. Outside
// simulations nothing is forced, and a place costs the test of a null pointer. The idea and its
// name are FoundationDB's (Zhou et al., SIGMOD 2021, section 4). Thread rule: one node's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/core/random.hpp"

namespace luxodus {

class Buggify {
 public:
  enum class Site : uint8_t {
    full_outbox,     // the network accepts no message now
    object_missing,  // a holder denies having an object that it has
    early_eviction,  // the cache evicts an object although there is room
    short_turn,      // a turn resumes only one fiber
    few_timers,      // a turn calls only one timer
    early_flush,     // a batch is flushed as soon as it is merged
    small_wish,      // a node asks for one lease
    small_grant,     // the coordinator grants one lease
    no_room,         // a message of several pieces finds no room
    slow_disk,       // a write becomes durable only after a long time
  };
  static constexpr size_t sites = 10;

  /// Half of the sites are active, each with a probability of its own of up to one fifth.
  Buggify(uint64_t seed, uint64_t stream) : random_(seed, RandomStream::faults) {
    random_.start(stream);
    for (double& share : share_)
      share = random_.uniform_double() < 0.5 ? 0 : 0.2 * random_.uniform_double();
  }

  /// Whether to take the rare path this time.
  bool at(Site site) {
    const double share = share_[static_cast<size_t>(site)];
    const bool rare = share > 0 && random_.uniform_double() < share;
    taken_ += rare;
    return rare;
  }
  /// Number of rare paths taken.
  uint64_t taken() const { return taken_; }

 private:
  Random random_;
  std::array<double, sites> share_{};
  uint64_t taken_ = 0;
};

/// False without a Buggify.
inline bool rarely(Buggify* buggify, Buggify::Site site) {
  return buggify != nullptr && buggify->at(site);
}

}  // namespace luxodus
