// Small plans of the layouts that were judged in smoke, side by side. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/design/design_record.hpp"
#include "actors/judge/record/assessment_record.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// A layout with the record of an assessment for its plan: its own luminaires, and the building and
/// symbols of the first layout.
struct LayoutPlan {
  std::string name;
  AssessmentRecord drawn;
};

/// Plans of layouts with unchanged signs; empty if only the first layout was judged.
std::vector<LayoutPlan> layout_plans(const DesignResult& result, const std::string& version);

/// A section of the page, by level; "" without plans.
std::string side_by_side(const Texts& t, const DesignRecord& design,
                         const std::vector<LayoutPlan>& plans);

}  // namespace luxodus
