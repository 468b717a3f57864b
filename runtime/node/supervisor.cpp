#include "runtime/node/supervisor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

std::string text_of(const std::exception_ptr& why) {
  try {
    std::rethrow_exception(why);
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "something that is no exception was thrown";
  }
}

// ---- the rules ----------------------------------------------------------------------------------

std::string restarts_text(const SupervisionRule& rule) {
  if (rule.restarts == 0) return "never";
  return fmt::format("{} times in {} s", rule.restarts, rule.within / seconds(1));
}

const char* name_of(Remedy remedy) {
  return remedy == Remedy::leave ? "its node leaves" : "the run ends";
}

// ---- the actor ----------------------------------------------------------------------------------

void Supervisor::watch(const SupervisionRule& rule, ActorLabel label, Supervised& actor) {
  LUX_CHECK(std::none_of(watched_.begin(), watched_.end(),
                         [&](const Watched& watched) { return watched.label.name == label.name; }),
            "two actors of one name");
  LUX_CHECK(watched_.size() < limits::watched_actors, "more actors than a supervisor watches");
  watched_.push_back({rule, std::move(label), &actor});
  actor.supervise_by(*this);
}

void Supervisor::condemn(Verdict verdict) {
  log_error("actor=failed node={} text=\"{}\"", self_.value, verdict.text);
  if (!verdict_) verdict_ = std::move(verdict);
}

void Supervisor::on_failure(Supervised& actor, const std::exception_ptr& why) noexcept {
  const auto at = std::find_if(watched_.begin(), watched_.end(),
                               [&](const Watched& watched) { return watched.actor == &actor; });
  const auto number = static_cast<size_t>(at - watched_.begin());
  // An actor fails only once until that is handled, so there is room for all.
  LUX_CHECK(offer(ActorFailed{number, text_of(why)}) == Offered::taken, "a failure for each actor");
}

/// Whether it has been restarted few enough times recently; then counts another restart.
bool Supervisor::may_restart(Watched& watched) {
  const Nanoseconds now = scheduler().clock().now();
  while (!watched.restarted.empty() && now - watched.restarted.front() >= watched.rule.within)
    watched.restarted.pop_front();
  if (watched.restarted.size() >= watched.rule.restarts) return false;
  watched.restarted.push_back(now);
  return true;
}

void Supervisor::on(const ActorFailed& failed) {
  Watched& watched = watched_.at(failed.watched);
  const SupervisionRule& rule = watched.rule;
  ++watched.counters.failures;
  if (may_restart(watched)) {
    ++watched.counters.restarts;
    log_error("actor=failed node={} actor={} text=\"{}: it begins anew\"", self_.value,
              watched.label.name, failed.what);
    return watched.actor->begin_anew();
  }
  const std::string often =
      rule.restarts == 0 ? "" : fmt::format(" more than {}", restarts_text(rule));
  const Verdict verdict{
      rule.actor, rule.then,
      fmt::format("the {} has failed{}: {}", watched.label.spoken, often, failed.what)};
  log_error("actor=failed node={} actor={} text=\"{}: {}\"", self_.value, watched.label.name,
            verdict.text, name_of(rule.then));
  if (verdict_) return;
  if (rule.then == Remedy::end_run && end_run_ && end_run_(verdict)) return;
  verdict_ = verdict;
}

const Supervisor::Counters& Supervisor::counters(const std::string& name) const {
  const auto at = std::find_if(watched_.begin(), watched_.end(),
                               [&](const Watched& watched) { return watched.label.name == name; });
  LUX_CHECK(at != watched_.end(), "counters of an actor that is not watched");
  return at->counters;
}

void Supervisor::add_metrics(Metrics& metrics) const {
  for (const Watched& watched : watched_) {
    const std::string actor = fmt::format("actor=\"{}\"", watched.label.name);
    metrics.add_counter({"actor_failures", "", "Exceptions that left an actor.", actor},
                        watched.counters.failures);
    metrics.add_counter({"actor_restarts", "", "Times that an actor began anew.", actor},
                        watched.counters.restarts);
  }
}

// ---- fault injection ----------------------------------------------------------------------------

void Supervisor::rehearse(const FaultPlan& plan) {
  began_ = scheduler().clock().now();
  for (const Fault& fault : plan.faults)
    if (fault.kind == Fault::Kind::failure && fault.node == self_) rehearsed_.push_back(fault);
  std::sort(rehearsed_.begin(), rehearsed_.end(),
            [](const Fault& a, const Fault& b) { return a.at > b.at; });
  if (!rehearsed_.empty())
    scheduler().timers().set(began_ + rehearsed_.back().at, [this] { fail_on_purpose(); });
}

void Supervisor::fail_on_purpose() {
  const Fault fault = std::move(rehearsed_.back());
  rehearsed_.pop_back();
  for (const Watched& watched : watched_)
    if (fault.actor == watched.label.name) watched.actor->fail_next();
  if (!rehearsed_.empty())
    scheduler().timers().set(began_ + rehearsed_.back().at, [this] { fail_on_purpose(); });
}

}  // namespace luxodus
