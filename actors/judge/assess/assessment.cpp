#include "actors/judge/assess/assessment.hpp"

#include <algorithm>

#include "actors/judge/assess/code_mode.hpp"
#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/assess/reality_mode.hpp"
#include "runtime/core/clock.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

namespace {

Result<void> can_assess(const SceneDescription& scene) {
  if (scene.packed)
    return problem_in(
        scene.file,
        "a pack has its triangles elsewhere: assess the scene file that it was made of");
  if (scene.routes.empty() && scene.open_areas.empty() && scene.task_areas.empty() &&
      scene.observers.empty())
    return problem_in(scene.file,
                      "there is nothing to assess: add [[route]], [[open_area]] or [[observer]]");
  return {};
}

/// Counts the places from which each sign is legible.
void count_sweep(double factor, const std::vector<SightRow>& sights, std::vector<SweepRow>& out) {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  for (const SightRow& row : sights) {
    if (row.sight.verdict == SightVerdict::hidden) continue;
    auto at = std::find_if(out.begin() + first, out.end(),
                           [&](const SweepRow& s) { return s.sign == row.sign; });
    if (at == out.end()) at = out.insert(out.end(), {factor, row.sign, 0, 0, 0});
    ++at->places;
    if (row.sight.verdict == SightVerdict::legible) ++at->legible;
    if (row.sight.verdict == SightVerdict::undecided) ++at->undecided;
  }
}

/// Errors: findings of severity error. Other findings are kept in `out`.
Result<void> inspected(const std::shared_ptr<const SceneDescription>& scene,
                       const Scenario& scenario, int threads, Assessment& out) {
  auto found = inspect(scene, {scenario}, threads);
  if (!found) return found.problem();
  const auto errors = std::count_if(found->begin(), found->end(),
                                    [](const Finding& f) { return f.severity == Severity::error; });
  if (errors > 0) {  // errors are sorted first
    Problem first = found->front().problem;
    if (errors > 1)
      first.what += " (the first of " + std::to_string(errors) +
                    " errors; `luxodus check` names all of them)";
    return first;
  }
  for (const Finding& finding : found.value())
    if (finding.severity == Severity::warning)
      out.warnings.push_back({finding.problem.where, std::nullopt, finding.problem.what, true});
  out.findings = std::move(found).value();
  return {};
}

}  // namespace

Result<Assessment> assess(const std::shared_ptr<const SceneDescription>& scene,
                          const AssessOptions& options, const std::atomic<bool>& interrupt,
                          const AssessProgress& progress) {
  if (auto ok = can_assess(*scene); !ok) return ok.problem();
  auto scenario = judged_scenario(*scene, options.scenario);
  if (!scenario) return scenario.problem();
  const auto codes = judged_codes(*scene, options.rules, options.deviations);
  if (!codes) return codes.problem();
  if (options.reality)
    if (auto ok = irritation_is_said(*scene, scenario.value()); !ok) return ok.problem();
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  Assessment out;
  out.state = state_of(*scene, scenario.value(), codes.value());
  for (Remark& one : overruled(*scene, options.rules, options.deviations))
    out.state.remarks.push_back(std::move(one));
  out.reality = options.reality;
  if (scenario->operation == Operation::mains)
    out.warnings.push_back({scenario->place, remark(RemarkId::mains_operation)});
  if (scenario->operation == Operation::dark)
    out.warnings.push_back({scenario->place, remark(RemarkId::dark_operation)});
  for (const Remark& one : out.state.warnings) out.warnings.push_back({scenario->place, one});
  out.seed = options.seed;
  out.place_unknown = options.place_unknown;
  out.scene_hash = scene->content_hash;
  progress("inspecting the scene", 0);
  if (auto ok = inspected(scene, scenario.value(), options.threads, out); !ok) return ok.problem();
  out.levels = plan_levels(*scene, scenario.value());
  if (auto ok = assess_by_codes(*scene, scenario.value(), options, progress, out); !ok)
    return ok.problem();
  const AssessOptions each = options.one_of(1 + options.smoke_factors.size());
  if (options.reality)
    if (auto ok = assess_sights(*scene, scenario.value(), {}, each, interrupt, progress, out); !ok)
      return ok.problem();
  for (const double factor : options.smoke_factors) {
    Assessment at_density;
    if (auto ok = assess_sights(*scene, scenario.value(), {factor, {}, false}, each, interrupt,
                                progress, at_density);
        !ok)
      return ok.problem();
    count_sweep(factor, at_density.sights, out.sweep);
    out.paths += at_density.paths;
  }
  out.seconds = 1e-9 * static_cast<double>(clock.now() - began);
  return out;
}

}  // namespace luxodus
