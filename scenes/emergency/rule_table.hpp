// The rules by their numbers, for the sources of this folder. Constant data; any thread.
#pragma once

#include <string_view>

#include "scenes/emergency/check.hpp"

namespace luxodus {

/// "E1", ... Requires: there is one (a programmer's mistake throws).
Rule rule_of(std::string_view id);

}  // namespace luxodus
