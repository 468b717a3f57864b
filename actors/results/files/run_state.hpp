// The state of the building that a run has computed, in words of who designs it: what supplies the
// light, how much of it is lit, where smoke is. Pure; any thread.
#pragma once

#include <string>

#include "actors/results/formats/json_out.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// {"scenario", "operation", "after_failure", "luminaires", "signs", "smoke", "flames"}.
Json run_state_json(const CompiledScene& scene);

/// The same in one line: "smoke_emergency: emergency operation 60 s after the failure; 12 of 40
/// luminaires lit; 6 of 6 signs lit; smoke: layer". Requires: `state` is a run_state_json.
std::string run_state_text(const Json& state);

}  // namespace luxodus
