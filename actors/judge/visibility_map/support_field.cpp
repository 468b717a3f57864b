#include "actors/judge/visibility_map/support_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxodus {

namespace {

/// Nearer than this, a support's value counts as that of the place [m].
constexpr double same_place_m = 0.02;

double weight_of(const NearSupport& near) {
  const double distance = std::max(near.distance_m, same_place_m);
  return 1 / (distance * distance);
}

}  // namespace

void SupportField::lose(uint32_t support) {
  if (support >= values_.size()) values_.resize(support + 1);
  values_[support] = {{}, -1, false, true};
}

void SupportField::set(uint32_t support, const Uncertain& value) {
  if (support >= values_.size()) values_.resize(support + 1);
  values_[support].value = value;
  values_[support].known = true;
}

Uncertain SupportField::mean(std::span<const NearSupport> near) const {
  double weights = 0, sum = 0, variance = 0;
  for (const NearSupport& one : near) {
    if (one.support >= values_.size() || !values_[one.support].known) continue;
    const double weight = weight_of(one);
    const Uncertain& value = values_[one.support].value;
    weights += weight;
    sum += weight * value.value;
    variance += weight * weight * value.error * value.error;
  }
  if (!(weights > 0)) return {0, std::numeric_limits<double>::infinity()};
  return {sum / weights, std::sqrt(variance) / weights};
}

void SupportField::test(uint32_t support, std::span<const NearSupport> others) {
  if (support >= values_.size() || !values_[support].known) return;
  Value& tested = values_[support];
  const Uncertain expected = mean(others);
  tested.off = -1;
  if (!std::isfinite(expected.error)) return;
  const double off = tested.value.value - expected.value;
  const double noise = std::hypot(tested.value.error, expected.error);
  tested.off = std::sqrt(std::max(0.0, off * off - noise * noise));
}

Interpolated SupportField::at(std::span<const NearSupport> near) const {
  Interpolated out;
  const Uncertain between = mean(near);
  if (!std::isfinite(between.error)) return out;
  out.value = between.value;
  out.noise = between.error;
  double off = -1, low = out.value, high = out.value;
  size_t known = 0;
  for (const NearSupport& one : near) {
    if (one.support >= values_.size()) continue;
    if (values_[one.support].lost) return out;
    if (!values_[one.support].known) continue;
    const Value& value = values_[one.support];
    ++known;
    off = std::max(off, value.off);
    low = std::min(low, value.value.value);
    high = std::max(high, value.value.value);
  }
  if (known > 1 && off >= 0) out.bound = std::max(off, (high - low) / 2);
  return out;
}

}  // namespace luxodus
