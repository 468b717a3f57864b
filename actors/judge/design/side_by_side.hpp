// Plans of the layouts that were judged in smoke, small and beside each other. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/texts/texts.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

struct DesignResult;

/// A layout, and the assessment JSON that its plan is drawn from: its own luminaires, and the
/// building and marks of the first layout.
struct LayoutPlan {
  std::string name;
  Json drawn;
};

/// Of the layouts whose signs are as they are; empty where none was judged beside the first.
std::vector<LayoutPlan> layout_plans(const DesignResult& result, const std::string& version);

/// A section of the page, by level; empty without plans.
std::string side_by_side(const Texts& t, const Json& design, const std::vector<LayoutPlan>& plans);

}  // namespace luxodus
