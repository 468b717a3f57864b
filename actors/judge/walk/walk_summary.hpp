// Followed people in numbers: per person, per sign, over time, and over the floor, as the record
// (actors/judge/record/people_record.hpp) holds them. A place or time counts as guided only if a
// sign is read there for sure. Pure functions; any thread.
#pragma once

#include <vector>

#include "actors/judge/record/people_record.hpp"
#include "actors/judge/record/plan_record.hpp"
#include "actors/judge/walk/follow.hpp"

namespace luxodus {

FollowedPerson summary_of(const PlacedPerson& person, const WalkedPerson& walked, double step_s);

/// `signs`: of the scene.
std::vector<PassedSign> sign_summaries(const std::vector<Sign>& signs,
                                       const std::vector<WalkedPerson>& walks, double step_s);

/// At all steps between the first and the last at which anybody is there. Requires: check_steps.
std::vector<PeopleAtTime> curve_of(const std::vector<WalkedPerson>& walks, double step_s);

/// Edge of a cell of the floor on which people are counted [m].
inline constexpr double counted_cell_m = 0.5;
/// The cells of each level, counted from the origin of the scene. Requires: at least one level.
std::vector<WalkedFloor> walked_floors(const std::vector<PlanLevel>& levels,
                                       const std::vector<PlacedPerson>& people,
                                       const std::vector<WalkedPerson>& walks, double step_s);

}  // namespace luxodus
