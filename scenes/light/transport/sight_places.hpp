// Places that represent a cell of space: in its air, or on its surfaces that face one way. They are
// kept apart because the two sides of a wall receive different light, and so do a desk and the air
// beside it. Functions without state; one thread or fiber per resolver; suspends
// where the resolver does.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/real.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/learned_cells.hpp"

namespace luxodus {

namespace limits {
/// Places per cell and side: with half as many, emitters visible from a part of the cell are missed
/// too often.
inline constexpr size_t sight_places = 16;
/// Largest number of these on surfaces, and the weight of each in the air beside them: a part of
/// the surfaces that no ray has hit may see what the rest does not.
inline constexpr size_t surface_places = 12;
inline constexpr double air_beside_surfaces = 0.1;
/// Rays that search for surfaces of a side.
inline constexpr int surface_lines = 64;
}  // namespace limits

/// The sides of a cell: its air, and surfaces that face along x, y or z, or against them.
inline constexpr size_t cell_sides = 7;

/// The side of a place, by the normal of its surface; zero normal: in the air.
inline size_t cell_side(const Vec3& normal) {
  if (normal == Vec3(0)) return 0;
  const Vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 1 + 2 * static_cast<size_t>(axis) + (normal[axis] < 0 ? 1 : 0);
}

struct SightPlace {
  Vec3 at{0};         // offset from the surface
  Vec3 normal{0};     // of the surface; zero in the air
  double weight = 1;  // relative to the other places
  /// Whether light that arrives against the direction can be received here.
  bool faces(const Vec3& direction) const {
    return normal == Vec3(0) || glm::dot(normal, direction) > 0;
  }
};

/// Root mean square over places, from the weighted sum of squares.
inline double root_mean(double squares, std::span<const SightPlace> places) {
  double weights = 0;
  for (const SightPlace& place : places) weights += place.weight;
  return std::sqrt(squares / weights);
}

/// limits::sight_places places of a side. If no surface is found, all are in the air.
template <class Resolver>
std::vector<SightPlace> sight_places(const CompiledScene& scene, const CellGrid& grid, size_t cell,
                                     size_t side, Random& random, Resolver& resolver) {
  std::vector<SightPlace> out;
  const auto random_place = [&] {
    const Real x = random.uniform();
    const Real y = random.uniform();
    const Real z = random.uniform();
    return grid.low_of(cell) + Vec3(x, y, z) * grid.edge();
  };
  Vec3 facing(0);
  if (side > 0) facing[static_cast<int>((side - 1) / 2)] = side % 2 == 1 ? 1.0_r : -1.0_r;
  // Starts in the cell, or in the next one that the surfaces face, which may hold most of their
  // air.
  for (int i = 0; side > 0 && i < limits::surface_lines && out.size() < limits::surface_places;
       ++i) {
    const Vec3 place = random_place();
    const Ray ray{place + facing * (random.uniform() * grid.edge()), -facing};
    const Hit hit = resolver.nearest(ray);
    if (!hit.found()) continue;
    const Vec3 met = hit.triangle->at(hit.u, hit.v);
    const Vec3 front = hit.triangle->unit_normal();
    const Vec3 normal = glm::dot(front, facing) > 0 ? front : -front;
    if (grid.cell_of(met) == cell && cell_side(normal) == side)
      out.push_back({offset_ray(met, normal, scene.min_offset_m), normal});
  }
  const double weight = out.empty() ? 1 : limits::air_beside_surfaces;
  while (out.size() < limits::sight_places) out.push_back({random_place(), Vec3(0), weight});
  return out;
}

}  // namespace luxodus
