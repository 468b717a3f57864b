#include "scenes/light/transport/glow_guide.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/optics/sampling.hpp"
#include "scenes/light/transport/emitter_sight.hpp"

namespace luxodus {

namespace {

/// Least sine of the angle off an axis: smaller ones are raised to it, since the density is
/// unbounded on the axis.
constexpr Real min_sine = 1e-6_r;
/// Least distance from a sphere's centre, relative to its radius: nearer, the direction to the
/// centre is undefined.
constexpr Real min_distance = 1e-3_r;

}  // namespace

GlowGuide::GlowGuide(std::vector<Glow> glows, bool mirrors)
    : by_emitter_(std::move(glows)), mirrors_(mirrors) {
  for (uint32_t i = 0; i < by_emitter_.size(); ++i)
    if (by_emitter_[i].share > 0) brightest_.push_back(i);
  const auto light = [&](uint32_t i) { return by_emitter_[i].power * by_emitter_[i].share; };
  std::stable_sort(brightest_.begin(), brightest_.end(),
                   [&](uint32_t a, uint32_t b) { return light(a) > light(b); });
  brightest_.resize(std::min(brightest_.size(), limits::glows));
}

void GlowGuide::stand_at(const Vec3& place, const CellSight* seen, CachedLight cached) {
  cones_.clear();
  aimed_ = 0;
  if (!aims_ || empty()) return;
  double light = 0;
  if (seen != nullptr) {
    for (const CellSight::Bright& b : seen->bright)
      light += weigh(by_emitter_[b.emitter], place, b.glowing, cached);
    std::erase_if(cones_, [&](const Cone& c) { return c.share < limits::min_glow_seen * light; });
    for (const EmitterImage& image : seen->images) light += weigh(image, place);
  } else {
    for (const uint32_t emitter : brightest_)
      light += weigh(by_emitter_[emitter], place, 1, cached);
  }
  for (Cone& cone : cones_) {
    cone.share *= limits::max_aimed / light;
    aimed_ += cone.share;
  }
}

double GlowGuide::weigh(const Glow& glow, const Vec3& place, double arriving, CachedLight cached) {
  const Vec3 way = glow.centre - place;
  const Real square = glm::dot(way, way);
  const Real reach = glow.radius * glow.radius;
  const double light = arriving * glow.power / static_cast<double>(std::max(square, reach));
  // Lines that start beside an extended emitter meet its light from all directions.
  const Real least = std::max(glow.body, min_distance * glow.radius);
  const double share = cached == CachedLight::nothing ? glow.share : glow.reflected;
  if (square > least * least && share > 0) {
    const Real slope = std::min(limits::widest_slope, std::sqrt(reach / square));
    cones_.push_back({way / std::sqrt(square), slope, light * share});
  }
  return light;
}

double GlowGuide::weigh(const EmitterImage& image, const Vec3& place) {
  const Vec3 way = image.centre - place;
  const Real distance = glm::length(way);
  if (!(distance > image.radius)) return 0;
  const double light = image.worth / static_cast<double>(distance * distance);
  cones_.push_back({way / distance, image.radius / distance, light});
  return light;
}

/// A line that passes an emitter in smoke at a distance sees light in proportion to one over that
/// distance, so lines are sampled uniformly in the distance.
Vec3 GlowGuide::direction(double choice, Real u, Real v) const {
  double rest = choice;
  size_t i = 0;
  while (i + 1 < cones_.size() && rest >= cones_[i].share) rest -= cones_[i++].share;
  const Real aside = u * cones_[i].slope;
  const SinCos turn = sin_cos_two_pi(v);
  return to_world(cones_[i].axis, glm::normalize(Vec3(aside * turn.cos, aside * turn.sin, 1)));
}

double GlowGuide::density(const Vec3& direction, double own) const {
  double sum = (1 - aimed_) * own;
  for (const Cone& cone : cones_) {
    const Real cosine = glm::dot(direction, cone.axis);
    if (cosine <= 0) continue;
    const Real sine = std::max(min_sine, glm::length(direction - cosine * cone.axis));
    if (sine > cosine * cone.slope) continue;
    sum += cone.share / (2 * static_cast<double>(pi_f * cone.slope * cosine * cosine * sine));
  }
  return sum;
}

Real glow_reach_m(const CompiledScene& scene) {
  return scene.voxels.edge > 0 ? Real{scene.voxels.edge} : 0.02_r * scene.diagonal_m;
}

Vec3 before_face(const CompiledScene& scene, uint32_t emitter, Real glow_radius) {
  return emitter_bound(scene, emitter).centre -
         scene.emitters[emitter].axes[2] * (0.5_r * glow_radius);
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

}  // namespace luxodus
