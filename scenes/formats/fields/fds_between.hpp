// Interpolates between two frames of a fire simulation. Pure functions but for reading files; any
// thread.
#pragma once

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

/// Whether a time counts as that of the frame at `frame_s`, not as between it and the one at
/// `other_s`: it is within a hundredth of the interval, or both frames are of one tick.
bool is_of_frame(double at_s, double frame_s, double other_s);

/// Reads the frame nearest to the requested time. Errors: as read_fire.
Result<LoadedFire> read_frame(const Case& fire, const FireOptions& options);

/// Interpolates extinctions and heat linearly by cell. `share`: of the way from the earlier to the
/// later state. Requires: both are of one case and source.
LoadedFire blended(LoadedFire early, const LoadedFire& late, double share);

}  // namespace luxodus::fds
