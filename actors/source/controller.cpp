#include "actors/source/controller.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <limits>
#include <utility>

#include "actors/tally/flush_codec.hpp"
#include "runtime/core/check.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {
/// A worker that does not answer to the end is given up after this.
constexpr Nanoseconds farewell = seconds(5);
/// Leases for one question: two open batches and as many at hand need four.
constexpr uint32_t leases_per_question = 64;
}  // namespace

Controller::Controller(const ControllerConfig& config, LocalRun& run, const StopRule& stop,
                       const std::atomic<bool>& interrupt,
                       std::function<void(const Progress&)> report, Scheduler& scheduler,
                       Network& network)
    : config_(config),
      run_(run),
      stop_(stop),
      interrupt_(interrupt),
      report_(std::move(report)),
      scheduler_(scheduler),
      network_(network),
      book_(run.batches()),
      target_(run.target_batches(stop)),
      batches_at_start_(run.batches()),
      began_(scheduler.clock().now()),
      error_(std::numeric_limits<double>::quiet_NaN()) {}

void Controller::start() {
  if (book_.committed() >= target_)
    end_run(StopReason::particles);
  else
    open_round();
  set_timer();
}

// ---- rounds ----------------------------------------------------------------------------------

/// Rounds end where workers wait for one another: only an error target needs them.
void Controller::open_round() {
  const int64_t end =
      stop_.relative_error ? std::min(target_, run_.round_end(book_.committed())) : target_;
  book_.open_until(end);
  ++round_;
  for (const NodeId worker : config_.workers)
    send(worker, network_.next_id(), RoundOpened{round_, static_cast<uint64_t>(end)});
}

void Controller::end_round() {
  error_ = Readout(run_.scene(), run_.totals()).worst_relative_error();
  if (closing_) return end_run(interrupt_.load() ? StopReason::interrupted : StopReason::time);
  if (stop_.relative_error && error_ <= *stop_.relative_error) return end_run(StopReason::error);
  if (book_.committed() >= target_) return end_run(StopReason::particles);
  open_round();
}

void Controller::end_run(StopReason reason) {
  reason_ = reason;
  over_ = true;
  over_since_ = scheduler_.clock().now();
  run_.resume(book_.committed());
  tell_end();
}

void Controller::tell_end() {
  for (const NodeId worker : config_.workers)
    if (told_.count(worker) == 0) send(worker, network_.next_id(), RunEnded{round_, ""});
}

bool Controller::ended() const {
  if (!over_) return false;
  return told_.size() == config_.workers.size() ||
         scheduler_.clock().now() - over_since_ >= farewell;
}

// ---- what passes with time -------------------------------------------------------------------

void Controller::set_timer() {
  scheduler_.timers().set(scheduler_.clock().now() + config_.look_every, [this] { look(); });
}

void Controller::look() {
  const Nanoseconds now = scheduler_.clock().now();
  set_timer();
  if (over_) return tell_end();
  report_(progress());
  for (const Lease& lease : book_.fence_late(now)) {
    ++counters_.fenced;
    spdlog::warn("lease late lease={} node={} batch={}: lent again", lease.id, lease.node.value,
                 lease.batch);
    send(lease.node, network_.next_id(), LeasesFenced{{lease.id}});
  }
  const double passed = static_cast<double>(now - began_) * 1e-9;
  if (!closing_ && (interrupt_.load() || (stop_.seconds && passed >= *stop_.seconds))) {
    closing_ = true;
    book_.close();
    end_round_if_done();
  }
}

Progress Controller::progress() const {
  const double passed = static_cast<double>(scheduler_.clock().now() - began_) * 1e-9;
  return progress_of(stop_, run_.scene().batch_particles, batches_at_start_, book_.committed(),
                     passed, error_);
}

// ---- messages --------------------------------------------------------------------------------

void Controller::send(NodeId worker, const MessageId& id, const Message& message) {
  // What finds no room or no way is asked for again by the worker, or said again by look().
  network_.send(worker, id, message);
}

bool Controller::deliver(const Delivery& delivery) {
  if (const auto* request = std::get_if<RequestLease>(&delivery.message)) {
    lend(delivery, *request);
  } else if (const auto* flush = std::get_if<Flush>(&delivery.message)) {
    take_flush(delivery, *flush);
  } else {
    return false;
  }
  return true;
}

void Controller::lend(const Delivery& delivery, const RequestLease& request) {
  if (over_ && request.batches == 0) {
    told_.insert(delivery.source);
    return;
  }
  Answered& last = last_grant_[delivery.source];
  if (last.question != delivery.id) {
    const Nanoseconds deadline = scheduler_.clock().now() + config_.lease_time;
    const LentBatches lent =
        book_.lend(delivery.source, std::min(request.batches, leases_per_question), deadline);
    counters_.leases += static_cast<uint64_t>(lent.count);
    last = {delivery.id,
            LeaseGranted{lent.first_lease, round_, static_cast<uint64_t>(lent.first_batch),
                         static_cast<uint32_t>(lent.count),
                         static_cast<uint32_t>(config_.lease_time / milliseconds(1))}};
  }
  send(delivery.source, delivery.id, *last.answer);
}

void Controller::take_flush(const Delivery& delivery, const Flush& flush) {
  Answered& last = last_flush_[delivery.source];
  if (last.question == delivery.id) {
    if (last.answer) send(delivery.source, delivery.id, *last.answer);
    return;
  }
  if (last.question.sequence != 0 && !last.answer) return;  // one at a time: it will ask again
  last = {delivery.id, std::nullopt};
  counters_.flush_bytes += delivery.payload.size();
  arrived_.push_back(
      {delivery.source, delivery.id, flush, {delivery.payload.begin(), delivery.payload.end()}});
  if (std::exchange(counting_, true)) return;
  LUX_CHECK(scheduler_.fibers().start("count", [this] { count_flushes(); }),
            "a controller has fibers to spare");
}

/// On a fiber of its own. What follows from the last one is done on the scheduler's stack.
void Controller::count_flushes() {
  while (!arrived_.empty()) {
    const ArrivedFlush arrived = std::move(arrived_.front());
    arrived_.pop_front();
    answer_flush(arrived, count_flush(arrived));
  }
  counting_ = false;
  scheduler_.timers().set(scheduler_.clock().now(), [this] { end_round_if_done(); });
}

bool Controller::rest() const {
  return scheduler_.fibers().yield() != Wake::cancelled;
}

/// Takes a flush whole, or tells why not.
Result<bool> Controller::count_flush(const ArrivedFlush& arrived) {
  Hasher hash;
  hash.add(arrived.payload.data(), arrived.payload.size());
  if (hash.value() != arrived.flush.payload_hash)
    return Problem{{}, "the payload is not what its hash says"};
  const Problem fenced{{}, "a lease was fenced"};
  if (!book_.stand(arrived.from, arrived.flush.leases)) return fenced;
  const auto gain = decode_flush(arrived.payload, run_.totals().groups(),
                                 run_.scene().layout.totals(), [this] { return rest(); });
  if (!gain.ok()) return gain.problem();
  if (gain->batches() != static_cast<int64_t>(arrived.flush.leases.size()) ||
      !gain->ledger().closes())
    return Problem{{}, "its batches or its ledger do not add up"};
  // Committed before anything is added, so that no lease of it can be fenced between two rests.
  if (!book_.stand(arrived.from, arrived.flush.leases)) return fenced;
  book_.commit(arrived.flush.leases);
  gain->add_to(run_.totals(), [this] { return rest(); });
  return true;
}

void Controller::answer_flush(const ArrivedFlush& arrived, const Result<bool>& taken) {
  Answered& last = last_flush_[arrived.from];
  if (taken.ok()) {
    ++counters_.flushes_taken;
    last.answer = FlushTaken{};
  } else {
    ++counters_.flushes_refused;
    last.answer = FlushRefused{{}, taken.problem().what};
    spdlog::warn("flush refused node={}: {}", arrived.from.value, taken.problem().what);
  }
  send(arrived.from, arrived.id, *last.answer);
}

/// A round is over when all of it is committed and added.
void Controller::end_round_if_done() {
  if (!over_ && !counting_ && book_.round_done()) end_round();
}

}  // namespace luxodus
