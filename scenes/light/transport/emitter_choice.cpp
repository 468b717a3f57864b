#include "scenes/light/transport/emitter_choice.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/transport/glow_guide.hpp"

namespace luxodus {

namespace {

Vec3 centre_of(const CompiledEmitter& e) {
  return e.kind == EmitterKind::mesh ? e.corners[0] : e.origin;
}

}  // namespace

EmitterChoice::EmitterChoice(const CompiledScene& scene) : scene_(scene) {
  double sum = 0;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const CompiledEmitter& e = scene.emitters[i];
    seen_power_.push_back(e.wanted * power_seen(scene, e));
    const EmitterBound bound = emitter_bound(scene, i);
    bounds_.add(bound.centre, bound.radius);
    if (e.distribution != Distribution::collimated) sum += seen_power_.back();
    by_power_.push_back(sum);
  }
  if (scene.emitters.size() <= limits::nearby_emitters) set_side_by_side();
}

void EmitterChoice::set_side_by_side() {
  for (const CompiledEmitter& e : scene_.emitters) {
    const Vec3 centre = centre_of(e);
    few_.x.push_back(centre.x);
    few_.y.push_back(centre.y);
    few_.z.push_back(centre.z);
    few_.half_size.push_back(0.5_r * glm::length(e.size));
    few_.quarter_square.push_back(0.25_r * glm::dot(e.size, e.size));
  }
  for (int band = 0; band <= scene_.bands.count(); ++band) {
    std::vector<double>& power = few_.power.emplace_back();
    for (size_t i = 0; i < scene_.emitters.size(); ++i)
      power.push_back(power_of(i, band < scene_.bands.count() ? band : all_bands));
  }
}

bool EmitterChoice::weigh_powers(Cumulative& cumulative, int band) const {
  cumulative.resize(scene_.emitters.size());
  double total = 0;
  for (size_t i = 0; i < cumulative.size(); ++i) {
    total += power_of(i, band);
    cumulative[i] = total;
  }
  return total > 0;
}

/// Weights the cell's bright emitters at the place: by their distances to it, and only those in
/// front of the surface.
bool EmitterChoice::weigh_bright(const Vec3& place, const Vec3& normal, int band) {
  at_.resize(seen_->bright.size());
  const bool surface = normal != Vec3(0);
  double total = 0;
  for (size_t i = 0; i < at_.size(); ++i) {
    const uint32_t emitter = seen_->bright[i].emitter;
    const Vec3 way = bounds_.centre(emitter) - place;
    const Real radius = bounds_.radius(emitter);
    const Real square = glm::dot(way, way) + radius * radius;
    double weight = seen_->bright[i].arriving / static_cast<double>(square);
    if (surface) {
      // Its top may be above the horizon even if its centre is not.
      const Real height = std::max(0.0_r, glm::dot(way, normal) + radius);
      weight *= static_cast<double>(height / std::sqrt(square));
    }
    total += weight * (band == all_bands
                           ? seen_power_[emitter]
                           : scene_.emitters[emitter].wanted *
                                 scene_.emitters[emitter].power_w[static_cast<size_t>(band)]);
    at_[i] = total;
  }
  bright_ = total > 0 ? limits::bright_choice : 0;
  return by_power_.back() > 0;
}

bool EmitterChoice::weigh_at(const Vec3& place, const Vec3& normal, int band,
                             const CellSight* seen) {
  seen_ = seen;
  if (seen != nullptr) return weigh_bright(place, normal, band);
  return has_few() ? weigh_few_at(place, band) : weigh_powers(at_, band);
}

bool EmitterChoice::weigh_few_at(const Vec3& place, int band) {
  const size_t count = few_.x.size();
  const Real least = 1e-9_r * scene_.diagonal_m * scene_.diagonal_m;
  const Real *x = few_.x.data(), *y = few_.y.data(), *z = few_.z.data(),
             *size = few_.quarter_square.data();
  const double* power = few_.power_in(band);
  at_.resize(count);
  double* const weight = at_.data();
  for (size_t i = 0; i < count; ++i) {
    const Real dx = x[i] - place.x, dy = y[i] - place.y, dz = z[i] - place.z;
    const Real square = dx * dx + dy * dy + dz * dz + size[i] + least;
    weight[i] = power[i] * (1 / static_cast<double>(square));
  }
  double total = 0;
  for (size_t i = 0; i < count; ++i) weight[i] = total += weight[i];
  return total > 0;
}

bool EmitterChoice::weigh_along(const Ray& ray, Real end, int band) {
  near_alone_ = false;
  return has_few() ? weigh_few_along(ray, end, band) : weigh_powers(along_, band);
}

bool EmitterChoice::weigh_few_along(const Ray& ray, Real end, int band) {
  const size_t count = few_.x.size();
  const Vec3 o = ray.origin, d = ray.direction;
  const Real reach = limits::near_line * end;
  weight_.resize(count);
  is_near_.resize(count);
  const Real *x = few_.x.data(), *y = few_.y.data(), *z = few_.z.data(),
             *half = few_.half_size.data();
  Real* const weight = weight_.data();
  int32_t* const is_near = is_near_.data();
#pragma GCC ivdep
  for (size_t i = 0; i < count; ++i) {
    const Real fx = x[i] - o.x, fy = y[i] - o.y, fz = z[i] - o.z;
    Real t = fx * d.x + fy * d.y + fz * d.z;
    t = t < 0 ? 0 : t;
    t = end < t ? end : t;
    const Real px = fx - d.x * t, py = fy - d.y * t, pz = fz - d.z * t;
    const Real distance = std::sqrt(px * px + py * py + pz * pz);
    is_near[i] = distance < reach + half[i];
    weight[i] = seen_along(distance, half[i], end);
  }
  const double* power = few_.power_in(band);
  along_.resize(count);
  bool near = false;
  double total = 0;
  for (size_t i = 0; i < count; ++i) {
    near |= is_near[i] != 0 && power[i] > 0;
    along_[i] = total += power[i] * static_cast<double>(weight[i]);
  }
  return near && total > 0;
}

EmitterSample EmitterChoice::choose_along(double u) const {
  const EmitterSample chosen = choose(along_, u);
  return near_alone_ ? EmitterSample{near_[chosen.emitter], chosen.probability} : chosen;
}

double EmitterChoice::probability_along(size_t emitter) const {
  if (!near_alone_) return share_of(emitter, along_);
  for (size_t i = 0; i < near_.size(); ++i)
    if (near_[i] == emitter) return share_of(i, along_);
  return 0;
}

EmitterSample EmitterChoice::choose_at(double u) const {
  if (seen_ == nullptr) return choose(at_, u);
  size_t emitter = 0;
  if (u < bright_) {
    emitter = seen_->bright[choose(at_, u / bright_).emitter].emitter;
  } else if (u = (u - bright_) / (1 - bright_); u < seen_->by_cell) {
    const auto at = std::upper_bound(seen_->cumulative.begin(), seen_->cumulative.end(),
                                     static_cast<float>(u / seen_->by_cell)) -
                    seen_->cumulative.begin();
    emitter = seen_->asked[std::min(static_cast<size_t>(at), seen_->asked.size() - 1)];
  } else {
    emitter = choose(by_power_, std::min(1.0, (u - seen_->by_cell) / (1 - seen_->by_cell))).emitter;
  }
  return {emitter, probability_at(emitter)};
}

double EmitterChoice::probability_at(size_t emitter) const {
  if (seen_ == nullptr) return share_of(emitter, at_);
  double other = (1 - seen_->by_cell) * share_of(emitter, by_power_);
  const auto asked = std::lower_bound(seen_->asked.begin(), seen_->asked.end(), emitter);
  if (asked != seen_->asked.end() && *asked == emitter) {
    const auto i = static_cast<size_t>(asked - seen_->asked.begin());
    const auto before = i > 0 ? static_cast<double>(seen_->cumulative[i - 1]) : 0.0;
    other += seen_->by_cell * (static_cast<double>(seen_->cumulative[i]) - before);
  }
  double probability = (1 - bright_) * other;
  if (!(bright_ > 0)) return probability;
  for (size_t i = 0; i < at_.size(); ++i)
    if (seen_->bright[i].emitter == emitter) probability += bright_ * share_of(i, at_);
  return probability;
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
