// The rules by their numbers, for the sources of this folder. Constant data; any thread.
#pragma once

#include <string_view>

#include "scenes/emergency/check.hpp"
#include "scenes/emergency/rule_sets.hpp"

namespace luxodus {

/// "E1", ..., as a part of a set: a rule of EN 1838:2013 that the set of 2024 takes over says so.
/// Requires: there is one (a programmer's mistake throws).
Rule rule_of(std::string_view id, const CodeChoice& codes);
/// One that is of no code. Requires: as above.
Rule own_rule(std::string_view id);

}  // namespace luxodus
