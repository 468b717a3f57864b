#include "actors/judge/assess/reality_mode.hpp"

#include "actors/judge/assess/sights_in_lights.hpp"

namespace luxodus {

Result<void> assess_sights(const SceneDescription& scene, const Scenario& scenario,
                           const OtherSmoke& smoke, const AssessOptions& options,
                           const std::atomic<bool>& interrupt, const AssessProgress& progress,
                           Assessment& out) {
  const auto judged = judged_scene(scene, scenario, smoke);
  if (!judged) return judged.problem();
  if (auto ok = irritation_is_said(scene, judged->scenario); !ok) return ok.problem();
  SightsInLights sights(judged.value(), scene.observers, smoke, options);
  if (auto ok = sights.look_for_lines(progress); !ok) return ok.problem();
  for (int round = 0; round < options.rounds && sights.is_open(0); ++round)
    if (auto ok = sights.trace(round, {true}, interrupt, progress); !ok) return ok.problem();
  out.paths += sights.paths();
  out.sure_errors = sights.sure_errors();
  for (const SightRow& row : sights.rows(0)) out.sights.push_back(row);
  return {};
}

}  // namespace luxodus
