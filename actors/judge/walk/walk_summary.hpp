// Followed people in numbers: per person, per sign, over time, and over the floor. Times count
// steps: a step stands for its length. A place or time counts as guided only if a sign is read
// there for sure; undecided is not guided. Pure functions; any thread.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "actors/judge/walk/follow.hpp"

namespace luxodus {

struct PersonSummary {
  size_t person = 0;  // of the placed people
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
  double reading_share() const;
};
/// At all steps between the first and the last at which anybody is there.
std::vector<CurvePoint> curve_of(const std::vector<WalkedPerson>& walks, double step_s);

/// Edge of a cell of the floor on which people are counted [m].
inline constexpr double counted_cell_m = 0.5;
/// Person-seconds in a cell: all, and those without a sign read.
struct CellCount {
  double all_s = 0, unread_s = 0;
};
/// The highest of these floors, from below, that is at most half a metre above a foot; else the
/// lowest.
size_t level_below(const std::vector<double>& floors, double foot_m);
/// By column and row of the cell, counted from the origin of the scene, on one level.
using FloorCount = std::map<std::pair<int, int>, CellCount>;
std::vector<FloorCount> floor_counts(const std::vector<double>& levels,
                                     const std::vector<PlacedPerson>& people,
                                     const std::vector<WalkedPerson>& walks, double step_s);

}  // namespace luxodus
