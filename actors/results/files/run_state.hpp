// Describes the state of the building that a run has computed, in a designer's terms: operation,
// how many lights are on, where smoke is. Pure; any thread.
#pragma once

#include <string>

#include "actors/results/formats/json_out.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// {"scenario", "operation", "after_failure", "luminaires", "signs", "smoke", "flames"}.
Json run_state_json(const CompiledScene& scene);

/// The state in one line: "smoke_emergency: emergency operation 60 s after the failure; 12 of 40
/// luminaires lit; 6 of 6 signs lit; smoke: layer". Requires: `state` is a run_state_json.
std::string run_state_text(const Json& state);

}  // namespace luxodus
