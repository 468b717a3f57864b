// The photon-threads of a node: fibers that trace particles of leased batches. A batch's particles
// are distributed in small portions, so that many fibers work on one batch and wait for different
// objects. Its scores are one array, since all fibers of a node run on one thread and sums of
// integers do not depend on order. Finished batches are merged into the node's own totals, which
// leave as a flush. It sends no messages: LeasePort asks for leases and sends flushes. Thread rule:
// the node's thread.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "actors/cast/tracing/tally_need.hpp"
#include "actors/results/run/leased_work.hpp"
#include "actors/results/run/particle_worker.hpp"
#include "actors/results/run/planned_batches.hpp"
#include "runtime/actor/scheduler.hpp"
#include "runtime/observe/node_trace.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

struct PhotonConfig {
  /// Number of photon-threads. One is enough if everything is resident; otherwise as many as hide
  /// the waits for objects.
  size_t fibers = 1;
  /// Batches in work at once, each with an array of scores: the second one fills the time in which
  /// the last particles of the first end.
  size_t open_batches = 2;
  /// Leases at hand, including those of open batches: when a batch is opened, more are requested.
  /// Two beside the open ones cover the time to an answer; more would only wait here while other
  /// nodes idle.
  size_t leases = 4;
  /// Most particles of one portion. At 0.3 us a ray a portion takes about 0.2 ms: short against a
  /// turn of 1 ms, long against the 60 ns of a switch.
  int64_t portion = 128;
  /// Budget for scores, totals and a flush [B]. If it is smaller than all bins, one batch is in
  /// work at a time, empty memory is returned at once, and the tally flushes when it is full.
  uint64_t tally_bytes = UINT64_MAX;
  /// Sampled particles are traced separately, which changes no bit. Null: no tracing.
  NodeTrace* trace = nullptr;

  size_t batches_in_work() const { return std::min(open_batches, leases); }
};

class TracingFibers final : public LeasedWork {
 public:
  /// Requires: all references outlive this.
  TracingFibers(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed,
                const PhotonConfig& config, Scheduler& scheduler, LeasePort& port,
                const TracerMaker& make_tracer = make_batch_tracer);
  ~TracingFibers() override;

  /// Starts the fibers.
  void start();
  void add(uint64_t lease, int64_t batch) override;
  void drop(std::span<const uint64_t> leases) override;
  void drop_all() override;
  void look_again() override { scheduler_.fibers().wake_all(work_); }
  /// Makes every fiber return at its next chance.
  void end(const std::string& why) override;

  Totals& give_totals() override;
  bool may_give() const override { return merges_ == 0; }
  const Totals& totals() const override { return totals_[0]; }
  size_t at_hand() const override;

  struct Counters {
    uint64_t particles = 0;
    uint64_t eye_units = 0;        // views of signs and probes
    uint64_t batches = 0;          // merged
    uint64_t batches_failed = 0;   // for lack of an object
    uint64_t batches_dropped = 0;  // their lease was fenced
    uint64_t rays = 0;             // of merged batches
    uint64_t collisions = 0;
    uint64_t batches_open = 0;
    uint64_t fibers_idle = 0;  // waiting for work
    uint64_t tally_full = 0;   // times that a batch waited for room
    uint64_t max_tally_bytes = 0;
  };
  const Counters& counters() const { return counters_; }
  void add_metrics(Metrics& metrics) const;

 private:
  struct OpenBatch;
  struct Portion;

  void trace_until_the_end(BatchTracer& tracer);
  void trace_portions(BatchTracer& tracer);
  bool trace_particles(BatchTracer& tracer, const Portion& portion);
  bool trace_row(BatchTracer& tracer, OpenBatch& open, uint64_t first, int64_t count);
  bool rest_after(uint64_t rays);
  void rest_after_path();
  std::optional<Portion> next_portion();
  OpenBatch* open_next();
  void count_totals();
  bool fits(OpenBatch& open, size_t more);
  bool room_for_batch();
  bool make_room(OpenBatch& open, size_t more);
  void outgrown(const OpenBatch& open);
  bool finish(OpenBatch& open);
  void close(OpenBatch& batch);
  void merge(OpenBatch& batch);
  void rest();
  bool holds_sampled(const OpenBatch& open) const;

  const CompiledScene& scene_;
  ObjectSource* const source_;  // null if everything is resident
  const uint64_t seed_;
  const std::vector<uint32_t> places_;  // of emitters, if cells may be waited for
  const PhotonConfig config_;
  const int64_t portion_;
  const bool tight_;  // the budget is smaller than all bins
  Scheduler& scheduler_;
  LeasePort& port_;
  std::vector<std::unique_ptr<BatchTracer>> tracers_;  // one per fiber
  std::vector<OpenBatch> open_;
  Totals totals_[2];  // one is filled while the other is emptied
  size_t merging_ = 0;
  size_t merges_ = 0;                // of batches, in progress
  size_t totals_bytes_[2] = {0, 0};  // in memory, at the last count; an upper bound since then
  size_t tally_bytes_ = 0;           // of everything, an upper bound found by fits()
  PlannedBatches planned_;
  struct WaitingLease {
    uint64_t id;
    int64_t batch;
  };
  std::vector<WaitingLease> leases_;  // not begun, the oldest first
  WaitList work_;                     // fibers without work
  bool ending_ = false;
  uint64_t rays_since_rest_ = 0;   // of particles; a bound, since several fibers count
  uint64_t paths_since_rest_ = 0;  // from eyes
  Counters counters_;
  Histogram batch_time_;  // from opening to merging
};

}  // namespace luxodus
