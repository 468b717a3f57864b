#include "actors/judge/assess/arriving_beside.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/emergency/veil.hpp"

namespace luxodus {

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(
      std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

GroupFactors factors_of(const CompiledScene& scene, const std::vector<GroupMixture>& mixtures) {
  GroupFactors out;
  for (const GroupMixture& mixture : mixtures) {
    auto& factors = out.emplace_back();
    for (const Group& group : scene.groups) factors.push_back(mixture.factor_of(group.name));
  }
  return out;
}

ArrivingBeside arriving_beside(const Building& building, const GeometryAccess& access,
                               const glm::dvec3& eye, const glm::dvec3& centre, uint32_t sign,
                               const std::vector<double>& ages, const GroupFactors& factors) {
  const CompiledScene& scene = building.scene();
  const glm::dvec3 gaze = glm::normalize(centre - eye);
  ArrivingBeside out;
  out.veils_cd_m2.assign(ages.size(), std::vector<double>(factors.size(), 0.0));
  for (const ArrivingLight& light :
       direct_arrivals(scene, access, building.local(eye), glm::vec3(gaze), {})) {
    const CompiledEmitter& emitter = scene.emitters[light.emitter];
    if (emitter.sign != none_index && scene.signs[emitter.sign].sign == sign) continue;
    const auto group = static_cast<size_t>(emitter.group);
    out.at_eye.lux += light.illuminance_lx * factors.front()[group];
    out.at_eye.clear_air_lux += light.clear_air_lx * factors.front()[group];
    const double away_deg = angle_deg(glm::dvec3(light.direction), gaze);
    for (size_t a = 0; a < ages.size(); ++a) {
      const double part = light.illuminance_lx * veil_per_lux(away_deg, ages[a]);
      for (size_t m = 0; m < factors.size(); ++m) out.veils_cd_m2[a][m] += part * factors[m][group];
    }
  }
  return out;
}

}  // namespace luxodus
