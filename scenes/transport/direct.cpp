// Flat rectangles are cut on a regular grid; every other shape takes points of Roberts' R3
// sequence, which fills its three numbers evenly at any count.
#include "scenes/transport/direct.hpp"

#include <cmath>

namespace luxodus {

namespace {

constexpr double plastic = 1.2207440846057596;  // root of x^4 = x + 1

double fractional(double x) {
  return x - std::floor(x);
}

std::vector<EmissionPoint> rectangle_parts(const CompiledEmitter& e, double distance,
                                           double share) {
  const auto count = [&](float size) {
    const double wanted = std::ceil(static_cast<double>(size) / (share * distance));
    return std::clamp(static_cast<int>(wanted), 1, limits::direct_parts_per_side);
  };
  const int nu = count(e.size.x);
  const int nv = count(e.size.y);
  std::vector<EmissionPoint> parts;
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(nu);
      const float v = (static_cast<float>(j) + 0.5f) / static_cast<float>(nv);
      parts.push_back(emission_point(e, u, v, 0));
    }
  }
  return parts;
}

/// Largest extent of an emitter [m].
double extent(const CompiledEmitter& e) {
  if (e.kind != EmitterKind::mesh)
    return static_cast<double>(std::max({e.size.x, e.size.y, e.size.z}));
  glm::vec3 low = e.corners.front(), high = low;
  for (const glm::vec3& c : e.corners) {
    low = glm::min(low, c);
    high = glm::max(high, c);
  }
  return static_cast<double>(glm::length(high - low));
}

/// Distance to the emitter's nearest part, roughly.
double distance_to(const CompiledEmitter& e, const glm::vec3& from, double size) {
  const glm::vec3 centre = e.kind == EmitterKind::mesh ? e.corners.front() : e.origin;
  return std::max(static_cast<double>(glm::length(from - centre)) - size / 2, size / 32);
}

}  // namespace

std::vector<EmissionPoint> emitter_parts(const CompiledScene& scene, const CompiledEmitter& e,
                                         const glm::vec3& from, double part_share) {
  if (e.kind == EmitterKind::point) return {emission_point(e, 0, 0, 0)};
  if (e.kind == EmitterKind::volume) {
    std::vector<EmissionPoint> parts;
    for (const glm::vec3& p : scene.volume_points.at(e.medium)) parts.push_back({p, {0, 0, -1}});
    return parts;
  }
  const double size = extent(e);
  const double distance = distance_to(e, from, size);
  if (e.kind == EmitterKind::rectangle) return rectangle_parts(e, distance, part_share);
  const double per_side = std::ceil(size / (part_share * distance));
  const int count =
      std::clamp(static_cast<int>(per_side * per_side * 2), 16, limits::direct_points);
  std::vector<EmissionPoint> parts;
  for (int i = 0; i < count; ++i) {
    const double n = i + 1;
    const auto u = static_cast<float>(fractional(0.5 + n / plastic));
    const auto v = static_cast<float>(fractional(0.5 + n / (plastic * plastic)));
    const double w = fractional(0.5 + n / (plastic * plastic * plastic));
    parts.push_back(emission_point(e, std::min(u, 0x1.fffffep-1f), std::min(v, 0x1.fffffep-1f), w));
  }
  return parts;
}

}  // namespace luxodus
