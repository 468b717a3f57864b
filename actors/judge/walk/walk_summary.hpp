// Followed people in numbers: per person, per sign, over time, and over the floor. Times count
// steps: a step stands for its length. A place or time counts as guided only if a sign is read
// there for sure; undecided is not guided. Pure functions; any thread.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "actors/judge/record/plan_record.hpp"
#include "actors/judge/walk/follow.hpp"

namespace luxodus {

struct PersonSummary {
  double from_s = 0, to_s = 0;
  double read_s = 0, undecided_s = 0, unread_s = 0;  // with a sign read; perhaps; surely without
  double longest_unread_s = 0;                       // longest time without a sign read
  std::optional<double> first_read_s, last_read_s;   // of the clock
  size_t signs_read = 0;
  double mean_extinction = 0, max_extinction = 0;  // at the eye [1/m]
  double max_bleached_cd_m2 = 0;
};
PersonSummary summary_of(const WalkedPerson& walked, double step_s);

/// Person-seconds of one sign in the fields of view of people whom it could guide.
struct SignSummary {
  double in_view_s = 0;
  std::array<double, sign_answers> by_answer_s{};
  double hidden_by_people_s = 0;  // part of those with the answer hidden
  size_t readers = 0;             // people who read it
};
std::vector<SignSummary> sign_summaries(size_t signs, const std::vector<WalkedPerson>& walks,
                                        double step_s);

/// People at one time.
struct CurvePoint {
  double time_s = 0;
  size_t present = 0, reading = 0, undecided = 0;
  std::optional<double> reading_share() const;  // none if nobody is there
};
/// At all steps between the first and the last at which anybody is there. Requires: check_steps.
std::vector<CurvePoint> curve_of(const std::vector<WalkedPerson>& walks, double step_s);

/// All of it.
struct WalkSummaries {
  std::vector<PersonSummary> people;  // in the order of the walks
  std::vector<SignSummary> signs;     // in the order of the scene
  std::vector<CurvePoint> curve;
};
/// `signs`: of the scene.
WalkSummaries summaries_of(size_t signs, const std::vector<WalkedPerson>& walks, double step_s);

/// Edge of a cell of the floor on which people are counted [m].
inline constexpr double counted_cell_m = 0.5;
/// Person-seconds without a sign read, of each cell in which somebody was: by its column and row,
/// counted from the origin of the scene, on one level.
using FloorCount = std::map<std::pair<int, int>, double>;
/// For each level. Requires: at least one level.
std::vector<FloorCount> floor_counts(const std::vector<PlanLevel>& levels,
                                     const std::vector<PlacedPerson>& people,
                                     const std::vector<WalkedPerson>& walks, double step_s);

}  // namespace luxodus
