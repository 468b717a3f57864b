#include "scenes/light/transport/emitter_choice.hpp"

#include <algorithm>

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
}

/// Weights each emitter that is not collimated in proportion to power times weight(emitter).
/// Returns the sum.
template <class WeightOf>
double EmitterChoice::weigh(Cumulative& cumulative, int band, WeightOf&& weight) const {
  cumulative.resize(scene_.emitters.size());
  double total = 0;
  for (size_t i = 0; i < cumulative.size(); ++i) {
    const double power = power_of(i, band);
    if (power > 0) total += power * weight(scene_.emitters[i]);
    cumulative[i] = total;
  }
  return total;
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
  near_alone_ = false;
  const bool few = scene_.emitters.size() <= limits::nearby_emitters;
  bool near = !few;
  const double total = weigh(along_, band, [&](const CompiledEmitter& e) {
    if (!few) return 1.0;
    const Vec3 from_origin = centre_of(e) - ray.origin;
    const Real t = glm::clamp(glm::dot(from_origin, ray.direction), 0.0_r, end);
    const Real distance = glm::length(from_origin - ray.direction * t);
    const Real half = 0.5_r * glm::length(e.size);
    near |= distance < limits::near_line * end + half;
    return seen_along(distance, half, end);
  });
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
