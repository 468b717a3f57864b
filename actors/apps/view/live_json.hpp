// The text messages to viewers (PROTOCOL.md). Pure; any thread.
#pragma once

#include "actors/apps/view/live_trace.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus {

/// What viewers have changed that needs no tracing.
struct LiveDimming {
  std::map<std::string, double> factors;  // of groups; others 1
  std::optional<double> seconds;          // since the mains have failed; none: fully on
  std::map<std::string, double> shares;   // of what is traced, by then; others 1

  /// Of a group's light: factor and share.
  std::map<std::string, double> both() const;
};

/// What a generation is of, without its light. `follows`: to somebody who has the generation
/// before, and may go on showing light of it. Requires: it has a look.
Json live_scene_json(const SceneDescription& scene, const LiveGeneration& generation,
                     const LiveDimming& dimming, bool editor, bool follows);
Json progress_json(const LiveProgress& progress);
Json answer_json(const LiveAnswer& answer);

}  // namespace luxodus
