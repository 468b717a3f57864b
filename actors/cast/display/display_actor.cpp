#include "actors/cast/display/display_actor.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "actors/cast/names/role.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

DisplayActor::DisplayActor(const DisplayConfig& config, RunOutput& work, BlockingCalls& calls,
                           Scheduler& scheduler, Network& network, Sender& sender)
    : NodeActor(scheduler, sender, {config.self, role::display}, "display"),
      config_(config),
      work_(work),
      calls_(calls),
      clock_(scheduler.clock()),
      network_(network),
      timer_(config.answer_patience, config.lost) {}

void DisplayActor::add_metrics(Metrics& metrics) const {
  const Counters& c = counters_;
  metrics.add_counter({"display_copies", "", "Copies of the totals that the display has had.", ""},
                      c.copies);
  metrics.add_counter({"display_copied", "bytes", "Bytes of copies as they came.", ""},
                      c.copied_bytes);
  metrics.add_counter({"display_asked_again", "", "Questions of the display asked again.", ""},
                      c.asked_again);
}

void DisplayActor::begin() {
  set_timer();
}

/// A flux that is on a disk stays there, and the other results are made from the same totals.
void DisplayActor::reset() {
  State fresh;
  if (state_.saved) {
    fresh.saved = fresh.over = true;
    fresh.last = state_.last;
  }
  state_ = std::move(fresh);
  set_timer();
}

void DisplayActor::set_timer() {
  scheduler().timers().set(clock_.now() + config_.look_every, own_task([this] {
                             look();
                             set_timer();
                           }));
}

// ---- totals -------------------------------------------------------------------------------------

void DisplayActor::look() {
  if (state_.done) return;
  watch_coordinator();
  if (state_.question) {
    if (!timer_.is_due(clock_.now())) return;
    ++counters_.asked_again;
    return put();
  }
  if (calling_ || state_.done) return;
  if (state_.saved) return write_results();
  if (state_.over || work_.wants_show()) ask();
}

void DisplayActor::watch_coordinator() {
  const NodeId node = config_.coordinator.node;
  if (node == config_.self || network_.reaches(node)) {
    state_.unreachable_since.reset();
    return;
  }
  if (!state_.unreachable_since) state_.unreachable_since = clock_.now();
  if (state_.saved || clock_.now() - *state_.unreachable_since < config_.lost) return;
  end(problem(
      fmt::format("no way has led to the controller for {:g} s (lost_s)", seconds_in(config_.lost)),
      ProblemKind::lost_peer));
}

/// Requests the current totals, from the first piece on.
void DisplayActor::ask() {
  ++show_;
  state_.copy.emplace(work_.fresh_run());
  timer_.forget();
  state_.question = Question{sender().next_id()};
  put();
}

void DisplayActor::put() {
  Question& question = *state_.question;
  const SendOutcome outcome = sender().send(address(), config_.coordinator, question.id,
                                            ShowTotals{show_, state_.copy->next()});
  const Nanoseconds now = clock_.now();
  question.left = outcome == SendOutcome::taken;
  if (question.left) timer_.asked(now);
  if (question.left || state_.retries_soon) return;
  state_.retries_soon = true;
  scheduler().timers().set(now + retry_after, own_task([this] { retry(); }));
}

void DisplayActor::retry() {
  state_.retries_soon = false;
  if (state_.question && !state_.question->left) put();
}

void DisplayActor::on(const Letter<TotalsShown>& shown) {
  if (shown.from != config_.coordinator) return;
  if (!state_.question || state_.question->id != shown.id) return;  // a duplicate answer
  timer_.answered(clock_.now());
  if (shown.body.pieces == 0) return ask();  // the coordinator has restarted
  counters_.copied_bytes += shown.payload.bytes().size();
  if (auto taken = state_.copy->take(shown.body, shown.payload.bytes()); !taken)
    throw std::runtime_error(taken.problem().what);
  if (state_.copy->whole()) return copied();
  state_.question = Question{sender().next_id()};
  put();
}

void DisplayActor::copied() {
  ++counters_.copies;
  state_.question.reset();
  const bool over = state_.copy->run_is_over();
  reason_ = state_.copy->reason();
  const std::shared_ptr<const LocalRun> run = state_.copy->run();
  state_.copy.reset();
  called_with_ = run;
  if (!over) return call(Call::show);
  state_.over = true;
  state_.last = run;
  call(Call::keep_flux);
}

// ---- the end ------------------------------------------------------------------------------------

/// Repeated until the coordinator knows that the flux is on a disk.
void DisplayActor::on(const Letter<RunEnded>& ended) {
  if (ended.from != config_.coordinator) return;
  if (state_.saved || state_.fault) return tell_saved();
  if (state_.done) return;
  if (!ended.body.text.empty())
    return end(std::nullopt);  // the node's tracer or controller reports the reason
  state_.over = true;
  look();
}

void DisplayActor::tell_saved() {
  const std::string why = state_.saved ? "" : state_.fault->text();
  tell(config_.coordinator, FluxSaved{show_, why.substr(0, limits::text_bytes)});
}

void DisplayActor::tell_failure(const std::string& what) {
  tell(config_.coordinator, FluxSaved{show_, what.substr(0, limits::text_bytes)});
}

void DisplayActor::end(std::optional<Problem> fault) {
  state_.fault = std::move(fault);
  state_.question.reset();
  state_.done = true;
}

// ---- calls --------------------------------------------------------------------------------------

void DisplayActor::call(Call what) {
  calling_ = true;
  called_ = what;
  const auto work = [this, what, run = called_with_] {
    outcome_ = {};
    try {
      if (what == Call::show) work_.show(*run);
      if (what == Call::keep_flux) outcome_ = work_.keep_flux(*run, reason_);
      if (what == Call::write_results) outcome_ = work_.write_results(*run, reason_);
    } catch (...) {
      thrown_ = std::current_exception();
    }
  };
  calls_.begin(work, [this, began = life()] { returned(began); });
}

/// The call may have been begun by an earlier life: then its outcome is ignored.
void DisplayActor::returned(uint32_t began) {
  calling_ = false;
  called_with_.reset();
  const std::exception_ptr thrown = std::exchange(thrown_, nullptr);
  if (began != life()) return;
  guarded([&] {
    if (thrown) std::rethrow_exception(thrown);
    go_on(std::move(outcome_));
  });
}

void DisplayActor::go_on(Result<void> outcome) {
  if (called_ == Call::show) return look();
  if (called_ == Call::write_results)
    return end(outcome ? std::nullopt : std::optional(outcome.problem()));
  if (!outcome) {
    end(outcome.problem());
    return tell_saved();
  }
  state_.saved = true;
  tell_saved();
  write_results();
}

void DisplayActor::write_results() {
  called_with_ = state_.last;
  call(Call::write_results);
}

}  // namespace luxodus
