#include "scenes/transport/glow_guide.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/optics/sampling.hpp"

namespace luxodus {

void GlowGuide::stand_at(const Vec3& place) {
  cones_.clear();
  aimed_ = 0;
  if (!aims_) return;
  double seen = 0;
  for (const Glow& g : glows_) {
    const Vec3 way = g.centre - place;
    const Real square = glm::dot(way, way);
    const Real reach = g.radius * g.radius;
    const double light = g.power / static_cast<double>(std::max(square, reach));
    seen += light;
    // In the midst of it every turn stays near.
    if (square <= reach) continue;
    // 1 - sqrt(1 - s), without cancellation for far spheres.
    const Real s = reach / square;
    cones_.push_back({way / std::sqrt(square), s / (1 + std::sqrt(1 - s)), light * g.share});
  }
  for (Cone& cone : cones_) {
    cone.share *= limits::max_aimed / seen;
    aimed_ += cone.share;
  }
}

Vec3 GlowGuide::direction(double choice, Real u, Real v) const {
  double rest = choice;
  size_t i = 0;
  while (i + 1 < cones_.size() && rest >= cones_[i].share) rest -= cones_[i++].share;
  const Cone& cone = cones_[i];
  const Real lost = u * cone.one_minus_cosine;  // 1 - cosine
  const Real sine = std::sqrt(std::max(0.0_r, lost * (2 - lost)));
  const Real angle = 2 * pi_f * v;
  return to_world(cone.axis, Vec3(sine * std::cos(angle), sine * std::sin(angle), 1 - lost));
}

double GlowGuide::density(const Vec3& direction, double own) const {
  double sum = (1 - aimed_) * own;
  for (const Cone& cone : cones_) {
    const Vec3 off = direction - cone.axis;  // its square is 2 (1 - cosine)
    if (0.5_r * glm::dot(off, off) > cone.one_minus_cosine) continue;
    sum += cone.share / (2 * static_cast<double>(pi_f * cone.one_minus_cosine));
  }
  return sum;
}

Real glow_reach_m(const CompiledScene& scene) {
  return scene.voxels.edge > 0 ? Real{scene.voxels.edge} : 0.02_r * scene.diagonal_m;
}

double power_seen(const CompiledScene& scene, const CompiledEmitter& emitter) {
  double power = 0;
  for (int b = 0; b < scene.bands.count(); ++b) {
    const Band& band = scene.bands[b];
    power +=
        emitter.power_w[static_cast<size_t>(b)] * (band.lm_per_w + band.x_per_w + band.z_per_w);
  }
  return power;
}

void keep_brightest(std::vector<Glow>& glows) {
  const auto light = [](const Glow& g) { return g.power * g.share; };
  std::stable_sort(glows.begin(), glows.end(),
                   [&](const Glow& a, const Glow& b) { return light(a) > light(b); });
  glows.resize(std::min(glows.size(), limits::glows));
}

}  // namespace luxodus
