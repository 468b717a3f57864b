// Analyses the surroundings of a place by rays in fixed directions: whether it lies in a body,
// whether it is outdoors, and which surfaces of rooms face it with their backs. Places are in local
// coordinates. Deterministic. One thread or fiber at a time.
#pragma once

#include <span>
#include <vector>

#include "scenes/light/transport/visibility.hpp"

namespace luxodus {

namespace limits {
/// Surfaces that one line may pass; the next one ends it. More than any `passes` allows.
inline constexpr int surfaces_passed = 1024;
}  // namespace limits

/// Whether all of a mesh lies in one plane.
bool is_flat(const Mesh& mesh);

/// Directions distributed evenly over the sphere (Fibonacci lattice), none along an axis, so that
/// rays rarely run within walls or along their edges.
std::vector<Vec3> sphere_directions(int count);

/// A surface hit, as seen from the ray.
struct FacedSurface {
  Real distance_m = 0;
  bool front = true;
  uint32_t surface = 0;
  MaterialKind kind = MaterialKind::lambertian;
};

/// Whether a material transmits light, straight or refracted: then it counts as neither wall nor
/// body.
inline bool lets_light_through(MaterialKind kind) {
  return kind == MaterialKind::open || kind == MaterialKind::glass_pane ||
         kind == MaterialKind::dielectric;
}

/// The nearest surface on a line that `passes(facing)` does not let it pass; none if there is no
/// such surface within `length_m`.
template <class Passes>
std::optional<FacedSurface> first_stop(const CompiledScene& scene, const GeometryAccess& access,
                                       const Vec3& from, const Vec3& direction, Real length_m,
                                       Passes&& passes) {
  // Continues behind the passed surface: beyond the rounding of its distance, before any separate
  // surface.
  const Real beyond = std::max(1e-5_r, 8 * scene.min_offset_m);
  Real gone = 0;
  for (int i = 0; i <= limits::surfaces_passed; ++i) {
    const auto met =
        next_surface(scene, access, from + direction * gone, direction, length_m - gone);
    if (!met) return std::nullopt;
    const uint32_t material = scene.surfaces[met->surface].material[met->front ? 0 : 1];
    const FacedSurface facing{gone + met->distance_m, met->front, met->surface,
                              scene.materials[material].kind};
    if (i == limits::surfaces_passed || !passes(facing)) return facing;
    gone = facing.distance_m + beyond;
    if (!(gone < length_m)) return std::nullopt;
  }
  return std::nullopt;
}

/// Surfaces of rooms that are modelled with their backs to the inside, by surface of the scene. A
/// room surrounds lamps, eyes and routes on most sides and has the size of a room; it is one table
/// of the scene file, or flat faces in several. A correctly modelled body shows its back only to
/// its own inside, where nobody is.
std::vector<char> turned_surfaces(const CompiledScene& scene, const GeometryAccess& access);

/// Whether a place lies in a closed body: in most directions the first surface of one body (all
/// that is in one table of the scene file) shows its back. `turned`: result of turned_surfaces, or
/// empty. `ignored`: by surface, what does not count as a body here, such as furniture for people
/// walking around it.
bool in_body(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place,
             std::span<const char> turned = {}, std::span<const char> ignored = {});

/// Whether a place is outdoors: at least half of all directions are free, and nearly as many of the
/// horizontal ones, both from there and from half way to the ground, so that a room without a roof
/// is inside up to its rim. Panes and closed doors count as closed.
bool is_outside(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place);

}  // namespace luxodus
