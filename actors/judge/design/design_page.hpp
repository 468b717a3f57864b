// The page of a design: the result and its bound, plan, schedule, binding demands, and failing
// checks that no luminaire decides. Made of the records of the design and of its assessment. Pure
// function; any thread.
#pragma once

#include <string>

#include "actors/judge/design/side_by_side.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

std::string design_page(const DesignRecord& design, const AssessmentRecord& assessment,
                        const std::vector<LayoutPlan>& plans, Language language);

}  // namespace luxodus
