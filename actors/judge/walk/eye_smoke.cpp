#include "actors/judge/walk/eye_smoke.hpp"

#include <algorithm>

#include "actors/judge/assess/judged_state.hpp"
#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

namespace {

/// Length over which smoke is measured at an eye [m]: a part of any cell of a simulation.
constexpr double measured_m = 0.02;

}  // namespace

double extinction_at_eye(const Building& building, const GeometryAccess& access,
                         const glm::dvec3& eye) {
  const glm::dvec3 half(measured_m / 2, 0, 0);
  const glm::vec3 from = building.local(eye - half), to = building.local(eye + half);
  return depth_between(building.scene(), access, from, to, stated_nm) /
         static_cast<double>(glm::distance(from, to));
}

double weight_of_state(const std::vector<double>& times_s, size_t state, double time_s) {
  if (times_s.size() == 1) return 1;
  const double at_s = times_s[state];
  if (time_s < at_s)
    return state == 0 ? 1 : std::max(0.0, 1 - (at_s - time_s) / (at_s - times_s[state - 1]));
  return state + 1 == times_s.size()
             ? 1
             : std::max(0.0, 1 - (time_s - at_s) / (times_s[state + 1] - at_s));
}

}  // namespace luxodus
