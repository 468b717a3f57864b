// Whether two nodes may work on one run. Pure; any thread.
#pragma once

#include <optional>

#include "proto/messages.hpp"

namespace luxodus {

/// The first reason why `mine` will not work with `theirs`, in a sentence that names both values;
/// nothing if there is none. `expected` is the node that the link should lead to. What decides
/// bits (instruction set, build, fingerprint) counts at level `bit` alone.
std::optional<Refuse> refusal(const Identity& mine, const Identity& theirs, NodeId expected);

}  // namespace luxodus
