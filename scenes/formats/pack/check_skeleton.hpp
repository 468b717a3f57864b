// Whether a decoded skeleton says what a scene's reader and compiler would have said: every number
// in the range that the scene format gives it, every index within its list, every count that which
// others follow from. The hash of a pack shows accidents, not intentions: whoever forges a pack
// computes it anew, and what is compiled and traced trusts all of this. Any thread.
#pragma once

#include "scenes/formats/pack/skeleton.hpp"

namespace luxodus {

/// Throws DamagedArchive with the first thing that cannot be.
void check_skeleton(const Skeleton& skeleton);

}  // namespace luxodus
