// A fiber takes a portion, traces it, and looks for the next; if there is none it rests in work_.
// Any fiber may take any portion of a batch, so a batch ends with its slowest portion; meanwhile
// the next batch is open. The fiber that finishes the last portion closes the batch.
// If the tally may not hold all bins, a fiber that has scored or is about to merge first checks for
// room, and rests until a flush has made some. A flush waits only for the controller, never for
// these fibers; so either there will be room, or the one batch in work exceeds the budget.
#include "actors/cast/tracing/tracing_fibers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/results/run/particle_portion.hpp"
#include "proto/messages.hpp"
#include "runtime/core/check.hpp"
#include "scenes/light/transport/birth_order.hpp"
#include "scenes/light/transport/readout.hpp"

namespace luxodus {

/// A batch in work.
struct TracingFibers::OpenBatch {
  bool used = false;
  bool dropped = false;  // its lease was fenced
  bool failed = false;   // an object was unobtainable
  uint64_t lease = 0;
  Batch batch;
  BatchScores scores;
  bool cleared = true;          // the scores are zero
  int64_t next_particle = 0;    // of the batch, not yet given out
  std::vector<uint32_t> order;  // of its particles; empty: by number
  uint32_t next_unit = 0;       // of the eye paths
  uint32_t portions_out = 0;
  Nanoseconds since = 0;
};

struct TracingFibers::Portion {
  OpenBatch* batch;
  int64_t first;  // particle within the batch
  int64_t count;  // 0: the eye unit below
  uint32_t unit;
};

namespace {

/// Particles per portion, so that every fiber finds a few portions in the open batches: with fewer
/// portions than fibers, the others would be idle and hide no waits.
int64_t portion_for(const PhotonConfig& config, int64_t batch_particles) {
  const auto open = static_cast<int64_t>(config.open_batches) * batch_particles;
  return std::clamp<int64_t>(open / (4 * static_cast<int64_t>(config.fibers)), 1, config.portion);
}

/// Paths from eyes after which a fiber lets others run; each has at most limits::eye_events events
/// of some 1 us.
constexpr uint64_t paths_between_rests = 8;

}  // namespace

TracingFibers::TracingFibers(const CompiledScene& scene, const GeometryAccess& access,
                             uint64_t seed, const PhotonConfig& config, Scheduler& scheduler,
                             LeasePort& port, const TracerMaker& make_tracer)
    : scene_(scene),
      source_(access.source),
      seed_(seed),
      places_(source_ == nullptr ? std::vector<uint32_t>() : places_of_emitters(scene)),
      config_(config),
      portion_(portion_for(config, scene.batch_particles)),
      tight_(tally_need(scene, config.batches_in_work()).all() > config.tally_bytes),
      scheduler_(scheduler),
      port_(port),
      open_(tight_ ? 1 : config.batches_in_work()),
      totals_{{scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene),
               tight_ ? Cleared::given_back : Cleared::kept},
              {scene.layout, static_cast<int>(scene.groups.size()), photopic_weights(scene),
               tight_ ? Cleared::given_back : Cleared::kept}},
      planned_(scene) {
  for (size_t i = 0; i < config.fibers; ++i) {
    tracers_.push_back(make_tracer(scene, access, seed));
    tracers_.back()->rest_between_paths([this] { rest_after_path(); });
  }
  for (OpenBatch& batch : open_)
    batch.scores.reset(scene.layout, tight_ ? Cleared::given_back : Cleared::kept);
  leases_.reserve(config.leases + limits::leases);
}

TracingFibers::~TracingFibers() = default;

void TracingFibers::start() {
  for (const auto& tracer : tracers_) {
    const auto body = [this, tracer = tracer.get()] { trace_until_the_end(*tracer); };
    LUX_CHECK(scheduler_.fibers().start("photon", body), "the plan counts a fiber for each");
  }
}

/// An exception is a failure of the tracer.
void TracingFibers::trace_until_the_end(BatchTracer& tracer) {
  std::exception_ptr why;
  try {
    trace_portions(tracer);
  } catch (...) {
    why = std::current_exception();
  }
  if (!why) return;
  end("");  // the others would go on with its share
  port_.thread_failed(why);
}

void TracingFibers::add(uint64_t lease, int64_t batch) {
  leases_.push_back({lease, batch});
  scheduler_.fibers().wake_all(work_);
}

void TracingFibers::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"particles", "", "Particles traced.", ""}, c.particles);
  metrics.add_counter({"eye_units", "", "Parts of signs, and probes, looked at.", ""}, c.eye_units);
  metrics.add_counter({"batches", "", "Batches merged here.", ""}, c.batches);
  metrics.add_counter({"batches_failed", "", "Batches traced in vain, for want of an object.", ""},
                      c.batches_failed);
  metrics.add_counter({"batches_dropped", "", "Batches whose lease was fenced.", ""},
                      c.batches_dropped);
  metrics.add_counter({"rays", "", "Rays of merged batches.", ""}, c.rays);
  metrics.add_counter({"collisions", "", "Collisions with media, of merged batches.", ""},
                      c.collisions);
  metrics.add_gauge({"batches_open", "", "Batches in work.", ""}, c.batches_open);
  metrics.add_gauge({"fibers_idle", "", "Photon-threads that wait for work.", ""}, c.fibers_idle);
  metrics.add_counter({"tally_full", "", "Waits of batches for room in the tally.", ""},
                      c.tally_full);
  metrics.add_gauge({"tally_most", "bytes",
                     "The most that the tally has taken, where its budget "
                     "is less than all bins take.",
                     ""},
                    c.max_tally_bytes);
  metrics.add_histogram({"batch", "", "From a batch's opening to its merging.", ""}, batch_time_);
}

void TracingFibers::drop(std::span<const uint64_t> leases) {
  const auto named = [&](uint64_t id) {
    return std::find(leases.begin(), leases.end(), id) != leases.end();
  };
  std::erase_if(leases_, [&](const WaitingLease& waiting) { return named(waiting.id); });
  for (OpenBatch& open : open_)
    if (open.used && named(open.lease)) open.dropped = true;
}

void TracingFibers::drop_all() {
  leases_.clear();
  for (OpenBatch& open : open_) open.dropped = open.used;
  look_again();
}

void TracingFibers::end(const std::string&) {
  ending_ = true;
  scheduler_.fibers().wake_all(work_);
}

Totals& TracingFibers::give_totals() {
  merging_ = 1 - merging_;
  return totals_[1 - merging_];
}

size_t TracingFibers::at_hand() const {
  const auto used = [](const OpenBatch& open) { return open.used; };
  return leases_.size() + static_cast<size_t>(std::count_if(open_.begin(), open_.end(), used));
}

void TracingFibers::trace_portions(BatchTracer& tracer) {
  Fibers& fibers = scheduler_.fibers();
  while (!ending_) {
    const std::optional<Portion> portion = next_portion();
    if (!portion) {
      ++counters_.fibers_idle;
      const Wake how = fibers.wait(work_, "work");
      --counters_.fibers_idle;
      if (how == Wake::cancelled) return;
      continue;
    }
    OpenBatch& open = *portion->batch;
    const Batch& batch = open.batch;
    if (open.failed || open.dropped) {
      // It will not be counted, so the rest of it is skipped.
    } else if (portion->count > 0) {
      if (!trace_particles(tracer, *portion)) return;
      counters_.particles += static_cast<uint64_t>(portion->count);
    } else {
      ++counters_.eye_units;
      fibers.set_subject(NodeTrace::nobody);
      tracer.look(batch.number, portion->unit, open.scores);
    }
    if (source_ != nullptr && source_->spoilt()) open.failed = true;
    if (tight_ && !make_room(open, 0)) return;
    --open.portions_out;
    const bool given_out =
        open.next_particle == scene_.batch_particles && open.next_unit == tracer.look_units();
    if (given_out && open.portions_out == 0 && !finish(open)) return;
    rays_since_rest_ = paths_since_rest_ = 0;
    if (fibers.yield() == Wake::cancelled) return;
  }
}

/// False: the node ends, and the portion remains unfinished.
bool TracingFibers::trace_particles(BatchTracer& tracer, const Portion& portion) {
  OpenBatch& open = *portion.batch;
  const uint64_t of_batch = open.batch.first_particle;
  if (open.order.empty())
    return trace_row(tracer, open, of_batch + static_cast<uint64_t>(portion.first), portion.count);
  for (int64_t i = portion.first; i < portion.first + portion.count && !open.failed; ++i) {
    if (!trace_row(tracer, open, of_batch + open.order[static_cast<size_t>(i)], 1)) return false;
    if (source_ != nullptr && source_->spoilt()) open.failed = true;
  }
  return true;
}

/// Traces up to the next sampled particle at once, and that particle alone. The rest of a dropped
/// batch is skipped. False: as of trace_particles.
bool TracingFibers::trace_row(BatchTracer& tracer, OpenBatch& open, uint64_t first, int64_t count) {
  Fibers& fibers = scheduler_.fibers();
  NodeTrace* const trace = config_.trace;
  const uint64_t end = first + static_cast<uint64_t>(count);
  while (first < end && !open.dropped) {
    const uint64_t sampled = trace == nullptr ? end : trace->next_wanted(first);
    const uint64_t stop = sampled == first ? first + 1 : std::min(sampled, end);
    const uint64_t before = open.scores.balance.rays;
    fibers.set_subject(first);
    if (sampled == first)
      trace->begin(TraceKind::particle, first, static_cast<uint64_t>(open.batch.number));
    const int64_t traced =
        trace_portion(tracer, open.batch.group, first, static_cast<int64_t>(stop - first),
                      limits::rays_per_portion - rays_since_rest_, open.scores);
    if (sampled == first)
      trace->end(TraceKind::particle, first, static_cast<uint64_t>(open.batch.number));
    first += static_cast<uint64_t>(traced);
    if (!rest_after(open.scores.balance.rays - before)) return false;
  }
  return true;
}

/// Yields if enough rays were traced since the last time. False: the node ends.
bool TracingFibers::rest_after(uint64_t rays) {
  rays_since_rest_ += rays;
  if (rays_since_rest_ < limits::rays_per_portion) return true;
  rays_since_rest_ = 0;
  return scheduler_.fibers().yield() != Wake::cancelled && !ending_;
}

void TracingFibers::rest_after_path() {
  if (++paths_since_rest_ < paths_between_rests) return;
  paths_since_rest_ = 0;
  rest();
}

std::optional<TracingFibers::Portion> TracingFibers::next_portion() {
  const uint32_t units = tracers_.front()->look_units();
  OpenBatch* oldest = nullptr;  // should end next
  for (OpenBatch& open : open_) {
    const bool left = open.next_particle < scene_.batch_particles || open.next_unit < units;
    if (open.used && left && (oldest == nullptr || open.batch.number < oldest->batch.number))
      oldest = &open;
  }
  if (oldest == nullptr) oldest = open_next();
  if (oldest == nullptr) return std::nullopt;
  OpenBatch& open = *oldest;
  ++open.portions_out;
  if (open.next_particle == scene_.batch_particles) return Portion{&open, 0, 0, open.next_unit++};
  const int64_t first = open.next_particle;
  const int64_t count = std::min(portion_, scene_.batch_particles - first);
  open.next_particle += count;
  return Portion{&open, first, count, 0};
}

bool TracingFibers::holds_sampled(const OpenBatch& open) const {
  const uint64_t first = open.batch.first_particle;
  return config_.trace != nullptr &&
         config_.trace->next_wanted(first) < first + static_cast<uint64_t>(scene_.batch_particles);
}

TracingFibers::OpenBatch* TracingFibers::open_next() {
  if (at_hand() < config_.leases) port_.want_leases(config_.leases - at_hand());
  const auto free =
      std::find_if(open_.begin(), open_.end(), [](const OpenBatch& open) { return !open.used; });
  if (free == open_.end() || leases_.empty() || (tight_ && !room_for_batch())) return nullptr;
  const WaitingLease lease = leases_.front();
  leases_.erase(leases_.begin());
  free->used = true;
  free->dropped = free->failed = false;
  free->lease = lease.id;
  free->batch = planned_.at(lease.batch);
  free->next_particle = 0;
  free->next_unit = 0;
  if (source_ != nullptr) {
    order_by_emitter(scene_, places_, seed_, free->batch.group, free->batch.first_particle,
                     static_cast<uint32_t>(scene_.batch_particles), free->order);
  }
  if (!std::exchange(free->cleared, false)) free->scores.reset(scene_.layout);
  free->scores.balance = {};
  free->since = scheduler_.clock().now();
  ++counters_.batches_open;
  if (holds_sampled(*free))
    config_.trace->begin(TraceKind::batch, free->lease, static_cast<uint64_t>(free->batch.number));
  scheduler_.fibers().wake_all(work_);  // there is work for more than this fiber
  return &*free;
}

// ---- limits of the tally ---------------------------------------------------------------------

void TracingFibers::count_totals() {
  for (size_t i = 0; i < 2; ++i) totals_bytes_[i] = totals_[i].bytes();
}

/// Whether the tally with `more` bytes is within its budget. Pages are counted only if bounds do
/// not decide it.
bool TracingFibers::fits(OpenBatch& open, size_t more) {
  const auto with = [&](size_t scores) {
    tally_bytes_ = port_.flush_bytes() + totals_bytes_[0] + totals_bytes_[1] + scores + more;
    return tally_bytes_ <= config_.tally_bytes;
  };
  if (with(open.scores.scores.size() * sizeof(int64_t) + ZeroedMemory::page_bytes)) return true;
  count_totals();
  open.scores.scores.find_touched();
  return with(open.scores.scores.bytes());
}

/// Whether to open the next batch now. Half the budget is for what batches leave behind; the other
/// half for the next one.
bool TracingFibers::room_for_batch() {
  count_totals();
  const size_t bytes = port_.flush_bytes() + totals_bytes_[0] + totals_bytes_[1];
  if (!port_.room_to_come() || bytes <= config_.tally_bytes / 2) return true;
  port_.want_room();
  return false;
}

/// Rests until the tally has `more` bytes free. False: the run has ended, or will end for lack of
/// room.
bool TracingFibers::make_room(OpenBatch& open, size_t more) {
  for (bool waits = false; !open.dropped && !fits(open, more); waits = true) {
    if (!port_.room_to_come()) {
      outgrown(open);
      return false;
    }
    if (!waits) ++counters_.tally_full;
    port_.want_room();
    if (scheduler_.fibers().wait(work_, "tally") == Wake::cancelled || ending_) return false;
  }
  counters_.max_tally_bytes = std::max<uint64_t>(counters_.max_tally_bytes, tally_bytes_);
  return true;
}

void TracingFibers::outgrown(const OpenBatch& open) {
  const auto mebibytes = [](uint64_t bytes) { return static_cast<double>(bytes) / 0x1p20; };
  port_.give_up(problem(
      fmt::format(
          "batch {} of {} particles takes {:.1f} MiB of tally by itself, and tally_bytes is "
          "{:.1f} MiB: raise tally_bytes in [budget], or lower batch_particles in the "
          "scene",
          open.batch.number, scene_.batch_particles, mebibytes(tally_bytes_),
          mebibytes(config_.tally_bytes)),
      ProblemKind::no_room));
}

/// Closes a fully traced batch when the totals have room for it.
bool TracingFibers::finish(OpenBatch& open) {
  if (!tight_) {
    close(open);
    return true;
  }
  const auto needed = [&] {
    open.scores.scores.find_touched();
    return totals_[merging_].bytes_to_merge(open.scores, open.batch.group);
  };
  for (size_t more = needed();; more = needed()) {
    if (!make_room(open, more)) return false;
    // otherwise the totals were given away meanwhile, and these are empty
    if (needed() <= more) break;
  }
  close(open);
  if (!std::exchange(open.cleared, true)) open.scores.scores.clear();
  totals_bytes_[merging_] = totals_[merging_].bytes();
  if (totals_bytes_[merging_] > totals_share(config_.tally_bytes)) port_.want_room();
  return true;
}

void TracingFibers::close(OpenBatch& open) {
  const bool counts = !open.dropped && !open.failed;
  if (counts) merge(open);
  open.used = false;
  --counters_.batches_open;
  if (holds_sampled(open))
    config_.trace->end(TraceKind::batch, open.lease, static_cast<uint64_t>(open.batch.number));
  if (!counts && open.dropped) {  // another node traces it
    ++counters_.batches_dropped;
    return;
  }
  if (!counts) {
    ++counters_.batches_failed;
    return port_.lease_failed(open.lease, open.batch.number);
  }
  ++counters_.batches;
  counters_.rays += open.scores.balance.rays;
  counters_.collisions += open.scores.balance.collisions;
  batch_time_.add(scheduler_.clock().now() - open.since);
  port_.leases_done({&open.lease, 1});
}

/// Millions of bins take longer than a turn may: other fibers run between steps. Totals are not
/// given away meanwhile, nor until the lease is reported, which follows without a rest: so they
/// always hold the batches of reported leases, whole.
void TracingFibers::merge(OpenBatch& open) {
  ++merges_;
  if (scheduler_.rarely(Buggify::Site::short_turn)) rest();
  totals_[merging_].merge(open.scores, open.batch.group, [this] { rest(); });
  open.scores.scores.clear_in_steps([this] { rest(); });
  open.cleared = true;
  --merges_;
}

/// Yields. A node that is ending still completes what has begun.
void TracingFibers::rest() {
  (void)scheduler_.fibers().yield();
}

}  // namespace luxodus
