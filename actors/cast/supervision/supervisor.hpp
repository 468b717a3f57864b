// The supervisor of a node: it watches the node's actors, and applies supervision.hpp when one of
// them fails. A failure arrives in its mailbox as a message; until it is handled the actor does
// nothing. Thread rule: the node's thread.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "actors/cast/supervision/supervision.hpp"
#include "runtime/actor/actor.hpp"
#include "runtime/core/faults.hpp"
#include "runtime/observe/metrics.hpp"

namespace luxodus {

/// Sent to the supervisor: this exception has left one of the actor's handlers.
struct ActorFailed {
  ActorName actor = ActorName::none;
  std::string what;
};

/// Why a node cannot go on.
struct Verdict {
  ActorName actor = ActorName::none;
  Remedy remedy = Remedy::leave;
  std::string text;
};

class Supervisor final
    : public Actor<Supervisor,
                   ControlLane<Accepts<ActorFailed, actor_names.size(), WhenFull::reject>>,
                   DataLane<>>,
      public FailureListener {
 public:
  Supervisor(Scheduler& scheduler, NodeId self) : Actor(scheduler, "supervisor"), self_(self) {}

  /// Requires: there is a rule for it; one actor of a name; the actor outlives this.
  void watch(ActorName name, Supervised& actor);
  /// Makes actors of this node fail by the plan.
  void rehearse(const FaultPlan& plan);
  /// `end` is called when the run shall end, before there is a verdict. True: the run ends by
  /// itself, and the node stays for that.
  void end_runs_by(std::function<bool(const Verdict&)> end) { end_run_ = std::move(end); }

  void on_failure(Supervised& actor, const std::exception_ptr& why) noexcept override;
  void on(const ActorFailed& failed);

  /// Set when the node must leave.
  const std::optional<Verdict>& verdict() const { return verdict_; }

  struct Counters {
    std::array<uint64_t, actor_names.size()> failures{};  // by name
    std::array<uint64_t, actor_names.size()> restarts{};
  };
  const Counters& counters() const { return counters_; }
  /// Requires: all actors are watched.
  void add_metrics(Metrics& metrics) const;

 private:
  struct Watched {
    Supervised* actor = nullptr;
    std::deque<Nanoseconds> restarted;  // times of restarts within the rule's period
  };
  bool may_restart(Watched& watched, const SupervisionRule& rule);
  void fail_on_purpose();

  const NodeId self_;
  std::array<Watched, actor_names.size()> watched_;  // by name
  std::function<bool(const Verdict&)> end_run_;
  std::optional<Verdict> verdict_;
  std::vector<Fault> rehearsed_;  // the next one last
  Nanoseconds began_ = 0;
  Counters counters_;
};

}  // namespace luxodus
