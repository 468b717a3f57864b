// Points that stand for a flame where light is computed without chance. Which they are follows from
// the medium alone, so that they are the same at every start. Pure; any thread.
#pragma once

#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/optics/media_set.hpp"

namespace luxodus {

namespace limits {
inline constexpr int flame_points = 512;
}  // namespace limits

/// Points of equal power. Requires: the medium glows.
template <class Resolver>
std::vector<glm::vec3> flame_points(const MediaSet& media, uint32_t medium, Resolver& resolver) {
  Random random(medium, RandomStream::layout);
  std::vector<glm::vec3> points;
  for (int i = 0; i < limits::flame_points; ++i) {
    random.start(static_cast<uint64_t>(i));
    points.push_back(media.sample_emission_point(
        static_cast<int>(medium), [&] { return random.uniform_double(); }, resolver));
  }
  return points;
}

}  // namespace luxodus
