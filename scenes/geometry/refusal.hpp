// A problem without a place: shapes and transforms know no file; whoever calls them does.
#pragma once

#include <string>
#include <utility>

#include "runtime/core/result.hpp"

namespace luxodus {

/// The text is whole before the problem is made: GCC 12 falsely warns of uninitialised members
/// where an aggregate's later member may throw.
inline Problem refusal(std::string what, std::string file = {}) {
  return Problem{{std::move(file), 0}, std::move(what)};
}

}  // namespace luxodus
