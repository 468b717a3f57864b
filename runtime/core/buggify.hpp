// Rare ways on purpose: places in the code where a simulation has it do what it may do at any time,
// and in practice nearly never does: a queue that is full, a grant that is small. Two seeds differ
// in which places are active at all, so that one kind of trouble does not hide another. Elsewhere
// there is none, and a place costs a look at a null pointer. The idea and its name are
// FoundationDB's (Zhou et al., SIGMOD 2021, section 4). Thread rule: one node's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/core/random.hpp"

namespace luxodus {

class Buggify {
 public:
  enum class Site : uint8_t {
    full_outbox,     // the network takes no message now
    object_missing,  // a holder says that it has not what it has
    early_eviction,  // the cache gives up an object although there is room
    short_turn,      // a turn resumes one fiber, and no more
    few_timers,      // a turn calls one timer, and no more
    early_flush,     // a batch is flushed as soon as it is merged
    small_wish,      // a node asks for one lease
    small_grant,     // and is granted one
    no_room,         // a message of several pieces finds no room
    slow_disk,       // what is written is durable after a long time only
  };
  static constexpr size_t sites = 10;

  /// Half of the sites are active, each at a share of its own of up to a fifth.
  Buggify(uint64_t seed, uint64_t stream) : random_(seed, RandomStream::faults) {
    random_.start(stream);
    for (double& share : share_)
      share = random_.uniform_double() < 0.5 ? 0 : 0.2 * random_.uniform_double();
  }

  /// Whether to take the rare way this time.
  bool at(Site site) {
    const double share = share_[static_cast<size_t>(site)];
    const bool rare = share > 0 && random_.uniform_double() < share;
    taken_ += rare;
    return rare;
  }
  /// Rare ways taken.
  uint64_t taken() const { return taken_; }

 private:
  Random random_;
  std::array<double, sites> share_{};
  uint64_t taken_ = 0;
};

/// Null: never.
inline bool rarely(Buggify* buggify, Buggify::Site site) {
  return buggify != nullptr && buggify->at(site);
}

}  // namespace luxodus
