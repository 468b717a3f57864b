// What surrounds a place, found by rays from it: whether it lies in a body, how much of its sky is
// open, and which surfaces of rooms show it their backs. Places are in local coordinates. Without
// chance: directions are fixed. One thread or fiber at a time.
#pragma once

#include <span>
#include <vector>

#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

namespace limits {
/// Surfaces that one line may pass; at one more it ends. More than any `passes` allows.
inline constexpr int surfaces_passed = 1024;
}  // namespace limits

/// Whether all of a mesh lies in one plane.
bool is_flat(const Mesh& mesh);

/// Directions spread evenly over the sphere (Fibonacci lattice), none along an axis, so that rays
/// seldom run within walls or along their edges.
std::vector<Vec3> sphere_directions(int count);

/// A surface that is met, seen from there.
struct Facing {
  Real distance_m = 0;
  bool front = true;
  uint32_t surface = 0;
  MaterialKind kind = MaterialKind::lambertian;
};

/// Whether light goes straight on through a material, or bent: it is no wall and no body to it.
inline bool lets_light_through(MaterialKind kind) {
  return kind == MaterialKind::open || kind == MaterialKind::glass_pane ||
         kind == MaterialKind::dielectric;
}

/// The nearest surface on a line that `passes(facing)` does not let it pass; none within
/// `length_m`.
template <class Passes>
std::optional<Facing> first_stop(const CompiledScene& scene, const GeometryAccess& access,
                                 const Vec3& from, const Vec3& direction, Real length_m,
                                 Passes&& passes) {
  // Behind what was passed: beyond the rounding of its distance, before anything that is apart.
  const Real beyond = std::max(1e-5_r, 8 * scene.min_offset_m);
  Real gone = 0;
  for (int i = 0; i <= limits::surfaces_passed; ++i) {
    const auto met =
        next_surface(scene, access, from + direction * gone, direction, length_m - gone);
    if (!met) return std::nullopt;
    const uint32_t material = scene.surfaces[met->surface].material[met->front ? 0 : 1];
    const Facing facing{gone + met->distance_m, met->front, met->surface,
                        scene.materials[material].kind};
    if (i == limits::surfaces_passed || !passes(facing)) return facing;
    gone = facing.distance_m + beyond;
    if (!(gone < length_m)) return std::nullopt;
  }
  return std::nullopt;
}

/// Surfaces of rooms that are drawn with their backs to the inside, by surface of the scene. A room
/// is what surrounds lamps, eyes and routes on most sides and has the size of one, drawn in one
/// table or as flat faces in several; a body that is drawn as it should be shows its back to its
/// own inside alone, where nobody is.
std::vector<char> turned_surfaces(const CompiledScene& scene, const GeometryAccess& access);

/// Whether a place lies in a closed body: in most directions the first that is met of one body, all
/// that stands in one table of the scene file, is a back. `turned`: as turned_surfaces, or empty.
/// `ignored`: by surface, what is no body here, such as furniture to those who walk around it.
bool in_body(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place,
             std::span<const char> turned = {}, std::span<const char> ignored = {});

/// Whether a place lies outside of whatever is built: at least half of all directions meet nothing,
/// and nearly as many of the level ones, from there and from half way to what is below, so that a
/// room without a roof is inside up to its rim. Panes and closed doors count as closed.
bool is_outside(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place);

}  // namespace luxodus
