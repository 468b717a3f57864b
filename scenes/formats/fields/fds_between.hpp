// Two frames of a fire simulation as one state between them. Any thread.
#pragma once

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

/// Frames of one tick of FDS have one time in all files, but for the digits of PLOT3D's names [s].
/// A restart may write a tick twice.
inline constexpr double same_tick_s = 0.006;

/// Whether a time is that of the frame at `frame_s`, and not between it and the one at `other_s`:
/// it is as near to it as a hundredth of the way, or both frames are of one tick.
bool is_of_frame(double at_s, double frame_s, double other_s);

/// The frame nearest to the time that is asked for. Errors: as read_fire.
Result<LoadedFire> read_frame(const Case& fire, const FireOptions& options);

/// A state linear between two frames: extinctions and heat by cell. `share`: of the way from the
/// earlier to the later one. Requires: they are of one case and source.
LoadedFire blended(LoadedFire early, const LoadedFire& late, double share);

}  // namespace luxodus::fds
