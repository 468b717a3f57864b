// Splits a problem into independent parts, such as storeys of a tower or rooms behind closed doors.
// No row has options of two parts, and no place has options in two. Pure function; any thread.
#pragma once

#include <vector>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

struct ProblemPart {
  LayoutProblem problem;          // with all groups, so that their indices stay valid
  std::vector<uint32_t> options;  // for each option of the part, its index in the whole problem
};

/// Parts in the order of their first options. A single part with everything if the problem cannot
/// be split, has no row, or has a row without options.
std::vector<ProblemPart> parts_of(const LayoutProblem& problem);

}  // namespace luxodus
