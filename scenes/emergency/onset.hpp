// How emergency luminaires come on after the mains have failed. Pure functions; any thread.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace luxodus {

/// Share of the emergency flux that is there `seconds` after the failure: linear between the rows
/// of an onset (time, share), the first share before, the last after them. Empty: 1, at once.
double onset_share(const std::vector<glm::dvec2>& onset, double seconds);

}  // namespace luxodus
