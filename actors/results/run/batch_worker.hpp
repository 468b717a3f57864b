// Does batches of a scene's state, one at a time, in portions: on a thread that takes them from the
// work itself, or on a node that has leased them. Derived classes define a batch: particles
// (particle_worker.hpp), tiles of pictures (actors/results/pictures/picture_tiles.hpp). Thread
// rule: one thread or fiber.
#pragma once

#include <cstdint>
#include <functional>

#include "actors/results/run/batch_range.hpp"
#include "scenes/light/tally/totals.hpp"

namespace luxodus {

class BatchWorker {
 public:
  virtual ~BatchWorker() = default;

  /// Begins one batch; unmerged results of the previous one are discarded.
  /// Throws std::runtime_error: this state has no such batch. Requires: batch.count == 1.
  virtual void begin(const BatchRange& batch) = 0;
  /// Does a portion of it: some milliseconds. Returns false once it is complete. Requires: it is
  /// not complete.
  virtual bool go_on() = 0;
  /// Adds the batch's results, and calls `rest` between steps of about a millisecond.
  /// Requires: it is complete; `totals` belong to this state, and nobody empties them meanwhile.
  virtual void merge_into(Totals& totals, const std::function<void()>& rest) = 0;

  /// Counts of work so far, for metrics.
  struct Counters {
    uint64_t particles = 0;
    uint64_t eye_units = 0;  // parts of signs, and probes, evaluated
    uint64_t paths = 0;      // paths of pictures
  };
  const Counters& counters() const { return counters_; }

 protected:
  Counters counters_;
};

}  // namespace luxodus
