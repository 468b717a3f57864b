#include "actors/judge/design/layout_groups.hpp"

#include "actors/judge/design/smoke_stage.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Largest number of luminaires that only some layouts of a group have. Above 256 emitters paths
/// choose them by power only (limits::nearby_emitters), and luminaires of one layout are rarely
/// near. The rest of the 256 is for the building's own emitters.
constexpr size_t varying_luminaires = 200;

size_t views_of(const SceneDescription& scene) {
  size_t places = 0;
  for (const EscapeRoute& route : scene.routes)
    places += walkers(route, scene.assessment.spacing_m).size();
  return places * scene.assessment.eye_heights_m.size() * scene.signs.size();
}

LayoutGroup layout_group_of(const std::vector<JudgedLayout>& layouts, std::vector<size_t> members) {
  const JudgedLayout& first = layouts[members.front()];
  std::vector<LayoutLight> lights;
  for (const size_t i : members)
    lights.push_back({&layouts[i].layout, layouts[i].sign_factor / first.sign_factor});
  return {std::move(members), first.layout.variant, std::make_unique<LayoutLights>(lights)};
}

/// Whether a group stays within the limits; the states of all scenarios are in memory at the same
/// time.
bool pays(const LayoutGroup& group, size_t scenarios) {
  return group.lights->can_add() && group.lights->varying() <= varying_luminaires &&
         group.members.size() * scenarios * views_of(*group.base) <= limits::layout_group_views;
}

/// Adds a layout to the first group with which it can share paths, or else to a new one.
void join(const std::vector<JudgedLayout>& layouts, size_t layout, size_t scenarios,
          std::vector<LayoutGroup>& groups) {
  for (LayoutGroup& group : groups) {
    if (layouts[group.members.front()].low_signs.size() != layouts[layout].low_signs.size())
      continue;
    std::vector<size_t> members = group.members;
    members.push_back(layout);
    LayoutGroup larger = layout_group_of(layouts, std::move(members));
    if (!pays(larger, scenarios)) continue;
    group = std::move(larger);
    return;
  }
  groups.push_back(layout_group_of(layouts, {layout}));
}

}  // namespace

Result<std::unique_ptr<LayoutGroupState>> LayoutGroupState::make(const LayoutLights& lights,
                                                                 const SceneDescription& scene,
                                                                 const Scenario& scenario,
                                                                 const AssessOptions& options,
                                                                 const AssessProgress& progress) {
  auto judged = lights.judged(scene, scenario, {});
  if (!judged) return judged.problem();
  std::unique_ptr<LayoutGroupState> out(new LayoutGroupState(std::move(judged).value(), options));
  if (auto ok = out->sights_.look_for_lines(progress); !ok) return ok.problem();
  return out;
}

std::vector<LayoutGroup> layout_groups_of(const std::vector<JudgedLayout>& layouts,
                                          size_t scenarios, bool together) {
  std::vector<LayoutGroup> out;
  for (size_t i = 0; i < layouts.size(); ++i)
    if (together)
      join(layouts, i, scenarios, out);
    else
      out.push_back(layout_group_of(layouts, {i}));
  return out;
}

}  // namespace luxodus
