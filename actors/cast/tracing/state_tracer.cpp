#include "actors/cast/tracing/state_tracer.hpp"

#include <algorithm>

#include "proto/messages.hpp"
#include "runtime/core/check.hpp"

namespace luxodus {

namespace {

/// Duration of the leases at hand: short against what a person notices, long against the round trip
/// to the coordinator.
constexpr Nanoseconds leases_take = milliseconds(40);
constexpr size_t min_leases = 4, max_leases = 256;

}  // namespace

StateTracer::StateTracer(const CompiledScene& first, StateMaker& maker, int64_t portion,
                         Scheduler& scheduler, LeasePort& port, TracerMaker make_tracer)
    : maker_(maker),
      portion_(portion),
      scheduler_(scheduler),
      port_(port),
      make_tracer_(std::move(make_tracer)) {
  for (std::shared_ptr<Totals>& totals : totals_) totals = empty_totals(first);
}

void StateTracer::start() {
  LUX_CHECK(scheduler_.fibers().start("photon", [this] { trace_until_the_end(); }),
            "the plan counts a fiber for it");
}

void StateTracer::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  const BatchWorker::Counters all = done();
  metrics.add_counter({"particles", "", "Particles traced.", ""}, all.particles);
  metrics.add_counter({"eye_units", "", "Parts of signs, and probes, looked at.", ""},
                      all.eye_units);
  metrics.add_counter({"picture_paths", "", "Paths of pictures traced.", ""}, all.paths);
  metrics.add_counter({"batches", "", "Batches merged here.", ""}, c.batches);
  metrics.add_counter({"states", "", "States of the scene entered.", ""}, c.states);
}

BatchWorker::Counters StateTracer::done() const {
  BatchWorker::Counters all = done_before_;
  if (!worker_) return all;
  const BatchWorker::Counters& own = worker_->counters();
  all.particles += own.particles;
  all.eye_units += own.eye_units;
  all.paths += own.paths;
  return all;
}

// ---- states -------------------------------------------------------------------------------------

Result<void> StateTracer::learn(ObjectId state, std::span<const std::byte> bytes) try {
  const auto object = StateObject::parse(bytes);
  if (!object) return object.problem();
  auto made = maker_.make(object->text);
  if (!made) return made.problem();
  learnt_ = LearntState{state, object->seed, std::move(made).value()};
  return {};
} catch (const std::exception& e) {
  return problem(e.what());
}

void StateTracer::leave_state() {
  leases_.clear();
  open_.reset();
  done_before_ = done();
  worker_.reset();
  tracing_.reset();
}

void StateTracer::enter(ObjectId) {
  ++counters_.states;
  done_before_ = done();
  worker_.reset();
  tracing_ = learnt_;
  const TracedState& state = *tracing_->state;
  worker_ = state.worker(tracing_->seed, portion_, make_tracer_);
  for (std::shared_ptr<Totals>& totals : totals_) totals = state.totals();
  counted_ = tracing_->state;
  batch_takes_ = 0;
}

/// New memory is empty already.
bool StateTracer::forget_merged() {
  if (!tracing_ || merges_) return false;
  totals_[merging_] = tracing_->state->totals();
  return true;
}

// ---- leases -------------------------------------------------------------------------------------

/// Asks for other leases: only this node knows that it has nothing to do. A batch that is being
/// merged leaves in a flush, which is refused.
void StateTracer::drop(std::span<const uint64_t> leases) {
  const auto named = [&](const PendingBatch& batch) {
    return std::find(leases.begin(), leases.end(), batch.lease) != leases.end();
  };
  std::erase_if(leases_, named);
  if (open_ && !merges_ && named(*open_)) open_.reset();
  look_again();
}

void StateTracer::drop_all() {
  leases_.clear();
  if (!merges_) open_.reset();
}

void StateTracer::give_back_all() {
  std::vector<uint64_t> leases;
  for (const PendingBatch& batch : leases_)
    if (leases.size() < limits::leases) leases.push_back(batch.lease);
  if (!leases.empty()) port_.give_back(leases);
  drop_all();
}

/// Asks for nothing while batches wait for their state.
void StateTracer::look_again() {
  if (at_hand() == 0 || tracing_) ask_for_more();
  scheduler_.fibers().wake_all(work_);
}

void StateTracer::ask_for_more() {
  size_t wish = min_leases;
  if (batch_takes_ > 0)
    wish = std::clamp(static_cast<size_t>(leases_take / batch_takes_), min_leases, max_leases);
  if (at_hand() <= wish / 2) port_.want_leases(wish - at_hand());
}

Totals& StateTracer::give_totals() {
  merging_ = 1 - merging_;
  return *totals_[1 - merging_];
}

void StateTracer::end(const std::string&) {
  ending_ = true;
  scheduler_.fibers().wake_all(work_);
}

// ---- tracing ------------------------------------------------------------------------------------

/// An exception is a failure of the tracer.
void StateTracer::trace_until_the_end() try {
  Fibers& fibers = scheduler_.fibers();
  ask_for_more();  // also announces this node
  while (!ending_) {
    const Wake how = trace_portion() ? fibers.yield() : fibers.wait(work_, "work");
    if (how == Wake::cancelled) return;
  }
} catch (...) {
  port_.thread_failed(std::current_exception());
}

/// False: there is nothing to trace.
bool StateTracer::trace_portion() {
  if (!open_ && !open_next()) return false;
  if (!worker_->go_on()) close();
  return true;
}

bool StateTracer::open_next() {
  if (!tracing_ || leases_.empty()) return false;
  open_ = leases_.front();
  leases_.pop_front();
  worker_->begin(batch_of(open_->batch));
  opened_ = scheduler_.clock().now();
  ask_for_more();
  return true;
}

void StateTracer::close() {
  if (!merge()) return;
  const uint64_t lease = open_->lease;
  open_.reset();
  ++counters_.batches;
  batch_takes_ = std::max<Nanoseconds>(scheduler_.clock().now() - opened_, 1);
  port_.leases_done({&lease, 1});
}

/// Millions of bins take longer than a turn may: other fibers run between steps. Returns false if
/// the state was left meanwhile, and its batch is no longer wanted.
bool StateTracer::merge() {
  const auto state = counted_;  // must outlive the two below
  const auto worker = worker_;
  const auto totals = totals_[merging_];
  const auto rest = [this] { (void)scheduler_.fibers().yield(); };
  merges_ = true;
  if (scheduler_.rarely(Buggify::Site::short_turn)) rest();
  worker->merge_into(*totals, rest);
  merges_ = false;
  return worker == worker_;
}

}  // namespace luxodus
