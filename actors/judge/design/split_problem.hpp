// A problem taken apart where its parts have nothing to do with each other: storeys of a tower,
// rooms behind closed doors. No row asks for options of two parts, and no place has options in two.
// Plain values; any thread.
#pragma once

#include <vector>

#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

struct ProblemPart {
  LayoutProblem problem;          // with all groups, so that their numbers stay
  std::vector<uint32_t> options;  // of the whole problem, by number in the part
};

/// In the order of their first options. One part with everything where nothing can be taken apart,
/// where there is no row, or where a row has no option at all.
std::vector<ProblemPart> parts_of(const LayoutProblem& problem);

}  // namespace luxodus
