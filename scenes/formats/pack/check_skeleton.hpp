// Checks that a decoded skeleton says what a scene's reader and compiler would have said: every
// number in the range of the scene format, every index within its list, every count consistent with
// the others. The hash of a pack detects accidents only: an attacker recomputes it, and everything
// compiled and traced relies on these checks. Pure function; any thread.
#pragma once

#include "scenes/formats/pack/skeleton.hpp"

namespace luxodus {

/// Throws DamagedArchive at the first value that is impossible.
void check_skeleton(const Skeleton& skeleton);

}  // namespace luxodus
