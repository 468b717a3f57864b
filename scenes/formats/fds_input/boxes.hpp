// Boxes along the axes, which may be flat, and boxes less others. Metres. Any thread.
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

/// Whether a hole takes something of a box. One along whose face it lies takes nothing.
bool cuts(const Box& hole, const Box& box);

/// What is left of a box, at most six of them that together are it: those below and above the hole
/// along x, then y, then z. The box itself where the hole does not cut it.
std::vector<Box> without(const Box& box, const Box& hole);

/// Comparisons of boxes, and after how many somebody gives up.
struct Comparisons {
  uint64_t made = 0;
  uint64_t most = UINT64_MAX;
  bool too_many() const { return made > most; }
};

/// What is left of a box; nothing where that is more than `most`, or after too many comparisons.
std::optional<std::vector<Box>> without_all(const Box& box, const std::vector<Box>& holes,
                                            size_t most, Comparisons& comparisons);

}  // namespace luxodus::fds_input
