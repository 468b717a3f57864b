// The supervisor of a node: it watches the node's actors, and applies an actor's rule when that
// actor fails. A failure arrives in its mailbox as a message; until it is handled the actor does
// nothing. Thread rule: the node's thread.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/actor/actor.hpp"
#include "runtime/core/faults.hpp"
#include "runtime/node/supervision.hpp"
#include "runtime/observe/metrics.hpp"

namespace luxodus {

namespace limits {
/// Actors that one supervisor watches: ten times the most that a node has had so far. Each has a
/// slot of 48 bytes in the supervisor's mailbox.
inline constexpr size_t watched_actors = 128;
}  // namespace limits

/// What an actor is called: in logs, metrics and fault plans ("part_server"), and in sentences.
struct ActorLabel {
  std::string name;
  std::string spoken;
};

/// Sent to the supervisor: this exception has left one of the actor's handlers.
struct ActorFailed {
  size_t watched = 0;  // number of the actor, in the order of watch()
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
                   ControlLane<Accepts<ActorFailed, limits::watched_actors, WhenFull::reject>>,
                   DataLane<>>,
      public FailureListener {
 public:
  Supervisor(Scheduler& scheduler, NodeId self) : Actor(scheduler, "supervisor"), self_(self) {}

  /// Requires: a name of its own; at most limits::watched_actors actors; the actor outlives this.
  void watch(const SupervisionRule& rule, ActorLabel label, Supervised& actor);
  /// Makes actors of this node fail by the plan.
  void rehearse(const FaultPlan& plan);
  /// `end` is called when the run shall end, before there is a verdict. True: the run ends by
  /// itself, and the node stays for that.
  void end_runs_by(std::function<bool(const Verdict&)> end) { end_run_ = std::move(end); }
  /// The node cannot go on for a reason that is no failure of an actor.
  void condemn(Verdict verdict);

  void on_failure(Supervised& actor, const std::exception_ptr& why) noexcept override;
  void on(const ActorFailed& failed);

  /// Set when the node must leave.
  const std::optional<Verdict>& verdict() const { return verdict_; }

  struct Counters {
    uint64_t failures = 0;
    uint64_t restarts = 0;
  };
  /// Of the actor of this name. Requires: it is watched.
  const Counters& counters(const std::string& name) const;
  /// Requires: all actors are watched.
  void add_metrics(Metrics& metrics) const;

 private:
  struct Watched {
    SupervisionRule rule;
    ActorLabel label;
    Supervised* actor = nullptr;
    std::deque<Nanoseconds> restarted = {};  // times of restarts within the rule's period
    Counters counters = {};
  };
  bool may_restart(Watched& watched);
  void fail_on_purpose();

  const NodeId self_;
  std::deque<Watched> watched_;  // a deque, since metrics refer to its elements
  std::function<bool(const Verdict&)> end_run_;
  std::optional<Verdict> verdict_;
  std::vector<Fault> rehearsed_;  // the next one last
  Nanoseconds began_ = 0;
};

/// The exception's text for people.
std::string text_of(const std::exception_ptr& why);

}  // namespace luxodus
