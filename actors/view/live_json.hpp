// The text messages to viewers (PROTOCOL.md). Pure; any thread.
#pragma once

#include "actors/view/live_trace.hpp"
#include "scenes/format/json_out.hpp"

namespace luxodus {

/// What a generation is of, without its light. `follows`: to somebody who has the generation
/// before, and may go on showing light of it.
Json live_scene_json(const SceneDescription& scene, const LiveGeneration& generation,
                     const std::map<std::string, double>& factors, bool editor, bool follows);
Json progress_json(const LiveProgress& progress);
Json answer_json(const LiveAnswer& answer);

}  // namespace luxodus
