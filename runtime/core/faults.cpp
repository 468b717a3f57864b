#include "runtime/core/faults.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

bool FaultPlan::holds(Fault::Kind kind, NodeId node, Nanoseconds moment) const {
  return std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
    return fault.kind == kind && fault.node == node && fault.holds(moment);
  });
}

Nanoseconds LinkTroubles::uniform(Nanoseconds most) {
  return most == 0 ? 0 : std::llround(random_.uniform_double() * static_cast<double>(most));
}

FrameFate LinkTroubles::next(bool healed) {
  constexpr Nanoseconds ghosts_within = seconds(10);
  FrameFate fate;
  fate.hold = traits_.delay + uniform(traits_.jitter);
  if (chance(traits_.tail_share)) fate.hold += uniform(traits_.tail);
  if (healed) return fate;
  fate.lost = chance(traits_.loss);
  fate.harmed = chance(traits_.corruption);
  if (chance(traits_.duplication)) fate.again = fate.hold + uniform(traits_.tail);
  if (chance(traits_.ghosts)) fate.ghost = fate.hold + uniform(ghosts_within);
  fate.overtaken = chance(traits_.reordering);
  if (fate.overtaken) fate.hold += uniform(traits_.tail);
  return fate;
}

void LinkTroubles::harm(std::span<std::byte> bytes) {
  if (bytes.empty()) return;
  const auto turns = 1 + uniform(3);
  for (Nanoseconds i = 0; i < turns; ++i) {
    const auto bit = static_cast<size_t>(uniform(static_cast<Nanoseconds>(8 * bytes.size()) - 1));
    bytes[bit / 8] ^= std::byte{static_cast<uint8_t>(1u << (bit % 8))};
  }
}

Nanoseconds LinkTroubles::wire_time(size_t bytes) const {
  if (traits_.bytes_per_second <= 0) return 0;
  return std::llround(1e9 * static_cast<double>(bytes) / traits_.bytes_per_second);
}

}  // namespace luxodus
