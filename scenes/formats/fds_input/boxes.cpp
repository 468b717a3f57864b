#include "scenes/formats/fds_input/boxes.hpp"

namespace luxodus::fds_input {

bool cuts(const Box& hole, const Box& box) {
  // A hole cuts a flat box if it holds the box's plane strictly within, and a thick one if both
  // overlap.
  return glm::all(glm::lessThan(hole.low, box.high)) &&
         glm::all(glm::greaterThan(hole.high, box.low));
}

std::vector<Box> without(const Box& box, const Box& hole) {
  if (!cuts(hole, box)) return {box};
  std::vector<Box> out;
  Box rest = box;
  for (int axis = 0; axis < 3; ++axis) {
    if (rest.low[axis] < hole.low[axis]) {
      out.push_back(rest);
      out.back().high[axis] = hole.low[axis];
      rest.low[axis] = hole.low[axis];
    }
    if (rest.high[axis] > hole.high[axis]) {
      out.push_back(rest);
      out.back().low[axis] = hole.high[axis];
      rest.high[axis] = hole.high[axis];
    }
  }
  return out;
}

std::optional<std::vector<Box>> without_all(const Box& box, const std::vector<Box>& holes,
                                            size_t most, Comparisons& comparisons) {
  std::vector<Box> left{box};
  comparisons.made += holes.size();
  if (comparisons.too_many()) return std::nullopt;
  for (const Box& hole : holes) {
    if (!cuts(hole, box)) continue;
    comparisons.made += left.size();
    if (comparisons.too_many()) return std::nullopt;
    std::vector<Box> next;
    for (const Box& one : left) {
      for (const Box& piece : without(one, hole)) next.push_back(piece);
      if (next.size() > most) return std::nullopt;
    }
    left = std::move(next);
  }
  return left;
}

}  // namespace luxodus::fds_input
