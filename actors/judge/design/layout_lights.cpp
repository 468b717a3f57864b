#include "actors/judge/design/layout_lights.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

namespace luxodus {

namespace {

/// Position, rotation and aim that a layout gives a luminaire; none if it is where the scene has
/// it.
using LuminairePose = std::optional<std::array<double, 7>>;

/// Identifies luminaires across layouts. Names of new luminaires are not used, since each layout
/// numbers its own.
using LuminaireKey = std::tuple<std::string, size_t, LuminairePose>;

LuminaireKey key_of(const Emitter& emitter, const PlacedLayout& layout) {
  const auto placed =
      std::find_if(layout.luminaires.begin(), layout.luminaires.end(),
                   [&](const auto& one) { return one.is_placed() && one.name == emitter.name; });
  if (placed == layout.luminaires.end())
    return {emitter.name, LuminaireCandidate::existing, std::nullopt};
  const LuminaireCandidate& one = placed->candidate;
  const glm::dvec3 p = one.position, aim = one.aim.value_or(glm::dvec3(0));
  return {placed->is_new() ? "" : emitter.name, one.type,
          std::array{p.x, p.y, p.z, one.rotation_deg, aim.x, aim.y, aim.z}};
}

/// A name that is unique among the luminaires of all layouts.
std::string name_of(const LuminaireKey& key, size_t number) {
  const auto& [name, type, pose] = key;
  if (!pose) return name;
  return (name.empty() ? "new" : name + ", moved") + " " + std::to_string(number);
}

}  // namespace

LayoutLights::LayoutLights(const std::vector<LayoutLight>& layouts) {
  std::map<LuminaireKey, size_t> known;
  for (size_t i = 0; i < layouts.size(); ++i) {
    sign_factors_.push_back(layouts[i].sign_factor);
    const PlacedLayout& layout = *layouts[i].layout;
    for (const Emitter& emitter : layout.variant->emitters) {
      const LuminaireKey key = key_of(emitter, layout);
      const auto [at, fresh] = known.insert({key, emitters_.size()});
      if (fresh) {
        emitters_.push_back(emitter);
        emitters_.back().name = name_of(key, at->second);
        has_.emplace_back(layouts.size(), false);
      }
      has_[at->second][i] = true;
    }
  }
}

bool LayoutLights::varies(size_t emitter) const {
  return std::find(has_[emitter].begin(), has_[emitter].end(), false) != has_[emitter].end();
}

size_t LayoutLights::varying() const {
  size_t count = 0;
  for (size_t i = 0; i < emitters_.size(); ++i) count += varies(i);
  return count;
}

bool LayoutLights::can_add() const {
  for (size_t i = 0; i < emitters_.size(); ++i)
    if (!emitters_[i].body_material.empty() && varies(i)) return false;
  return true;
}

Result<JudgedScene> LayoutLights::judged(const SceneDescription& scene, const Scenario& scenario,
                                         const OtherSmoke& smoke) const {
  SceneDescription all = scene;
  all.emitters = emitters_;
  auto out = judged_scene(all, scenario, smoke);
  if (!out) return out.problem();
  std::map<std::pair<std::string, std::vector<bool>>, std::string> groups;
  out->lights.assign(layouts(), {});
  const GroupMixture renewal = out->ageing.renewal();
  for (size_t i = 0; i < emitters_.size(); ++i) {
    std::string& group = out->scene.emitters[i].group;
    const std::string ageing = group;
    const auto [at, fresh] =
        groups.insert({{ageing, has_[i]}, "luminaires " + std::to_string(groups.size())});
    group = at->second;
    for (size_t light = 0; fresh && light < layouts(); ++light) {
      const double there = has_[i][light] ? 1 : 0;
      out->lights[light].aged.factors[group] = there;
      out->lights[light].as_new.factors[group] = there * renewal.factor_of(ageing);
    }
  }
  scale_signs(out.value(), sign_factors_);
  return out;
}

}  // namespace luxodus
