#include "actors/judge/design/suggest.hpp"

#include <algorithm>
#include <map>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/design/demands.hpp"

namespace luxodus {

namespace {

/// Stop within this gap: proving one luminaire fewer is not worth a user's waiting.
constexpr double gap_of_suggestion = 0.05;
constexpr int quick_rounds = 50;
/// Smaller contributions are left out.
constexpr double min_help = 1e-4;

/// Existing luminaires are fixed; types that can be copied by name may be added.
Result<DesignSettings> settings_of(const SceneDescription& scene) {
  DesignSettings out = *scene.design;
  out.existing = ExistingTreatment::fixed;
  out.fixed.clear();
  out.movable.clear();
  out.removable.clear();
  out.removed.clear();
  out.objective = DesignObjective::number;
  std::erase_if(out.types, [](const DesignType& type) { return type.like.empty(); });
  if (out.types.empty())
    return problem_in(scene.file,
                      "there is no emergency luminaire of which copies could be added: a type of "
                      "[design] that is 'like' one of the scene would do");
  return out;
}

Layout what_stands(const LayoutProblem& problem) {
  Layout out(problem.options.size(), 0);
  for (size_t i = 0; i < out.size(); ++i) out[i] = problem.options[i].fixed ? 1 : 0;
  return out;
}

/// Sets the share of violated rows, and the least share of a requirement.
void fill_missing(const LayoutProblem& problem, const Layout& layout, Suggestion& out) {
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  sums.set(layout);
  const auto violations = sums.violations();
  size_t rows = problem.covers.size() + problem.spreads.size();
  for (const FailureRows& failure : problem.failures) rows += failure.points.size();
  out.least = 1;
  for (const Violation& v : violations) out.least = std::min(out.least, v.share);
  if (rows > 0) out.missing = static_cast<double>(violations.size()) / static_cast<double>(rows);
}

}  // namespace

std::vector<std::pair<uint32_t, double>> helpful_places(const LayoutProblem& problem,
                                                        const Layout& layout) {
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  sums.set(layout);
  double missing = 0;
  for (size_t row = 0; row < problem.covers.size(); ++row)
    missing += std::max(0.0, 1 - sums.cover(row));
  std::map<uint32_t, double> best;
  if (!(missing > 0)) return {};
  for (uint32_t i = 0; i < problem.options.size(); ++i) {
    if (problem.options[i].fixed || layout[i] != 0) continue;
    double helps = 0;
    for (const auto& entry : index.covers(i))
      helps += std::min(static_cast<double>(entry.value), std::max(0.0, 1 - sums.cover(entry.row)));
    double& of_place = best[problem.options[i].place];
    of_place = std::max(of_place, std::min(1.0, helps / missing));
  }
  return {best.begin(), best.end()};
}

Result<Suggestion> suggest(const std::shared_ptr<const SceneDescription>& scene,
                           const SuggestOptions& options, const std::atomic<bool>& interrupt) {
  if (!scene->design || scene->packed)
    return problem_in(scene->file, "a pack has no [design]: view the scene that it was made of");
  if (scene->routes.empty() && scene->open_areas.empty() && scene->task_areas.empty())
    return problem_in(scene->file,
                      "there is nothing to light: add [[route]], [[open_area]] or [[task_area]]");
  const auto scenario = judged_scenario(*scene, "");
  if (!scenario) return scenario.problem();
  const auto codes = judged_codes(*scene, {}, {});
  if (!codes) return codes.problem();
  const SceneDescription switched = as_switched(*scene, scenario.value());
  const auto design = settings_of(switched);
  if (!design) return design.problem();
  auto candidates =
      find_candidates(switched, design.value(), codes.value(), scenario.value(), options.threads);
  if (!candidates) return candidates.problem();
  // A copy is defined by its position and aim, so candidates with a rotation are removed.
  std::erase_if(candidates->all, [](const LuminaireCandidate& one) {
    return one.type != LuminaireCandidate::existing && one.rotation_deg != 0;
  });
  const auto demands = Demands::make(switched, design.value(), candidates->all, codes.value(),
                                     scenario.value(), options.threads);
  if (!demands) return demands.problem();
  const LayoutProblem& problem = demands.value()->problem();
  Suggestion out;
  const Layout now = what_stands(problem);
  fill_missing(problem, now, out);
  std::map<uint32_t, glm::dvec3> place_of;
  for (const LuminaireCandidate& one : candidates->all) place_of[one.place] = one.position;
  for (const auto& [place, share] : helpful_places(problem, now))
    if (share > min_help) out.helpful.push_back({place_of[place], share});
  SolveSettings settings;
  settings.seconds = options.seconds;
  settings.gap = gap_of_suggestion;
  settings.greedy_rounds = quick_rounds;
  const LayoutAnswer answer =
      solve_layout(problem, settings, interrupt, [](const std::string&, double, double) {});
  out.end = answer.end;
  out.bound = answer.bound;  // existing luminaires weigh nothing
  for (size_t i = 0; i < answer.layout.size(); ++i) {
    const LuminaireCandidate& one = candidates->all[i];
    if (answer.layout[i] == 0 || one.type == LuminaireCandidate::existing) continue;
    out.luminaires.push_back(
        {design->types[one.type].like, one.position, one.aim.value_or(glm::dvec3(0, 0, -1))});
  }
  return out;
}

}  // namespace luxodus
