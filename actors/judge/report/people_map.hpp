// Drawings of people who were followed: where they stood without a sign that they read, and how
// many of them read one over time. Pure functions; any thread.
#pragma once

#include "actors/judge/record/people_record.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "actors/results/formats/svg_plot.hpp"

namespace luxodus {

/// Person-seconds without a sign read, by colour, over the walls of a level. `cell_m`: edge of the
/// floor's cells.
Plan people_map(const PlanLevel& level, const WalkedFloor& floor, double cell_m, const Texts& texts,
                const PlanSize& size = {});

/// The share of the people in the building who read a sign, over time.
SvgPlot people_curve(const FollowedPeople& people, const Texts& texts);

}  // namespace luxodus
