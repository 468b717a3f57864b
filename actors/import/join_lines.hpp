// Joins the short lines of a drawing: a curve that is drawn in pieces of millimetres is a wall all
// the same. Pure; any thread.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace luxodus {

struct DrawnLine {
  glm::dvec2 from{0}, to{0};  // [m]
};

struct JoinedLines {
  std::vector<DrawnLine> lines;
  size_t dropped = 0;  // lines of chains that span less than a millimetre
};

namespace limits {
/// Shorter lines are joined to others where they meet [m]. The joined line is nowhere farther than
/// this from those that it stands for.
inline constexpr double shortest_wall_m = 0.02;
/// What is shorter even when joined is a mark, not a wall [m].
inline constexpr double shortest_joint_m = 0.001;
}  // namespace limits

/// The lines in their order, chains of short ones in the place of their first.
JoinedLines join_short_lines(std::span<const DrawnLine> lines);

}  // namespace luxodus
