#include "scenes/light/transport/emitter_sight.hpp"

namespace luxodus {

namespace {

/// Memory of a cell with all sides learned, pointers included [bytes]. An allocation takes somewhat
/// more than requested.
uint64_t bytes_of_cell(const CompiledScene& scene) {
  constexpr uint64_t allocations = 5, of_allocation = 16;
  const uint64_t emitters = scene.emitters.size();
  const uint64_t images = aims_at_mirrors(scene) ? limits::emitter_images : 0;
  const uint64_t asked = std::min<uint64_t>(emitters, limits::asked_emitters);
  const uint64_t bright = std::min<uint64_t>(emitters, limits::bright_emitters);
  return cell_sides * (sizeof(void*) + sizeof(CellSight) + allocations * of_allocation +
                       asked * (sizeof(uint32_t) + sizeof(float)) +
                       bright * sizeof(CellSight::Bright) + images * sizeof(EmitterImage));
}

CellGrid grid_of(const CompiledScene& scene) {
  const uint64_t affordable = limits::sight_bytes / bytes_of_cell(scene);
  return {scene, std::min(limits::learned_cells, static_cast<int64_t>(affordable))};
}

}  // namespace

uint64_t EmitterSight::max_bytes(const CompiledScene& scene) {
  return grid_of(scene).count() * bytes_of_cell(scene);
}

EmitterSight::EmitterSight(const CompiledScene& scene)
    : scene_(scene), cells_(grid_of(scene), cell_sides) {
  for (int b = 0; b < scene.bands.count(); ++b)
    if (scene.bands[b].lm_per_w > scene.bands[band_].lm_per_w) band_ = b;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const bool spreads = scene.emitters[i].distribution != Distribution::collimated;
    power_.push_back(spreads ? power_seen(scene, scene.emitters[i]) : 0);
    bounds_.push_back(emitter_bound(scene, i));
  }
}

std::vector<EmitterSight::Asked> EmitterSight::candidates(const Vec3& middle) const {
  std::vector<Asked> out;
  for (uint32_t i = 0; i < power_.size(); ++i) {
    if (!(power_[i] > 0)) continue;
    const Vec3 d = bounds_[i].centre - middle;
    const double square =
        static_cast<double>(glm::dot(d, d) + bounds_[i].radius * bounds_[i].radius +
                            0.25_r * cells_.grid().edge() * cells_.grid().edge());
    out.push_back({i, power_[i] / square});
  }
  if (out.size() > limits::asked_emitters) {
    const auto brighter = [](const Asked& a, const Asked& b) {
      return a.over_square != b.over_square ? a.over_square > b.over_square : a.emitter < b.emitter;
    };
    std::nth_element(out.begin(), out.begin() + limits::asked_emitters, out.end(), brighter);
    out.resize(limits::asked_emitters);
    std::sort(out.begin(), out.end(),
              [](const Asked& a, const Asked& b) { return a.emitter < b.emitter; });
  }
  return out;
}

Vec3 EmitterSight::glow_place(uint32_t emitter) const {
  return before_face(scene_, emitter, bounds_[emitter].radius + glow_reach_m(scene_));
}

CellSight EmitterSight::conclude(std::vector<Asked> asked) const {
  CellSight out;
  double sum = 0;
  for (const Asked& a : asked) sum += a.light(a.arriving);
  if (!(sum > 0)) {  // no light arrives: emitters are chosen by their power
    out.by_cell = 0;
    return out;
  }
  std::vector<Asked> bright;
  double so_far = 0;
  out.asked.reserve(asked.size());
  out.cumulative.reserve(asked.size());
  for (const Asked& a : asked) {
    so_far += a.light(a.arriving);
    out.asked.push_back(a.emitter);
    out.cumulative.push_back(static_cast<float>(so_far / sum));
    if (a.light(a.arriving) > limits::bright_share * sum ||
        a.light(a.glowing) > limits::min_glow_seen * sum)
      bright.push_back(a);
  }
  out.cumulative.back() = 1;
  if (bright.size() > limits::bright_emitters) {
    std::stable_sort(bright.begin(), bright.end(), [](const Asked& a, const Asked& b) {
      return a.light(a.glowing) > b.light(b.glowing);
    });
    bright.resize(limits::bright_emitters);
    std::sort(bright.begin(), bright.end(),
              [](const Asked& a, const Asked& b) { return a.emitter < b.emitter; });
  }
  out.bright.reserve(bright.size());
  for (const Asked& a : bright) out.bright.push_back({a.emitter, a.arriving, a.glowing});
  out.by_cell = limits::cell_choice;
  return out;
}

}  // namespace luxodus
