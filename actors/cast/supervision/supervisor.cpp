#include "actors/cast/supervision/supervisor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/core/check.hpp"
#include "runtime/core/log.hpp"

namespace luxodus {

namespace {

std::string what_of(const std::exception_ptr& why) {
  try {
    std::rethrow_exception(why);
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "something that is no exception was thrown";
  }
}

}  // namespace

// ---- the rules ----------------------------------------------------------------------------------

std::string spoken_name(ActorName actor) {
  std::string name = actor_names[static_cast<size_t>(actor)];
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

const SupervisionRule* supervision_rule(ActorName actor) {
  const auto at = std::find_if(supervision_rules.begin(), supervision_rules.end(),
                               [&](const SupervisionRule& rule) { return rule.actor == actor; });
  return at == supervision_rules.end() ? nullptr : &*at;
}

std::string restarts_text(const SupervisionRule& rule) {
  if (rule.restarts == 0) return "never";
  return fmt::format("{} times in {} s", rule.restarts, rule.within / seconds(1));
}

const char* name_of(Remedy remedy) {
  return remedy == Remedy::leave ? "its node leaves" : "the run ends";
}

// ---- the actor ----------------------------------------------------------------------------------

void Supervisor::watch(ActorName name, Supervised& actor) {
  LUX_CHECK(supervision_rule(name) != nullptr, "an actor without a rule for its failure");
  Watched& watched = watched_[static_cast<size_t>(name)];
  LUX_CHECK(watched.actor == nullptr, "two actors of one name");
  watched.actor = &actor;
  actor.supervise_by(*this);
}

void Supervisor::on_failure(Supervised& actor, const std::exception_ptr& why) noexcept {
  const auto at = std::find_if(watched_.begin(), watched_.end(),
                               [&](const Watched& watched) { return watched.actor == &actor; });
  const auto name = static_cast<ActorName>(at - watched_.begin());
  // An actor fails only once until that is handled, so there is room for all.
  LUX_CHECK(offer(ActorFailed{name, what_of(why)}) == Offered::taken, "a failure for each actor");
}

/// Whether it has been restarted few enough times recently; then counts another restart.
bool Supervisor::may_restart(Watched& watched, const SupervisionRule& rule) {
  const Nanoseconds now = scheduler().clock().now();
  while (!watched.restarted.empty() && now - watched.restarted.front() >= rule.within)
    watched.restarted.pop_front();
  if (watched.restarted.size() >= rule.restarts) return false;
  watched.restarted.push_back(now);
  return true;
}

void Supervisor::on(const ActorFailed& failed) {
  const auto name = static_cast<size_t>(failed.actor);
  Watched& watched = watched_[name];
  const SupervisionRule& rule = *supervision_rule(failed.actor);
  ++counters_.failures[name];
  if (may_restart(watched, rule)) {
    ++counters_.restarts[name];
    log_error("actor=failed node={} actor={} text=\"{}: it begins anew\"", self_.value,
              actor_names[name], failed.what);
    return watched.actor->begin_anew();
  }
  const std::string often =
      rule.restarts == 0 ? "" : fmt::format(" more than {}", restarts_text(rule));
  const Verdict verdict{
      failed.actor, rule.then,
      fmt::format("the {} has failed{}: {}", spoken_name(failed.actor), often, failed.what)};
  log_error("actor=failed node={} actor={} text=\"{}: {}\"", self_.value, actor_names[name],
            verdict.text, name_of(rule.then));
  if (verdict_) return;
  if (rule.then == Remedy::end_run && end_run_ && end_run_(verdict)) return;
  verdict_ = verdict;
}

void Supervisor::add_metrics(Metrics& metrics) const {
  for (size_t name = 0; name < watched_.size(); ++name) {
    if (watched_[name].actor == nullptr) continue;
    const std::string actor = fmt::format("actor=\"{}\"", actor_names[name]);
    metrics.add_counter({"actor_failures", "", "Exceptions that left an actor.", actor},
                        counters_.failures[name]);
    metrics.add_counter({"actor_restarts", "", "Times that an actor began anew.", actor},
                        counters_.restarts[name]);
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
  for (size_t name = 0; name < watched_.size(); ++name)
    if (watched_[name].actor != nullptr && fault.actor == actor_names[name])
      watched_[name].actor->fail_next();
  if (!rehearsed_.empty())
    scheduler().timers().set(began_ + rehearsed_.back().at, [this] { fail_on_purpose(); });
}

}  // namespace luxodus
