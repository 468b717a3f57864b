// Boxes along the axes, which may be flat, and boxes minus others. Metres. Any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace luxodus::fds_input {

struct Box {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};

/// Whether a hole removes part of a box. A hole that only touches a face removes nothing.
bool cuts(const Box& hole, const Box& box);

/// The remainder of a box: at most six boxes that fill it, those below and above the hole along x,
/// then y, then z. The box itself where the hole does not cut it.
std::vector<Box> without(const Box& box, const Box& hole);

/// Counts comparisons of boxes, with a limit at which the caller gives up.
struct Comparisons {
  uint64_t made = 0;
  uint64_t most = UINT64_MAX;
  bool too_many() const { return made > most; }
};

/// The remainder of a box; nothing where that is more than `most` boxes, or after too many
/// comparisons.
std::optional<std::vector<Box>> without_all(const Box& box, const std::vector<Box>& holes,
                                            size_t most, Comparisons& comparisons);

}  // namespace luxodus::fds_input
