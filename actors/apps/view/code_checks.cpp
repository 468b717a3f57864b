#include "actors/apps/view/code_checks.hpp"

#include <algorithm>

#include "actors/judge/assess/code_mode.hpp"
#include "actors/judge/texts/texts.hpp"
#include "runtime/core/clock.hpp"

namespace luxodus {

namespace {

/// The worst are listed, if there are more.
constexpr size_t max_listed = 500;

/// Failures first, then what was not made, then what passes; within each the smallest margin first.
int rank_of(CheckVerdict verdict) {
  switch (verdict) {
    case CheckVerdict::fail:
      return 0;
    case CheckVerdict::not_verified:
      return 1;
    case CheckVerdict::not_assessed:
      return 2;
    case CheckVerdict::pass:
      return 3;
    case CheckVerdict::information:
      return 4;
  }
  return 4;
}

bool comes_before(const Check& a, const Check& b) {
  if (a.verdict != b.verdict) return rank_of(a.verdict) < rank_of(b.verdict);
  return a.margin().value_or(1e9) < b.margin().value_or(1e9);
}

Json row_json(const Check& check) {
  const Texts& t = english();
  const std::string rule(name_of(check.rule.id));
  return {{"rule", rule},
          {"title", t.rule_title(rule)},
          {"clause", check.rule.edition + " " + t.clause(check.rule)},
          {"subject", t.subject(check.subject)},
          {"conditions", t.remarks(check.conditions)},
          {"verdict", name_of(check.verdict)},
          {"value", optional_json(check.value)},
          {"limit", optional_json(check.limit)},
          {"at_least", check.at_least},
          {"unit", check.unit},
          {"margin", optional_json(check.margin())},
          {"place", check.worst ? vector_json(*check.worst) : Json()},
          {"reasons", t.remarks(check.reasons)}};
}

Json counts_json(const std::vector<Check>& checks) {
  Json out = Json::object();
  const CheckCounts counts = counts_of(checks);
  for (size_t i = 0; i < check_verdicts; ++i)
    if (counts[i] > 0) out[name_of(static_cast<CheckVerdict>(i))] = counts[i];
  return out;
}

}  // namespace

Result<Json> code_checks(const SceneDescription& scene, const SceneEdits& edits,
                         const LiveDimming& dimming, const LiveOptions& options) {
  if (scene.packed)
    return problem("a pack has no triangles to check: view the scene that it was made of");
  if (scene.routes.empty() && scene.open_areas.empty() && scene.task_areas.empty())
    return problem("there is nothing to check: add [[route]], [[open_area]] or [[task_area]]");
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  const auto now = dimmed_description(scene, edits, dimming.factors);
  if (!now) return now.problem();
  auto scenario = find_scenario(now.value(), edits.scenario);
  if (!scenario) return scenario.problem();
  if (dimming.seconds) {
    scenario->seconds_after_failure = *dimming.seconds;
    scenario->says_seconds = true;
  }
  const auto codes = judged_codes(now.value(), {}, {});
  if (!codes) return codes.problem();
  auto checks = checks_by_codes(now.value(), scenario.value(), codes.value(), options.threads);
  if (!checks) return checks.problem();
  std::stable_sort(checks->begin(), checks->end(), comes_before);
  Json rows = Json::array();
  for (size_t i = 0; i < std::min(checks->size(), max_listed); ++i)
    rows.push_back(row_json(checks.value()[i]));
  return Json{{"type", "checks"},
              {"rows", std::move(rows)},
              {"counts", counts_json(checks.value())},
              {"words", words_of(counts_of(checks.value()))},
              {"seconds", 1e-9 * static_cast<double>(clock.now() - began)}};
}

}  // namespace luxodus
