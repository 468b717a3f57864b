// Guided routes over time: each state of a scene is traced to find the places of each route from
// which a guiding sign is read. It is no analysis of available and required safe egress time: it
// knows neither heat nor gases nor when people set out. Thread rule: one thread, which has batches
// traced by others.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// Whether the scene has routes and guiding signs; checked before anything is traced.
/// Errors: a scene without routes, or without signs that lead along one.
Result<void> check_guidance(const SceneDescription& scene);

/// Judges views of signs that lead along routes at each of these times, with the same random
/// numbers for all. A legible view is traced again with smoke of the smallest and of the largest
/// albedo of 0.1 to 0.5 (a wider range if the scene states an albedo outside), and with its
/// extinction raised by the largest error of its source. If it is not legible in both, it is
/// undecided.
/// `options.scenario`: a name; see judged_scenario. Requires: ascending times. Errors: as
/// check_guidance, `scene_at` and assess_sights.
Result<OverTime> assess_over_time(const std::vector<double>& times_s, const SceneAtTime& scene_at,
                                  const AssessOptions& options, const std::atomic<bool>& interrupt,
                                  const AssessProgress& progress);

/// What to assess: a scene, or its states at several times.
struct StatesToAssess {
  std::shared_ptr<const SceneDescription> last;  // the last state, or the only one
  std::vector<double> times_s;                   // ascending; at most one time: there is one state
  SceneAtTime reader;                            // used if there are several states
};

/// Assesses the last state; if there are several and views are judged, also the routes over all of
/// them, with the progress `over_time`. Errors: as assess and assess_over_time.
Result<Assessment> assess_states(const StatesToAssess& states, const AssessOptions& options,
                                 const std::atomic<bool>& interrupt, const AssessProgress& progress,
                                 const AssessProgress& over_time);

}  // namespace luxodus
