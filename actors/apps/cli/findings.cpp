#include "actors/apps/cli/findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/progress_line.hpp"

namespace luxodus::cli {

namespace {

std::string counted(const std::vector<Finding>& findings, Severity severity) {
  const auto n = std::count_if(findings.begin(), findings.end(),
                               [&](const Finding& f) { return f.severity == severity; });
  return fmt::format("{} {}{}", n == 0 ? "no" : std::to_string(n), word_of(severity),
                     n == 1 ? "" : "s");
}

}  // namespace

void tell_findings(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) std::fprintf(stderr, "%s\n", f.text().c_str());
}

std::string count_text(const std::vector<Finding>& findings) {
  return counted(findings, Severity::error) + ", " + counted(findings, Severity::warning) + ", " +
         counted(findings, Severity::note);
}

Json findings_json(const std::vector<Finding>& findings) {
  Json out = Json::array();
  for (const Finding& f : findings)
    out.push_back({{"severity", word_of(f.severity)},
                   {"kind", f.kind},
                   {"file", f.problem.where.file},
                   {"line", f.problem.where.line},
                   {"what", f.problem.what}});
  return out;
}

std::optional<ProblemKind> refused_by_inspection(
    const std::shared_ptr<const SceneDescription>& scene, const std::vector<Scenario>& scenarios,
    int threads) {
  const auto found = [&] {
    const WaitingLine waiting("inspecting " + scene->file);
    return inspect(scene, scenarios, threads);
  }();
  if (!found) {
    tell(found.problem());
    return found.problem().kind;
  }
  tell_findings(found.value());
  if (!has_error(found.value())) return std::nullopt;
  return found->front().problem.kind;  // errors come first
}

}  // namespace luxodus::cli
