// The text file that FDS writes beside each file of Smoke3D, FILE.s3d.sz: for each frame its time,
// its sizes and its highest value. From FDS 6.11 on, bytes of densities are shares of that value.
// Any thread.
#pragma once

#include <cstdint>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_frames.hpp"

namespace luxodus::fds {

namespace limits {
/// 60 bytes for each of the most frames that are read.
inline constexpr uint64_t sizes_bytes = uint64_t{96} << 20;
}  // namespace limits

/// Gives each frame of a Smoke3D file its highest value. Frames at the end that the file of sizes
/// does not have yet belong to a run in progress and are dropped. Requires: times of frames ascend.
/// Errors: no such file; malformed lines; a frame in between that it does not have.
Result<void> add_highest_values(const Case& fire, FrameFiles& smoke);

}  // namespace luxodus::fds
