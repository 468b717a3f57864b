// Supervision rules: what happens to a node and its run when one of its actors fails. The table in
// actors/README.md repeats them. Plain values; any thread.
#pragma once

#include <array>

#include "actors/cast/names/role.hpp"
#include "runtime/node/node_shell.hpp"

namespace luxodus {

inline constexpr std::array supervision_rules{
    SupervisionRule{role::coordinator, 0, 0, Remedy::end_run},
    SupervisionRule{role::journal, 0, 0, Remedy::end_run},
    SupervisionRule{role::tracer, 0, 0, Remedy::leave},
    SupervisionRule{role::tally_shard, 0, 0, Remedy::leave},
    SupervisionRule{role::part_server, 0, 0, Remedy::leave},
    SupervisionRule{role::display, 5, seconds(60), Remedy::end_run},
};

/// Null if there is none.
const SupervisionRule* supervision_rule(ActorName actor);

/// Has a node's supervisor watch an actor that has no address. Requires: there is a rule for it.
void watch(Supervisor& supervisor, ActorName name, Supervised& actor);

/// Adds an actor of a run to its node, under its rule. Requires: there is one; the actor outlives
/// the run.
template <class NodeActorType>
void add_to(NodeShell& shell, ActorName name, NodeActorType& actor) {
  shell.actors().add(name, actor, role_name(name));
  watch(shell.supervisor(), name, actor);
}

}  // namespace luxodus
