#include "scenes/light/transport/flame_moment.hpp"

namespace luxodus {

namespace {

/// Below it a flame hides all, and its mean is kept: the ratio of transmittances has no digits.
constexpr double least_transmittance = 1e-9;

/// Whether the scenario leaves the medium a flame.
bool is_flame(const CompiledScene& scene, int medium) {
  return std::any_of(scene.emitters.begin(), scene.emitters.end(), [&](const CompiledEmitter& e) {
    return e.kind == EmitterKind::volume && e.medium == static_cast<uint32_t>(medium);
  });
}

}  // namespace

std::vector<SteadyFlame> steady_flames(const CompiledScene& scene) {
  std::vector<SteadyFlame> out;
  const MediaTables& tables = scene.media.tables();
  for (const PlacedBody& placed : tables.bodies) {
    if (placed.quadric < 0) continue;
    const MediaComponent& component = tables.component(placed.component);
    if (component.emitter < 0 || !is_flame(scene, component.medium)) continue;
    // Seeds of a flame's fields are consecutive; those of two flames do not meet.
    out.push_back({component.medium, placed.component,
                   &tables.quadrics[static_cast<size_t>(placed.quadric)],
                   static_cast<uint32_t>(component.medium + 1) * 1009U});
  }
  return out;
}

FlameMoment::FlameMoment(const CompiledScene& scene, double time_s)
    : scene_(scene), time_s_(time_s) {
  for (const SteadyFlame& flame : steady_flames(scene))
    flames_.push_back({flame, FlameShape(*flame.body, flame.seed)});
}

void FlameMoment::meet(const Ray& ray, Real length, const PathBands& bands) {
  met_.clear();
  const glm::dvec3 o(ray.origin), d(ray.direction);
  for (const Flame& flame : flames_) {
    RayInterval parts[2];
    const int count = flame.body->intervals(o, d, {0, static_cast<double>(length)}, parts);
    if (count == 0) continue;
    double length_m = 0;
    for (int i = 0; i < count; ++i) length_m += parts[i].t1 - parts[i].t0;
    if (length_m > 0) add(flame, ray, {parts[0].t0, parts[count - 1].t1}, length_m, bands);
  }
}

void FlameMoment::add(const Flame& flame, const Ray& ray, const RayInterval& chord, double length_m,
                      const PathBands& bands) {
  Met met;
  met.medium = flame.medium;
  met.begin_m = chord.t0;
  met.end_m = chord.t1;
  const MediaTables& tables = scene_.media.tables();
  double least = 1;
  for (size_t i = 0; i < bands.count(); ++i) {
    met.behind[i] = std::exp(-tables.sigma_of(bands.band(i), flame.component) * length_m);
    least = std::min(least, met.behind[i]);
  }
  if (least < least_transmittance) return;
  met.factor = flame.shape.factor(glm::dvec3(ray.origin), glm::dvec3(ray.direction), chord,
                                  1 - least, time_s_);
  for (size_t i = 0; i < bands.count(); ++i)
    met.behind[i] = std::max(0.0, 1 - met.factor * (1 - met.behind[i])) / met.behind[i];
  met_.push_back(met);
}

double FlameMoment::on_emission(int medium, size_t i) const {
  for (const Met& met : met_)
    if (met.medium == medium) return met.factor * on_light_from(met.begin_m, i);
  return 1;
}

double FlameMoment::on_light_from(double distance_m, size_t i) const {
  double factor = 1;
  for (const Met& met : met_)
    if (met.end_m <= distance_m) factor *= met.behind[i];
  return factor;
}

}  // namespace luxodus
