// The page of a design: what was found and how good it is, the plan, the schedule, what binds, and
// what no luminaire decides. From the JSON of the design and that of its assessment; pure; any
// thread.
#pragma once

#include <string>

#include "actors/judge/design/side_by_side.hpp"
#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

std::string design_page(const Json& design, const Json& assessment,
                        const std::vector<LayoutPlan>& plans, Language language);

}  // namespace luxodus
