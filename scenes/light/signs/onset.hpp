// How emergency luminaires come on after the mains have failed, and how long they last. Pure
// functions; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scenes/light/world/description.hpp"

namespace luxodus {

/// Share of the emergency flux that is there `seconds` after the failure: linear between the rows
/// of an onset (time, share), the first share before, the last after them. Empty: 1, at once.
double onset_share(const std::vector<glm::dvec2>& onset, double seconds);

/// Whether a supply that lasts so long [s] is exhausted; never where that is not said.
inline bool is_exhausted(const std::optional<double>& duration_s, double seconds) {
  return duration_s && seconds >= *duration_s;
}

/// Of a luminaire's emergency flux, `seconds` after the failure: by its onset, and none once its
/// supply is exhausted.
inline double emergency_share(const Emitter& emitter, double seconds) {
  return is_exhausted(emitter.duration_s, seconds) ? 0 : onset_share(emitter.onset, seconds);
}

}  // namespace luxodus
