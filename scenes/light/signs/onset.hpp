// Run-up of emergency luminaires after a failure of the mains, and the end of their supply. Pure
// functions; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Share of the emergency flux that is emitted `seconds` after the failure: linear between the rows
/// of an onset (time, share), the first share before and the last share after them. Without rows: 1
/// at once.
double onset_share(const std::vector<glm::dvec2>& onset, double seconds);

/// Whether a supply of this duration [s] is exhausted; false if no duration is given.
inline bool is_exhausted(const std::optional<double>& duration_s, double seconds) {
  return duration_s && seconds >= *duration_s;
}

/// Share of a luminaire's emergency flux that is emitted `seconds` after the failure: by its onset,
/// and 0 once its supply is exhausted.
inline double emergency_share(const Emitter& emitter, double seconds) {
  return is_exhausted(emitter.duration_s, seconds) ? 0 : onset_share(emitter.onset, seconds);
}

}  // namespace luxodus
