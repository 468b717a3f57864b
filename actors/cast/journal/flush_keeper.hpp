// Keeps what a coordinator counts, so that a run survives its node. Thread rule: one call at a
// time, from any thread; see JournalActor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/core/result.hpp"

namespace luxodus {

class FlushKeeper {
 public:
  virtual ~FlushKeeper() = default;
  /// Keeps a flush and the numbers of its batches durably. Errors: it could not; the coordinator
  /// counts the flush all the same.
  virtual Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush) = 0;
  /// Whether everything counted outlives the node. Workers stay until it does, since only they
  /// could trace again what a crash of the node loses.
  virtual bool is_whole() const = 0;
  /// Whether it wants to tidy up; then rest() is called soon, at a time when the run's totals hold
  /// everything kept.
  virtual bool rest_is_due() const { return false; }
  virtual void rest() {}
};

}  // namespace luxodus
