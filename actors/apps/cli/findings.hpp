// Prints the findings of a scene's inspection. One thread.
#pragma once

#include <optional>

#include "actors/judge/inspect/inspect.hpp"
#include "actors/results/formats/json_out.hpp"
#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// One line "file:line: warning: sentence" on standard error for each, in their order.
void tell_findings(const std::vector<Finding>& findings);

/// "2 errors, 1 warning, no notes"
std::string count_text(const std::vector<Finding>& findings);

/// [{"severity": "error", "kind": "inside", "file": "a.toml", "line": 3, "what": "..."}]
Json findings_json(const std::vector<Finding>& findings);

/// Inspects a scene before something is made of it, and tells what was found on standard error. An
/// error refuses, told as the others are: then the kind of the problem; none where it may go on.
std::optional<ProblemKind> refused_by_inspection(
    const std::shared_ptr<const SceneDescription>& scene, const std::vector<Scenario>& scenarios,
    int threads);

}  // namespace luxodus::cli
