// The heat release rate of a simulated fire over time, from the table CASE_hrr.csv of FDS. Any
// thread.
#pragma once

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

namespace limits {
/// 1000 lines of a kilobyte are usual.
inline constexpr uint64_t heat_release_bytes = uint64_t{256} << 20;
}  // namespace limits

/// Heat release rate of the whole fire at a time [kW], linear between the lines of the table.
/// Errors, with file and line: no such file, no columns Time and HRR, numbers that are none, a time
/// behind its last line by more than a second.
Result<double> heat_release_kw(const Case& fire, double time_s);

}  // namespace luxodus::fds
