#include "actors/judge/visibility_map/face_light.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus {

namespace {

/// Lines that let less pass say nothing of what is beyond the face [share].
constexpr double least_passed = 1e-6;

/// The error of a value that paths estimate, at least: see limits::least_spread.
double least_error(const Uncertain& value, double paths) {
  return std::max(value.error, limits::least_spread / std::sqrt(paths) * std::abs(value.value));
}

}  // namespace

void FaceLight::read(const TracedViews& traced, const FaceOfSign& face,
                     const GroupFactors& factors) {
  for (size_t mixture = 0; mixture < factors.size(); ++mixture) {
    read_reflected(traced, mixture);
    for (uint32_t s = 0; s < supports_.size(); ++s) {
      if (!(traced.paths(supports_[s].view) > 0)) continue;
      read_glow(traced, face, factors, mixture, s);
      read_beyond(traced, mixture, s);
    }
  }
}

void FaceLight::read_reflected(const TracedViews& traced, size_t mixture) {
  std::array<Uncertain, 2> reflected{};
  double paths = 0;
  bool lost = false;
  for (const Support& support : supports_) {
    lost = lost || traced.is_face_lost(support.view);
    const double more = traced.paths(support.view);
    if (!(more > 0)) continue;
    const ViewLight& light = traced.light(support.view, mixture);
    for (size_t p = 0; p < reflected.size(); ++p)
      reflected[p] = plus(times(paths / (paths + more), reflected[p]),
                          times(more / (paths + more), light[p].reflected));
    paths += more;
  }
  for (Uncertain& part : reflected)
    part.error = lost ? any_luminance : least_error(part, std::max(1.0, paths));
  reflected_[mixture] = reflected;
}

/// What arrives from the face's direction without the face's own and reflected light, over what the
/// line takes away.
void FaceLight::read_glow(const TracedViews& traced, const FaceOfSign& face,
                          const GroupFactors& factors, size_t mixture, uint32_t number) {
  const Support& support = supports_[number];
  if (traced.is_face_lost(support.view)) return glow_[mixture].lose(number);
  const ViewLight& light = traced.light(support.view, mixture);
  Uncertain veil;
  for (size_t p = 0; p < support.own.size(); ++p) {
    const double own = support.own[p] * factors[mixture][face.parts[p].group];
    const Uncertain arrives = times(support.arrives[p], plus({own, 0}, reflected_[mixture][p]));
    veil = plus(veil, times(0.5, minus(light[p].at_eye, arrives)));
  }
  veil.error = least_error(veil, 2 * traced.paths(support.view));  // to two parts
  const double taken = std::max(1 - support.passed_scene, least_taken);
  glow_[mixture].set(number, times(1 / taken, veil));
}

void FaceLight::read_beyond(const TracedViews& traced, size_t mixture, uint32_t number) {
  const Support& support = supports_[number];
  if (traced.is_beyond_lost(support.view)) return beyond_[mixture].lose(number);
  if (support.passed_scene < least_passed) return;
  Uncertain beyond =
      times(1 / support.passed_scene, traced.light(support.view, mixture).back().reflected);
  beyond.error = least_error(beyond, traced.paths(support.view));
  beyond_[mixture].set(number, beyond);
}

void FaceLight::test(uint32_t support, std::span<const NearSupport> others) {
  for (SupportField& field : glow_) field.test(support, others);
  for (SupportField& field : beyond_) field.test(support, others);
}

}  // namespace luxodus
