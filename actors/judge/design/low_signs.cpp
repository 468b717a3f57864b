#include "actors/judge/design/low_signs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "actors/judge/design/wall_probe.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Step and largest distance of the search for a wall beside the place below the sign [m].
constexpr double step_beside_m = 0.25, farthest_beside_m = 1.5;
/// A wall is searched from this far before the sign's plane to this far behind it [m].
constexpr double before_face_m = 0.3, behind_face_m = 0.6;
/// Flatness of a wall behind a sign, and gap between sign and wall [m].
constexpr double flat_to_m = 0.01, off_wall_m = 0.002;
/// Signs that lean more than this get no low sign [cosine].
constexpr double upright_cosine = 0.99;
/// Smallest distance from the floor to a low sign's lower edge [m].
constexpr double above_floor_at_least_m = 0.05;

class LowPlace {
 public:
  LowPlace(const SceneDescription& scene, const Building& building, const GeometryAccess& access,
           const Sign& sign)
      : building_(building), access_(access), sign_(sign) {
    if (const auto floor = floor_below(scene, sign.frame.origin))
      height_ = *floor + std::max(low_sign_height_m, sign.height_m / 2 + above_floor_at_least_m);
  }

  /// The possible place nearest to the high sign.
  std::optional<glm::dvec3> find() const {
    if (!height_ || sign_.frame.origin.z - *height_ < sign_.height_m) return std::nullopt;
    for (double beside = 0; beside <= farthest_beside_m; beside += step_beside_m)
      for (const double side : {1.0, -1.0})
        if (const auto place = at(beside * side)) return place;
    return std::nullopt;
  }

 private:
  std::optional<glm::dvec3> at(double beside) const {
    const glm::dvec3 &across = sign_.frame.axes[0], &out = sign_.frame.axes[2];
    glm::dvec3 middle = sign_.frame.origin + across * beside;
    middle.z = *height_;
    std::optional<double> wall;
    for (const double u : {0.0, -0.5, 0.5})
      for (const double v : {-0.5, 0.5}) {
        const glm::dvec3 from = middle + across * (u * sign_.width_m) +
                                sign_.frame.axes[1] * (v * sign_.height_m) + out * before_face_m;
        if (building_.in_solid(access_, from)) return std::nullopt;
        const auto distance =
            wall_distance(building_, access_, from, -out, before_face_m + behind_face_m);
        if (!distance || (wall && std::abs(*distance - *wall) > flat_to_m)) return std::nullopt;
        wall = wall ? std::min(*wall, *distance) : *distance;
      }
    return told_place(middle + out * (before_face_m - *wall + sign_.thickness_m / 2 + off_wall_m));
  }

  const Building& building_;
  const GeometryAccess& access_;
  const Sign& sign_;
  std::optional<double> height_;
};

std::string free_name(const SceneDescription& scene, std::string name) {
  while (std::any_of(scene.signs.begin(), scene.signs.end(),
                     [&](const Sign& sign) { return sign.name == name; }))
    name += "+";
  return name;
}

}  // namespace

std::vector<LowSign> low_signs_of(const SceneDescription& scene, const Building& building) {
  std::vector<LowSign> out;
  building.each(1, [&](const GeometryAccess& access, size_t) {
    for (const Sign& sign : scene.signs) {
      if (sign.frame.axes[1].z < upright_cosine) continue;
      const auto place = LowPlace(scene, building, access, sign).find();
      if (!place) continue;
      LowSign low{sign.name, sign};
      low.sign.name = free_name(scene, sign.name + " (low)");
      low.sign.frame.origin = *place;
      out.push_back(std::move(low));
    }
  });
  return out;
}

SceneDescription with_low_signs(const SceneDescription& scene, const std::vector<LowSign>& low) {
  SceneDescription out = scene;
  for (const LowSign& one : low) out.signs.push_back(one.sign);
  return out;
}

}  // namespace luxodus
