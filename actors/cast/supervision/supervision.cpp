#include "actors/cast/supervision/supervision.hpp"

#include <algorithm>

#include "runtime/core/check.hpp"

namespace luxodus {

const SupervisionRule* supervision_rule(ActorName actor) {
  const auto at = std::find_if(supervision_rules.begin(), supervision_rules.end(),
                               [&](const SupervisionRule& rule) { return rule.actor == actor; });
  return at == supervision_rules.end() ? nullptr : &*at;
}

void watch(Supervisor& supervisor, ActorName name, Supervised& actor) {
  const SupervisionRule* rule = supervision_rule(name);
  LUX_CHECK(rule != nullptr, "an actor without a rule for its failure");
  supervisor.watch(*rule, {role_name(name), spoken_name(name)}, actor);
}

}  // namespace luxodus
