// Supervision rules: what happens to a node and its run when one of its actors fails. The table in
// actors/README.md repeats them. Plain values; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "runtime/core/clock.hpp"
#include "runtime/messaging/actor_system.hpp"

namespace luxodus {

/// What happens after a failure that is not followed by a restart.
enum class Remedy : uint8_t {
  leave,    // its node leaves, and is lost for the others
  end_run,  // the run ends with an error
};

struct SupervisionRule {
  ActorName actor;
  size_t restarts = 0;     // at most this many restarts
  Nanoseconds within = 0;  // within this time
  Remedy then = Remedy::leave;
};

inline constexpr std::array supervision_rules{
    SupervisionRule{ActorName::coordinator, 0, 0, Remedy::end_run},
    SupervisionRule{ActorName::journal, 0, 0, Remedy::end_run},
    SupervisionRule{ActorName::tracer, 0, 0, Remedy::leave},
    SupervisionRule{ActorName::tally_shard, 0, 0, Remedy::leave},
    SupervisionRule{ActorName::part_server, 0, 0, Remedy::leave},
    SupervisionRule{ActorName::display, 5, seconds(60), Remedy::end_run},
};

/// Null if there is none: such an actor is not supervised.
const SupervisionRule* supervision_rule(ActorName actor);

/// The actor's name for people: "tally shard".
std::string spoken_name(ActorName actor);

/// For people, as in the table: "never", "5 times in 60 s"; "its node leaves", "the run ends".
std::string restarts_text(const SupervisionRule& rule);
const char* name_of(Remedy remedy);

}  // namespace luxodus
