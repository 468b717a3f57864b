// The heat release rate of a simulated fire over time, from FDS's table CASE_hrr.csv. Reads a file;
// any thread.
#pragma once

#include <optional>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_frames.hpp"

namespace luxodus::fds {

namespace limits {
/// 1000 lines of a kilobyte are usual.
inline constexpr uint64_t heat_release_bytes = uint64_t{256} << 20;
}  // namespace limits

struct HeatRelease {
  double kw = 0;
  std::optional<BackStep> back;  // the first in the table
};

/// Heat release rate of the whole fire at a time [kW], linear between the lines of the table. Where
/// times go back or repeat, as after a restart, later lines hold.
/// Errors, with file and line: no such file, no columns Time and HRR, malformed numbers, a time
/// more than a second after the last line.
Result<HeatRelease> heat_release(const Case& fire, double time_s);

}  // namespace luxodus::fds
