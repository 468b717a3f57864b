#include "scenes/transport/emitter_choice.hpp"

#include <algorithm>

#include "scenes/transport/glow_guide.hpp"

namespace luxodus {

namespace {

Vec3 centre_of(const CompiledEmitter& e) {
  return e.kind == EmitterKind::mesh ? e.corners[0] : e.origin;
}

}  // namespace

EmitterChoice::EmitterChoice(const CompiledScene& scene) : scene_(scene) {
  for (const CompiledEmitter& e : scene.emitters) seen_power_.push_back(power_seen(scene, e));
}

/// In proportion to power times weight(emitter), of each that sends light in more than one
/// direction. Returns the sum.
template <class WeightOf>
double EmitterChoice::weigh(Cumulative& cumulative, int band, WeightOf&& weight) const {
  cumulative.resize(scene_.emitters.size());
  double total = 0;
  for (size_t i = 0; i < cumulative.size(); ++i) {
    const CompiledEmitter& e = scene_.emitters[i];
    const double in_band =
        band == all_bands ? seen_power_[i] : e.power_w[static_cast<size_t>(band)];
    const double power = e.distribution == Distribution::collimated ? 0 : in_band;
    if (power > 0) total += power * weight(e);
    cumulative[i] = total;
  }
  return total;
}

bool EmitterChoice::weigh_at(const Vec3& place, int band) {
  const bool few = scene_.emitters.size() <= limits::nearby_emitters;
  const Real least = 1e-9_r * scene_.diagonal_m * scene_.diagonal_m;
  const double total = weigh(at_, band, [&](const CompiledEmitter& e) {
    if (!few) return 1.0;
    const Vec3 d = centre_of(e) - place;
    return 1 / static_cast<double>(glm::dot(d, d) + 0.25_r * glm::dot(e.size, e.size) + least);
  });
  return total > 0;
}

bool EmitterChoice::weigh_along(const Ray& ray, Real end, int band) {
  const bool few = scene_.emitters.size() <= limits::nearby_emitters;
  bool near = !few;
  const double total = weigh(along_, band, [&](const CompiledEmitter& e) {
    if (!few) return 1.0;
    const Vec3 from_origin = centre_of(e) - ray.origin;
    const Real t = glm::clamp(glm::dot(from_origin, ray.direction), 0.0_r, end);
    const Real distance = glm::length(from_origin - ray.direction * t);
    const Real half = 0.5_r * glm::length(e.size);
    near |= distance < limits::near_line * end + half;
    const Real least = distance + half + 1e-4_r * end;
    return static_cast<double>(end / (least * (least + end / 3)));
  });
  return near && total > 0;
}

EmitterSample EmitterChoice::choose(const Cumulative& cumulative, double u) {
  const double wanted = u * cumulative.back();
  const auto at =
      std::upper_bound(cumulative.begin(), cumulative.end(), wanted) - cumulative.begin();
  const size_t chosen = std::min(static_cast<size_t>(at), cumulative.size() - 1);
  return {chosen, share_of(chosen, cumulative)};
}

double EmitterChoice::share_of(size_t emitter, const Cumulative& cumulative) {
  const double before = emitter > 0 ? cumulative[emitter - 1] : 0;
  return (cumulative[emitter] - before) / cumulative.back();
}

}  // namespace luxodus
