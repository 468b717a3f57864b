#include "actors/judge/design/layout_heats.hpp"

#include "actors/judge/design/smoke_stage.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Luminaires that only some layouts of a heat have, at most. Of more than 256 emitters paths
/// choose by power alone (limits::nearby_emitters), and those of one layout are seldom near: what
/// is left of that is for the building's own.
constexpr size_t varying_luminaires = 200;

size_t views_of(const SceneDescription& scene) {
  size_t places = 0;
  for (const EscapeRoute& route : scene.routes)
    places += walkers(route, scene.assessment.spacing_m).size();
  return places * scene.assessment.eye_heights_m.size() * scene.signs.size();
}

Heat heat_of(const std::vector<JudgedLayout>& layouts, std::vector<size_t> members) {
  const JudgedLayout& first = layouts[members.front()];
  std::vector<LayoutLight> lights;
  for (const size_t i : members)
    lights.push_back({&layouts[i].layout, layouts[i].sign_factor / first.sign_factor});
  return {std::move(members), first.layout.variant, std::make_unique<LayoutLights>(lights)};
}

/// The states of all scenarios are kept at once.
bool pays(const Heat& heat, size_t scenarios) {
  return heat.lights->can_add() && heat.lights->varying() <= varying_luminaires &&
         heat.members.size() * scenarios * views_of(*heat.base) <= limits::heat_views;
}

/// The layout joins the first heat of its kind where paths can be shared; else it has a new one.
void join(const std::vector<JudgedLayout>& layouts, size_t layout, size_t scenarios,
          std::vector<Heat>& heats) {
  for (Heat& heat : heats) {
    if (layouts[heat.members.front()].low_signs.size() != layouts[layout].low_signs.size())
      continue;
    std::vector<size_t> members = heat.members;
    members.push_back(layout);
    Heat larger = heat_of(layouts, std::move(members));
    if (!pays(larger, scenarios)) continue;
    heat = std::move(larger);
    return;
  }
  heats.push_back(heat_of(layouts, {layout}));
}

}  // namespace

Result<std::unique_ptr<HeatState>> HeatState::make(const LayoutLights& lights,
                                                   const SceneDescription& scene,
                                                   const Scenario& scenario,
                                                   const AssessOptions& options,
                                                   const AssessProgress& progress) {
  auto judged = lights.judged(scene, scenario, {});
  if (!judged) return judged.problem();
  std::unique_ptr<HeatState> out(new HeatState(std::move(judged).value(), options));
  if (auto ok = out->sights_.look_for_lines(progress); !ok) return ok.problem();
  return out;
}

std::vector<Heat> heats_of(const std::vector<JudgedLayout>& layouts, size_t scenarios,
                           bool together) {
  std::vector<Heat> out;
  for (size_t i = 0; i < layouts.size(); ++i)
    if (together)
      join(layouts, i, scenarios, out);
    else
      out.push_back(heat_of(layouts, {i}));
  return out;
}

}  // namespace luxodus
