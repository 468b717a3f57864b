// The heat release rate of a simulated fire over time, from FDS's table CASE_hrr.csv. Reads a file;
// any thread.
#pragma once

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

namespace limits {
/// 1000 lines of a kilobyte are usual.
inline constexpr uint64_t heat_release_bytes = uint64_t{256} << 20;
}  // namespace limits

/// Heat release rate of the whole fire at a time [kW], linear between the lines of the table. Where
/// times go back, as after a restart, later lines hold.
/// Errors, with file and line: no such file, no columns Time and HRR, malformed numbers, a time
/// more than a second after the last line.
Result<double> heat_release_kw(const Case& fire, double time_s);

}  // namespace luxodus::fds
