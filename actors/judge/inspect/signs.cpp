// Inspects whether faces of signs are visible at all. A face is tested at sample points, with light
// emitted as by a matt surface.
#include <algorithm>

#include "actors/judge/inspect/same_place.hpp"
#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/optics/sampling.hpp"

namespace luxodus {

namespace {

constexpr Real near_face_m = 0.02_r;
/// A face with a surface this close in front of it is invisible [m].
constexpr Real before_sign_m = 0.3_r;
constexpr int points_per_side = 3;
constexpr int rays_per_point = 16;
constexpr double one_sign_place_m = 0.01;
constexpr double one_sign_direction = 0.99;

struct Face {
  glm::dvec3 centre{0}, right{1, 0, 0}, up{0, 1, 0}, normal{0, 0, 1};
};

Face face_of(const Sign& sign, bool back) {
  const auto& axes = sign.frame.axes;
  if (!back) return {sign.frame.origin, axes[0], axes[1], axes[2]};
  return {sign.frame.origin - axes[2] * sign.thickness_m, -axes[0], axes[1], -axes[2]};
}

/// The share of a face's light that ends within near_face_m, and of its points that face something
/// within before_sign_m; and on which surface.
struct Before {
  double near = 0, close = 0;
  uint32_t surface = none_index;
};

Before before(const Site& site, const GeometryAccess& access, const Sign& sign, const Face& face) {
  const CompiledScene& scene = site.building.scene();
  const Vec3 normal(face.normal), right(face.right), up(face.up);
  const auto passes = [&](const FacedSurface& f) {
    const uint32_t own = scene.surfaces[f.surface].sign;
    return lets_light_through(f.kind) ||
           (own != none_index && &site.scene.signs[scene.signs[own].sign] == &sign);
  };
  int near = 0, close = 0;
  Before out;
  for (int j = 0; j < points_per_side; ++j)
    for (int i = 0; i < points_per_side; ++i) {
      const glm::dvec2 uv = (glm::dvec2(i, j) + 0.5) / double{points_per_side} - 0.5;
      const Vec3 at =
          offset_ray(site.building.local(face.centre + face.right * (uv.x * sign.width_m) +
                                         face.up * (uv.y * sign.height_m)),
                     normal, scene.min_offset_m);
      if (const auto met = first_stop(scene, access, at, normal, before_sign_m, passes)) {
        ++close;
        out.surface = met->surface;
      }
      for (int k = 0; k < rays_per_point; ++k) {
        const Vec3 d =
            cosine_hemisphere((static_cast<Real>(k) + 0.5_r) / rays_per_point,
                              static_cast<Real>((7 * k) % rays_per_point) / rays_per_point);
        if (first_stop(scene, access, at, right * d.x + up * d.y + normal * d.z, near_face_m,
                       passes))
          ++near;
      }
    }
  constexpr double points = points_per_side * points_per_side;
  out.near = near / (points * rays_per_point);
  out.close = close / points;
  return out;
}

/// Whether the back face lies in the plane of a wall, where a ray hits one of the two: tested
/// beside its edges.
bool lies_on_wall(const Site& site, const GeometryAccess& access, const Sign& sign) {
  constexpr double aside_m = 0.01, beyond_m = 1e-3;
  const auto& axes = sign.frame.axes;
  const glm::dvec3 middle = sign.frame.origin - axes[2] * (sign.thickness_m / 2);
  int on_wall = 0;
  for (const glm::dvec2& side : {glm::dvec2(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
    const glm::dvec3 place = middle + axes[0] * (side.x * (sign.width_m / 2 + aside_m)) +
                             axes[1] * (side.y * (sign.height_m / 2 + aside_m));
    const auto met =
        first_stop(site.building.scene(), access, site.building.local(place), Vec3(-axes[2]),
                   static_cast<Real>(sign.thickness_m / 2 + beyond_m), [&](const FacedSurface& f) {
                     return f.surface >= site.scene.objects.size() || lets_light_through(f.kind);
                   });
    on_wall += met ? 1 : 0;
  }
  return on_wall > 2;
}

std::string behind_text(const Site& site, uint32_t surface) {
  return surface < site.scene.objects.size() ? ": " + object_text(site.scene.objects[surface]) : "";
}

std::optional<Finding> wrong_sign(const Site& site, const GeometryAccess& access,
                                  const Sign& sign) {
  if (auto far = site.remote.told("sign \"" + sign.name + "\"", sign.frame.origin))
    return Finding{Severity::error, "far", {sign.place, *far}};
  const Face front = face_of(sign, false);
  const Before ahead = before(site, access, sign, front);
  const bool in_body = site.in_body(access, front.centre + front.normal * 1e-3);
  if (ahead.near > 0.5 || in_body)
    return sign_finding(
        Severity::error, "inside", sign,
        "lies in a wall or body" + behind_text(site, ahead.surface) +
            ": nobody sees its face; move it out, at least its thickness before the wall");
  if (ahead.close > 0.5)
    return sign_finding(Severity::warning, "blind", sign,
                        "faces a wall less than 0.3 m before it" +
                            behind_text(site, ahead.surface) + ": turn it round, or move it");
  if (sign.double_sided) {
    const Before behind = before(site, access, sign, face_of(sign, true));
    if (behind.close > 0.5 || lies_on_wall(site, access, sign))
      return sign_finding(Severity::warning, "blind", sign,
                          "is double-sided and its back face looks at a wall less than 0.3 m away" +
                              behind_text(site, behind.surface) + ": say double_sided = false");
  }
  if (site.is_outside(access, front.centre + front.normal * 1e-2))
    return sign_finding(Severity::note, "outside", sign, "hangs outside the building");
  return std::nullopt;
}

void find_double_signs(const SceneDescription& scene, Findings& out) {
  const auto& signs = scene.signs;
  const auto place = [&](size_t i) { return std::optional(signs[i].frame.origin); };
  const auto alike = [&](size_t a, size_t b) {
    return glm::dot(signs[a].frame.axes[2], signs[b].frame.axes[2]) >= one_sign_direction;
  };
  const auto firsts = first_in_same_place(signs.size(), one_sign_place_m, place, alike);
  for (size_t i = 0; i < signs.size(); ++i) {
    if (!firsts[i]) continue;
    const Sign& first = signs[*firsts[i]];
    out.push_back(sign_finding(
        Severity::warning, "same place", signs[i],
        fmt::format("hangs where sign \"{}\" (line {}) does, at {}: remove one of them", first.name,
                    first.place.line, place_text(signs[i].frame.origin))));
  }
}

}  // namespace

void inspect_signs(const Site& site, Findings& out, std::vector<char>& misplaced) {
  const size_t count = site.scene.signs.size();
  std::vector<std::optional<Finding>> found(count);
  site.building.each(count, [&](const GeometryAccess& access, size_t i) {
    found[i] = wrong_sign(site, access, site.scene.signs[i]);
  });
  misplaced.assign(count, 0);
  for (size_t i = 0; i < count; ++i) {
    if (!found[i]) continue;
    misplaced[i] = 1;
    out.push_back(std::move(*found[i]));
  }
  find_double_signs(site.scene, out);
}

}  // namespace luxodus
