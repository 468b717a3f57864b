// Prints the findings of a scene's inspection. One thread.
#pragma once

#include "actors/judge/inspect/inspect.hpp"
#include "actors/results/formats/json_out.hpp"

namespace luxodus::cli {

/// One line "file:line: warning: sentence" on standard error for each, in their order.
void tell_findings(const std::vector<Finding>& findings);

/// "2 errors, 1 warning, no notes"
std::string count_text(const std::vector<Finding>& findings);

/// [{"severity": "error", "kind": "inside", "file": "a.toml", "line": 3, "what": "..."}]
Json findings_json(const std::vector<Finding>& findings);

/// Inspects a scene before it is used, and prints the findings on standard error. Returns whether
/// to go on: false if there is an error.
bool passes_inspection(const std::shared_ptr<const SceneDescription>& scene,
                       const std::vector<Scenario>& scenarios, int threads);

}  // namespace luxodus::cli
