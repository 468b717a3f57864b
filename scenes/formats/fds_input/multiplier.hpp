// &MULT: copies of a box. Plain values; any thread.
#pragma once

#include <functional>
#include <string>

#include "scenes/formats/fds_input/boxes.hpp"
#include "scenes/formats/fds_input/group_keys.hpp"

namespace luxodus::fds_input {

/// Copies i, j, k of a box, shifted by steps along the axes, or, with `sequential`, copies i
/// shifted along all of them. A range of copies may be left out.
struct Multiplier {
  std::string id;
  glm::dvec3 shift{0};                   // of all copies [m]
  glm::dvec3 step_low{0}, step_high{0};  // of the lower and upper corners [m]
  glm::ivec3 first{0}, last{0};
  glm::ivec3 skip_first{1}, skip_last{0};  // an empty range where none is skipped
  bool sequential = false;

  /// Number of copies.
  int64_t count() const;
  Box copy(const Box& box, const glm::ivec3& number) const;
  bool skips(const glm::ivec3& number) const;
};

/// Errors: more copies than `most`.
Multiplier multiplier_of(GroupKeys& keys, int64_t most);

}  // namespace luxodus::fds_input
