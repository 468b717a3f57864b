// What happens to a node when one of its actors fails: a rule for each actor, given by whoever adds
// it. Plain values; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "proto/messages.hpp"
#include "runtime/core/clock.hpp"

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

/// For people: "never", "5 times in 60 s"; "its node leaves", "the run ends".
std::string restarts_text(const SupervisionRule& rule);
const char* name_of(Remedy remedy);

}  // namespace luxodus
