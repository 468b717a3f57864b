// Charts of the light on a route or an area: filled false colours, whole lines of equal
// illuminance, and values at points of calculation. Sizes are in millimetres on paper. Pure
// functions; any thread.
#pragma once

#include <string>

#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

/// A chart, and how many of its values are written.
struct SurfaceChart {
  Plan plan;
  size_t values = 0, points = 0;
};

/// Height of the digits of values: 7 pt.
inline constexpr double value_mm = 7 * 25.4 / 72;

/// Classes of illuminance that charts colour alike: number, colour, and text ("1–2 lx").
inline constexpr size_t lux_colours = 8;
size_t lux_class(double lux);
const char* lux_colour(size_t number);
std::string lux_class_text(size_t number, const Texts& texts);

/// Requires: a surface of the assessment.
SurfaceChart surface_chart(const AssessmentRecord& assessment, const Schedule& schedule,
                           const Texts& texts, const SurfaceRecord& surface, const PlanSize& size);

}  // namespace luxodus
