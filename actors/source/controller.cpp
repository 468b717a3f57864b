#include "actors/source/controller.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <limits>

#include "actors/tally/flush_codec.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

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
  note_book();
  if (book_.committed() >= target_)
    end_run(StopReason::particles);
  else
    open_round();
  set_timer();
}

void Controller::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"leases_lent", "", "Batches lent.", ""}, c.leases);
  metrics.add_counter({"leases_fenced", "", "Leases that were late, or whose node was gone.", ""},
                      c.fenced);
  metrics.add_counter({"flushes_taken", "", "Flushes counted.", ""}, c.flushes_taken);
  metrics.add_counter({"flushes_not_taken", "", "Flushes refused.", ""}, c.flushes_refused);
  metrics.add_counter({"flush_in", "bytes", "Bytes of flushes that came.", ""}, c.flush_bytes);
  metrics.add_counter({"batches_counted", "", "Batches counted.", ""}, c.batches);
  metrics.add_counter({"particles_counted", "", "Particles of batches counted.", ""}, c.particles);
  metrics.add_gauge({"round", "", "Rounds begun.", ""}, c.round);
  metrics.add_gauge({"leases_out", "", "Leases that stand.", ""}, c.leases_out);
}

void Controller::note_book() {
  counters_.batches = static_cast<uint64_t>(book_.committed());
  counters_.leases_out = book_.standing();
  counters_.particles = counters_.batches * static_cast<uint64_t>(run_.scene().batch_particles);
}

// ---- rounds ----------------------------------------------------------------------------------

/// Rounds end where workers wait for one another: only an error target needs them.
void Controller::open_round() {
  const int64_t end =
      stop_.relative_error ? std::min(target_, run_.round_end(book_.committed())) : target_;
  book_.open_until(end);
  ++counters_.round;
  for (const NodeId worker : config_.workers)
    send(worker, network_.next_id(), RoundOpened{round(), static_cast<uint64_t>(end)});
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
    if (told_.count(worker) == 0) send(worker, network_.next_id(), RunEnded{round(), ""});
}

bool Controller::ended() const {
  if (!over_) return false;
  return told_.size() == config_.workers.size() ||
         scheduler_.clock().now() - over_since_ >= config_.farewell;
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
  note_book();
  const double passed = static_cast<double>(now - began_) * 1e-9;
  if (!closing_ && (interrupt_.load() || (stop_.seconds && passed >= *stop_.seconds))) {
    closing_ = true;
    book_.close();
    if (book_.round_done()) end_round();
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
        book_.lend(delivery.source, std::min(request.batches, config_.leases_most), deadline);
    counters_.leases += static_cast<uint64_t>(lent.count);
    note_book();
    last = {delivery.id,
            LeaseGranted{lent.first_lease, round(), static_cast<uint64_t>(lent.first_batch),
                         static_cast<uint32_t>(lent.count),
                         static_cast<uint32_t>(config_.lease_time / milliseconds(1))}};
  }
  send(delivery.source, delivery.id, last.answer);
}

void Controller::take_flush(const Delivery& delivery, const Flush& flush) {
  Answered& last = last_flush_[delivery.source];
  const bool again = last.question == delivery.id;
  if (!again) {
    std::string why;
    const bool taken = count_flush(delivery, flush, why);
    last.question = delivery.id;
    if (taken)
      last.answer = FlushTaken{};
    else
      last.answer = FlushRefused{{}, why};
    ++(taken ? counters_.flushes_taken : counters_.flushes_refused);
    counters_.flush_bytes += delivery.payload.size();
    if (!taken) spdlog::warn("flush refused node={}: {}", delivery.source.value, why);
  }
  send(delivery.source, delivery.id, last.answer);
  if (!again && !over_ && book_.round_done()) end_round();
}

bool Controller::count_flush(const Delivery& delivery, const Flush& flush, std::string& why) {
  Hasher hash;
  hash.add(delivery.payload.data(), delivery.payload.size());
  if (hash.value() != flush.payload_hash) {
    why = "the payload is not what its hash says";
    return false;
  }
  if (!book_.stand(delivery.source, flush.leases)) {
    why = "a lease was fenced";
    return false;
  }
  const auto gain =
      decode_flush(delivery.payload, run_.totals().groups(), run_.scene().layout.totals());
  if (!gain.ok()) {
    why = gain.problem().what;
    return false;
  }
  int64_t batches = 0;
  for (const auto& group : gain.value().groups) batches += group.batches;
  if (batches != static_cast<int64_t>(flush.leases.size()) || !gain.value().ledger.closes()) {
    why = "its batches or its ledger do not add up";
    return false;
  }
  run_.totals().add(gain.value());
  book_.commit(flush.leases);
  note_book();
  return true;
}

}  // namespace luxodus
