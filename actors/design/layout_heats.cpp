#include "actors/design/layout_heats.hpp"

#include <algorithm>

#include "actors/design/smoke_stage.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Up to so many luminaires for each layout paths are shared: each path then chooses among them
/// all, and few of its choices are any one layout's (docs/performance/placement.md).
constexpr size_t luminaires_of_each = 12;

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

bool pays(const Heat& heat) {
  const size_t layouts = heat.members.size();
  return layouts > 1 && heat.lights->can_add() &&
         heat.lights->emitters() <= luminaires_of_each * layouts &&
         layouts * views_of(*heat.base) <= limits::heat_views;
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

std::vector<Heat> heats_of(const std::vector<JudgedLayout>& layouts, bool together) {
  std::vector<size_t> kin;
  for (size_t i = 0; i < layouts.size(); ++i)
    if (layouts[i].low_signs.size() == layouts.front().low_signs.size()) kin.push_back(i);
  std::vector<Heat> out;
  if (together) out.push_back(heat_of(layouts, kin));
  const bool shared = together && pays(out.front());
  if (!shared) out.clear();
  for (size_t i = 0; i < layouts.size(); ++i)
    if (!shared || std::find(kin.begin(), kin.end(), i) == kin.end())
      out.push_back(heat_of(layouts, {i}));
  return out;
}

}  // namespace luxodus
