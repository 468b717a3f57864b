// Does batches of a scene's state, one at a time, in portions, wherever that is: on a thread that
// takes them from the work itself, or on a node that they were leased to. What a batch is, is said
// by those who derive from it: particles (particle_worker.hpp), tiles of pictures
// (actors/results/pictures/picture_tiles.hpp). Thread rule: one thread or fiber.
#pragma once

#include <cstdint>
#include <functional>

#include "actors/results/run/batch_range.hpp"
#include "scenes/light/tally/totals.hpp"

namespace luxodus {

class BatchWorker {
 public:
  virtual ~BatchWorker() = default;

  /// Begins one batch; of the one before, what is not merged is forgotten.
  /// Throws std::runtime_error: there is no such batch in this state. Requires: batch.count == 1.
  virtual void begin(const BatchRange& batch) = 0;
  /// Does a portion of it: some milliseconds. False: now it is whole. Requires: it is not.
  virtual bool go_on() = 0;
  /// Adds what the batch has given, and calls `rest` between steps of a millisecond or so.
  /// Requires: it is whole; `totals` are of this state, and nobody empties them meanwhile.
  virtual void merge_into(Totals& totals, const std::function<void()>& rest) = 0;

  /// What was done so far, for metrics.
  struct Counters {
    uint64_t particles = 0;
    uint64_t eye_units = 0;  // parts of signs, and probes, looked at
    uint64_t paths = 0;      // of pictures
  };
  const Counters& counters() const { return counters_; }

 protected:
  Counters counters_;
};

}  // namespace luxodus
