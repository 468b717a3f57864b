// Guided routes over time: each state of a scene is traced, and says at which places of which
// routes a sign is read that leads on. No analysis of available and required safe egress time: it
// knows neither heat nor gases nor when people set out. Thread rule: one thread, which has batches
// traced by others.
#pragma once

#include "actors/judge/assess/assessment.hpp"
#include "scenes/light/world/timed_scenes.hpp"

namespace luxodus {

/// Whether anything can be followed over time, before anything is traced.
/// Errors: a scene without routes or without signs that lead along one.
Result<void> check_guidance(const SceneDescription& scene);

/// Judges the views of signs that lead along routes, at each of these times, all with the same
/// random numbers. A view that is legible is traced again with the smoke's albedo at either end of
/// 0.1 to 0.5 (wider, where the scene states another) and its extinction raised by the largest
/// error of its source; where the verdict does not hold it is undecided.
/// `options.scenario`: by name; see judged_scenario. Requires: times that ascend.
/// Errors: as check_guidance; as `scene_at`, as
/// assess_sights.
Result<OverTime> assess_over_time(const std::vector<double>& times_s, const SceneAtTime& scene_at,
                                  const AssessOptions& options, const std::atomic<bool>& interrupt,
                                  const AssessProgress& progress);

/// What is assessed: a scene, or its states at several times.
struct StatesToAssess {
  std::shared_ptr<const SceneDescription> last;  // or the only one
  std::vector<double> times_s;                   // that ascend; one or none: there is one state
  SceneAtTime reader;                            // of more than one
};

/// Assesses the last state, and where there are more and views are judged, routes over all of them.
/// `over_time`: progress of the latter. Errors: as assess and assess_over_time.
Result<Assessment> assess_states(const StatesToAssess& states, const AssessOptions& options,
                                 const std::atomic<bool>& interrupt, const AssessProgress& progress,
                                 const AssessProgress& over_time);

}  // namespace luxodus
