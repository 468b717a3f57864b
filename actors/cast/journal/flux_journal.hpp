// What a controller has counted, on a disk before anybody is told: one record for each flush, the
// batches and the bytes of it. A run that begins again counts them once more, and has the totals it
// had, bit for bit. Together with a flux file that is older than some of its records, too. Thread
// rule: as FlushKeeper.
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
  /// Counts into `run` what the store holds and the run does not, and has it go on from there.
  /// Errors: as Journal::open; a record that does not belong to this run, or fits it in part only.
  static Result<std::unique_ptr<FluxJournal>> open(std::unique_ptr<AppendStore> store,
                                                   LocalRun& run);

  /// Errors: as Journal::append.
  Result<void> keep(std::span<const int64_t> batches, std::span<const std::byte> flush);
  /// The run's flux file holds everything now. Errors: as Journal::restart.
  Result<void> restart() { return journal_.restart(); }

  uint64_t bytes() const { return journal_.bytes(); }
  uint64_t records() const { return journal_.records(); }
  uint64_t torn_bytes() const { return journal_.torn_bytes(); }
  /// Batches that opening it has counted.
  int64_t recovered() const { return recovered_; }

 private:
  FluxJournal(Journal journal, int64_t recovered)
      : journal_(std::move(journal)), recovered_(recovered) {}

  Journal journal_;
  int64_t recovered_;
  std::vector<std::byte> record_;
};

}  // namespace luxodus
