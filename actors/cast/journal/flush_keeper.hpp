// Who keeps what a coordinator counts, so that a run survives its node.
// Thread rule: one call at a time, of whatever thread; see JournalActor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/core/result.hpp"

namespace luxodus {

class FlushKeeper {
 public:
  virtual ~FlushKeeper() = default;
  /// Keeps a flush and the numbers of its batches, whatever happens after this has returned true.
  /// Errors: it could not; the controller counts the flush all the same.
  virtual Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush) = 0;
  /// Whether all that was counted outlives the node. Workers stay until it does, since without
  /// them nobody could trace again what a crash of the node loses.
  virtual bool is_whole() const = 0;
  /// Whether it wants to tidy up; then rest() is called soon, when the run and its totals hold all
  /// that was kept.
  virtual bool rest_is_due() const { return false; }
  virtual void rest() {}
};

}  // namespace luxodus
