#include "actors/photon/state_tracing.hpp"

#include <algorithm>
#include <stdexcept>

#include "actors/run/batch_range.hpp"
#include "runtime/core/check.hpp"
#include "scenes/transport/readout.hpp"

namespace luxodus {

namespace {

/// Leases at hand take about so long: short against what a person notices, long against the way to
/// the coordinator and back.
constexpr Nanoseconds leases_take = milliseconds(40);
constexpr size_t min_leases = 4, max_leases = 256;

}  // namespace

StateTracing::StateTracing(const CompiledScene& first, StateMaker& maker, int64_t portion,
                           Scheduler& scheduler, LeasePort& port, TracerMaker make_tracer)
    : maker_(maker),
      portion_(portion),
      scheduler_(scheduler),
      port_(port),
      make_tracer_(std::move(make_tracer)) {
  for (std::unique_ptr<Totals>& totals : totals_) totals = totals_of(first);
}

void StateTracing::start() {
  LUX_CHECK(scheduler_.fibers().start("photon", [this] { trace_until_the_end(); }),
            "the plan counts a fiber for it");
}

void StateTracing::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"particles", "", "Particles traced.", ""}, c.particles);
  metrics.add_counter({"eye_units", "", "Parts of signs, and probes, looked at.", ""}, c.eye_units);
  metrics.add_counter({"batches", "", "Batches merged here.", ""}, c.batches);
  metrics.add_counter({"states", "", "States of the scene entered.", ""}, c.states);
}

// ---- states -------------------------------------------------------------------------------------

Result<void> StateTracing::learn(ObjectId state, std::span<const std::byte> bytes) try {
  const auto object = StateObject::parse(bytes);
  if (!object) return object.problem();
  auto made = maker_.make(object->text);
  if (!made) return made.problem();
  learnt_ = Known{state, object->seed, std::move(made).value()};
  return {};
} catch (const std::exception& e) {
  return problem(e.what());
}

void StateTracing::leave_state() {
  drop_all();
  tracing_.reset();
}

void StateTracing::enter(ObjectId) {
  ++counters_.states;
  tracing_ = learnt_;
  const CompiledScene& scene = *tracing_->state->scene;
  tracer_ = make_tracer_(scene, GeometryAccess::resident(tracing_->state->index), tracing_->seed);
  planned_.reset();
  if (tracing_->state->is_run) planned_.emplace(scene);
  look_units_ = planned_ ? tracer_->look_units() : 0;
  for (std::unique_ptr<Totals>& totals : totals_) totals = totals_of(scene);
  batch_takes_ = 0;
}

std::unique_ptr<Totals> StateTracing::totals_of(const CompiledScene& scene) {
  return std::make_unique<Totals>(scene.layout, static_cast<int>(scene.groups.size()),
                                  photopic_weights(scene));
}

/// New memory is empty already.
bool StateTracing::forget_merged() {
  if (!tracing_) return false;
  totals_[merging_] = totals_of(*tracing_->state->scene);
  return true;
}

// ---- leases -------------------------------------------------------------------------------------

/// Others are asked for: nobody else knows that this node has nothing to do.
void StateTracing::drop(std::span<const uint64_t> leases) {
  const auto named = [&](const Waiting& waiting) {
    return std::find(leases.begin(), leases.end(), waiting.lease) != leases.end();
  };
  std::erase_if(leases_, named);
  if (open_ && named(*open_)) open_.reset();
  look_again();
}

void StateTracing::drop_all() {
  leases_.clear();
  open_.reset();
}

void StateTracing::give_back_all() {
  std::vector<uint64_t> leases;
  for (const Waiting& waiting : leases_)
    if (leases.size() < limits::leases) leases.push_back(waiting.lease);
  if (!leases.empty()) port_.give_back(leases);
  drop_all();
}

/// Nothing is asked for while batches wait for their state.
void StateTracing::look_again() {
  if (at_hand() == 0 || tracing_) ask_for_more();
  scheduler_.fibers().wake_all(work_);
}

void StateTracing::ask_for_more() {
  size_t wish = min_leases;
  if (batch_takes_ > 0)
    wish = std::clamp(static_cast<size_t>(leases_take / batch_takes_), min_leases, max_leases);
  if (at_hand() <= wish / 2) port_.want_leases(wish - at_hand());
}

Totals& StateTracing::give_totals() {
  merging_ = 1 - merging_;
  return *totals_[1 - merging_];
}

void StateTracing::end(const std::string&) {
  ending_ = true;
  scheduler_.fibers().wake_all(work_);
}

// ---- tracing ------------------------------------------------------------------------------------

/// What leaves it is a failure of the tracer.
void StateTracing::trace_until_the_end() try {
  Fibers& fibers = scheduler_.fibers();
  ask_for_more();  // which says that this node is here
  while (!ending_) {
    const Wake how = trace_portion() ? fibers.yield() : fibers.wait(work_, "work");
    if (how == Wake::cancelled) return;
  }
} catch (...) {
  port_.thread_failed(std::current_exception());
}

/// False: there is nothing to trace.
bool StateTracing::trace_portion() {
  if (!open_ && !open_next()) return false;
  const int64_t batch_particles = tracing_->state->scene->batch_particles;
  if (traced_ < batch_particles) {
    const int64_t count = std::min(portion_, batch_particles - traced_);
    const uint64_t first = batch_.first_particle + static_cast<uint64_t>(traced_);
    tracer_->trace(batch_.group, first, count, scores_);
    counters_.particles += static_cast<uint64_t>(count);
    traced_ += count;
  } else {
    tracer_->look(batch_.number, looked_++, scores_);
    ++counters_.eye_units;
  }
  if (traced_ == batch_particles && looked_ == look_units_) close();
  return true;
}

Batch StateTracing::batch_of_lease(int64_t number) {
  const BatchRange batch = batch_of(number);
  if (planned_) return planned_->at(batch.first);
  const CompiledScene& scene = *tracing_->state->scene;
  if (static_cast<size_t>(batch.group) >= scene.groups.size())
    throw std::runtime_error("a batch was lent of a source group that is not there");
  return {batch.first, batch.group, first_particle_of(scene, batch.stream, batch.first)};
}

bool StateTracing::open_next() {
  if (!tracing_ || leases_.empty()) return false;
  open_ = leases_.front();
  leases_.pop_front();
  batch_ = batch_of_lease(open_->batch);
  traced_ = 0;
  looked_ = 0;
  opened_ = scheduler_.clock().now();
  scores_.reset(tracing_->state->scene->layout);
  ask_for_more();
  return true;
}

void StateTracing::close() {
  const uint64_t lease = open_->lease;
  totals_[merging_]->merge(scores_, batch_.group);
  open_.reset();
  ++counters_.batches;
  batch_takes_ = std::max<Nanoseconds>(scheduler_.clock().now() - opened_, 1);
  port_.leases_done({&lease, 1});
}

}  // namespace luxodus
