// Flat rectangles are halved until their parts are small; every other shape takes points of
// Roberts' R3 sequence, which fills its three numbers evenly at any count.
#include "scenes/transport/direct.hpp"

#include <cmath>

namespace luxodus {

namespace {

constexpr double plastic = 1.2207440846057596;  // root of x^4 = x + 1

double fractional(double x) {
  return x - std::floor(x);
}

/// A rectangular piece of a rectangle, in its own coordinates from 0 to 1.
struct Cell {
  Real u0, v0, u1, v1;
  Vec2 centre() const { return {0.5_r * (u0 + u1), 0.5_r * (v0 + v1)}; }
};

/// How many times its allowed width a cell has, the midpoint rule's error in view: light falls with
/// the fourth power of the distance, or as fast as exp(-sigma_t d), or to nothing at the horizon.
double excess_width(const CompiledEmitter& e, const Cell& cell, const Viewpoint& from) {
  const Vec2 centre = cell.centre();
  const Vec3 to_part = emission_point(e, centre.x, centre.y, 0).position - from.place;
  const auto distance = std::max(static_cast<double>(glm::length(to_part)), 1e-6);
  const Real size_x = e.size.x * (cell.u1 - cell.u0);
  const Real size_y = e.size.y * (cell.v1 - cell.v0);
  const auto width = static_cast<double>(std::max(size_x, size_y));
  const double excess = width * (1 + from.sigma_t * distance / 4) / (from.part_share * distance);
  const Real reach = 0.5_r * (std::abs(glm::dot(from.normal, e.axes[0])) * size_x +
                              std::abs(glm::dot(from.normal, e.axes[1])) * size_y);
  const bool cut_by_horizon = std::abs(glm::dot(from.normal, to_part)) < reach;
  return cut_by_horizon ? 8 * excess : excess;
}

/// Halves cells across their longer side until all are small, those first that were cut first.
std::vector<EmitterPart> rectangle_parts(const CompiledEmitter& e, const Viewpoint& from) {
  std::vector<Cell> cells{{0, 0, 1, 1}};
  std::vector<EmitterPart> parts;
  for (size_t next = 0; next < cells.size(); ++next) {
    const Cell cell = cells[next];
    const bool room = parts.size() + (cells.size() - next) < limits::direct_parts;
    if (!room || excess_width(e, cell, from) <= 1) {
      const Vec2 centre = cell.centre();
      const auto share = static_cast<double>((cell.u1 - cell.u0) * (cell.v1 - cell.v0));
      parts.push_back({emission_point(e, centre.x, centre.y, 0), share});
      continue;
    }
    const Vec2 centre = cell.centre();
    if (e.size.x * (cell.u1 - cell.u0) >= e.size.y * (cell.v1 - cell.v0)) {
      cells.push_back({cell.u0, cell.v0, centre.x, cell.v1});
      cells.push_back({centre.x, cell.v0, cell.u1, cell.v1});
    } else {
      cells.push_back({cell.u0, cell.v0, cell.u1, centre.y});
      cells.push_back({cell.u0, centre.y, cell.u1, cell.v1});
    }
  }
  return parts;
}

/// Largest extent of an emitter [m].
double extent(const CompiledEmitter& e) {
  if (e.kind != EmitterKind::mesh)
    return static_cast<double>(std::max({e.size.x, e.size.y, e.size.z}));
  Vec3 low = e.corners.front(), high = low;
  for (const Vec3& c : e.corners) {
    low = glm::min(low, c);
    high = glm::max(high, c);
  }
  return static_cast<double>(glm::length(high - low));
}

/// Distance to the emitter's nearest part, roughly.
double distance_to(const CompiledEmitter& e, const Vec3& from, double size) {
  const Vec3 centre = e.kind == EmitterKind::mesh ? e.corners.front() : e.origin;
  return std::max(static_cast<double>(glm::length(from - centre)) - size / 2, size / 32);
}

}  // namespace

std::vector<EmitterPart> emitter_parts(const CompiledScene& scene, const CompiledEmitter& e,
                                       const Viewpoint& from) {
  if (e.kind == EmitterKind::point) return {{emission_point(e, 0, 0, 0), 1}};
  if (e.kind == EmitterKind::rectangle) return rectangle_parts(e, from);
  std::vector<EmitterPart> parts;
  if (e.kind == EmitterKind::volume) {
    const std::vector<glm::vec3>& points = scene.volume_points.at(e.medium);
    const double share = 1 / static_cast<double>(points.size());
    for (const glm::vec3& p : points) parts.push_back({{p, {0, 0, -1}}, share});
    return parts;
  }
  const double size = extent(e);
  const double per_side = std::ceil(size / (from.part_share * distance_to(e, from.place, size)));
  const int count =
      std::clamp(static_cast<int>(per_side * per_side * 2), 16, limits::direct_points);
  for (int i = 0; i < count; ++i) {
    const double n = i + 1;
    const auto u = static_cast<Real>(fractional(0.5 + n / plastic));
    const auto v = static_cast<Real>(fractional(0.5 + n / (plastic * plastic)));
    const double w = fractional(0.5 + n / (plastic * plastic * plastic));
    parts.push_back(
        {emission_point(e, std::min(u, 0x1.fffffep-1_r), std::min(v, 0x1.fffffep-1_r), w),
         1.0 / count});
  }
  return parts;
}

}  // namespace luxodus
