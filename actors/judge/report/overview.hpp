// An overview of a building: its storeys seen obliquely from above, floors in the false colours of
// their illuminance, walls cut open, emergency luminaires and signs. A drawing of the record; it
// traces nothing. Pure function; any thread.
#pragma once

#include <string>

#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

/// "" for a building without walls and routes.
std::string overview_svg(const AssessmentRecord& assessment, const Schedule& schedule,
                         const Texts& texts, const PlanSize& size);

}  // namespace luxodus
