// What the search of thresholds shares: what is searched in, the eyes, and the levels that a view
// has for each of them. One thread.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/record/threshold_record.hpp"
#include "actors/judge/thresholds/crossing.hpp"

namespace luxodus {

/// A search in an assessed state. Requires: all outlive the search; `assessed` is that of the
/// scenario.
struct ThresholdSearch {
  const SceneDescription& scene;
  const Scenario& scenario;
  const Assessment& assessed;
  const AssessOptions& options;
  const std::atomic<bool>& interrupt;
  const AssessProgress& progress;
};

using ThresholdRows = std::vector<ThresholdRecord>;

/// Identifies a view in assessments of one scene.
using ViewKey = std::tuple<SubjectKind, std::string, double, double, double, std::string>;
ViewKey key_of(const SightRow& row);

/// The sign of a view. Requires: a view of the scene.
const Sign& sign_of(const SceneDescription& scene, const SightRow& row);

/// The eyes by which a view is judged: those of the stated age, "", and the scene's other eyes.
std::vector<std::string> eyes_of(const SceneDescription& scene);

/// What all eyes see in a view, in the worse of aged and new light. Empty if light does not decide.
std::vector<Sight> sights_of(const SightRow& row);

/// The level of reading or seeing at a value of what is varied.
LevelPoint point_of(double at, const Sight& sight, bool read);

/// Rounds of paths for views whose light is asked for, and when a view has enough of them: its
/// levels are known to 15 %, and to less far from their limits.
inline constexpr int threshold_rounds = 2;
bool known_enough(const SightRow& row);

/// Options of an assessment for the light of some views.
AssessOptions looking_at(const std::set<ViewKey>& views, const AssessOptions& options);

inline ThresholdValue value_of(const Crossing& crossing) {
  return {crossing.at.value, crossing.at.error};
}

/// A record that says what is sought for which view, and not yet where.
ThresholdRecord record_for(Sought sought, const SightRow& row, const std::string& eyes, bool read);

}  // namespace luxodus
