// Whether two nodes may work on one run. Pure; any thread.
#pragma once

#include <optional>

#include "proto/messages.hpp"

namespace luxodus {

/// The first reason why `mine` refuses `theirs`, in a sentence that names both values; nothing if
/// there is none. `expected` is the node that the link should lead to. Values that affect only bits
/// (instruction set, build, fingerprint) are compared only at level `bit`.
std::optional<Refuse> refusal(const Identity& mine, const Identity& theirs, NodeId expected);

}  // namespace luxodus
