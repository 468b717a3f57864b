// A write-ahead journal of the flushes that a controller counts: one record for each flush, with
// its batches and its bytes. A restarted run counts them again, and has the same totals, bit for
// bit; also together with a flux file that is older than some of the records. Thread rule: that of
// FlushKeeper.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "actors/results/run/local_run.hpp"
#include "runtime/storage/journal.hpp"

namespace luxodus {

class FluxJournal final {
 public:
  /// Counts into `run` what the store holds and the run does not, and lets it continue from there.
  /// Errors: those of Journal::open; a record that does not belong to this run, or overlaps with it
  /// only in part.
  static Result<std::unique_ptr<FluxJournal>> open(std::unique_ptr<AppendStore> store,
                                                   LocalRun& run);

  /// Errors: those of Journal::append.
  Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush);
  /// Empties the journal, once the run's flux file holds everything. Errors: those of
  /// Journal::restart.
  Result<void> restart() { return journal_.restart(); }

  uint64_t bytes() const { return journal_.bytes(); }
  uint64_t records() const { return journal_.records(); }
  uint64_t torn_bytes() const { return journal_.torn_bytes(); }
  /// Number of batches that open() has counted.
  int64_t recovered() const { return recovered_; }

 private:
  FluxJournal(Journal journal, int64_t recovered)
      : journal_(std::move(journal)), recovered_(recovered) {}

  Journal journal_;
  int64_t recovered_;
  std::vector<std::byte> record_;
};

}  // namespace luxodus
