// Rules by id, with edition, clause and source; internal to this folder. Constant data; any thread.
#pragma once

#include <string_view>

#include "scenes/emergency/check.hpp"
#include "scenes/emergency/rule_sets.hpp"

namespace luxodus {

/// Rule "E1", ..., as part of a set. If the set of 2024 takes a rule over from EN 1838:2013, its
/// status says so. Requires: a known id (else it throws: a programmer's mistake).
Rule rule_of(std::string_view id, const CodeChoice& codes);
/// A rule of ours that belongs to no code. Requires: as above.
Rule own_rule(std::string_view id);

}  // namespace luxodus
