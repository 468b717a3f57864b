// Makes the text messages to viewers (PROTOCOL.md). Pure; any thread.
#pragma once

#include "actors/apps/view/live_trace.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// Changes by viewers that need no tracing.
struct LiveDimming {
  std::map<std::string, double> factors;  // of groups; others are 1
  std::optional<double> seconds;          // since the mains failure; none: fully on
  std::map<std::string, double> shares;   // shares of the traced light at that time; others are 1

  /// Factor times share of each group's light.
  std::map<std::string, double> both() const;
};

/// Describes a generation, without its light. `follows`: for a viewer that has the previous
/// generation, and may go on showing its light. Requires: it has a look.
Json live_scene_json(const SceneDescription& scene, const LiveGeneration& generation,
                     const LiveDimming& dimming, bool editor, bool follows);
/// Null without a value.
Json optional_json(const std::optional<double>& value);
Json progress_json(const LiveProgress& progress);
Json answer_json(const LiveAnswer& answer);

}  // namespace luxodus
