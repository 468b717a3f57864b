// Scenes of experiments for the tracer: the room, its smoke, its lamps, and the target as a sign.
// Pure; any thread.
#pragma once

#include "actors/judge/validate/experiment.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus::light {

/// Light that the lamps of scenes below emit, unless scaled [lm].
inline constexpr double experiment_lamps_lm = 1000;

/// The scene with what is varied set to a threshold's value.
ExperimentScene set_to(const ExperimentScene& scene, Varied varied, double value);
/// The quantity that thresholds are stated in: "optical depth", "distance [m]", "contrast",
/// "visibility level".
const char* quantity_of(const Trial& trial);

/// The scene with one observer and one sign. `lamps_lm`: flux of all lamps together.
SceneDescription description_of(const ExperimentScene& scene, double lamps_lm);
/// The state in which it is looked at: all its light is on, and eyes come from the light before.
Scenario scenario_of(const LightBefore& before);
/// The scene of the lamps alone, in smoke or in clear air as they are measured, with one probe
/// where they are.
SceneDescription lamps_alone(const ExperimentScene& scene);

}  // namespace luxodus::light
