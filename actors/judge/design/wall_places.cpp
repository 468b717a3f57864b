// Two horizontal rays run from points of a route's centre line to its sides, and one runs outwards
// from points of an area's edge. The body that a ray meets is a wall if it is flat there.
#include "actors/judge/design/wall_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "actors/judge/design/wall_probe.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

/// Largest distance of a wall beyond the edge of a route, and beyond that of an area [m].
constexpr double beside_way_m = 3, beside_area_m = 2;
/// Rays to the edge of an area start this far inside it [m].
constexpr double within_edge_m = 0.5;
/// Distance of the luminous opening from the wall [m].
constexpr double before_its_wall_m = 0.03;
/// Half the size of the flat part of a wall that a luminaire needs, and its flatness [m].
constexpr double half_of_flat_m = 0.15, how_flat_m = 0.01;
/// Walls at a larger angle to the ray are not used [tangent of 50 degrees].
constexpr double max_aslant_of_wall = 1.2;
/// Spots on one wall closer than this share of the spacing are merged.
constexpr double one_wall_spot = 0.5;

const glm::dvec3 to_sky(0, 0, 1);

class WallSpotFinder {
 public:
  WallSpotFinder(const SceneDescription& scene, const DesignSettings& design, const Building& bare,
                 const Building& furnished, LeftOut& left_out)
      : scene_(scene), design_(design), bare_(bare), furnished_(furnished), left_out_(left_out) {}

  std::vector<WallSpot> find() {
    bare_.each(1, [&](const GeometryAccess& access, size_t) {
      for (const EscapeRoute& route : scene_.routes)
        if (is_wanted(design_, route.name)) beside(access, route);
      for (const auto* areas : {&scene_.open_areas, &scene_.task_areas})
        for (const AssessedArea& area : *areas)
          if (is_wanted(design_, area.name)) around(access, area);
    });
    keep_free();
    return std::move(spots_);
  }

 private:
  void beside(const GeometryAccess& access, const EscapeRoute& route) {
    for (size_t i = 1; i < route.path.size(); ++i) {
      EscapeRoute leg = route;
      leg.path = {route.path[i - 1], route.path[i]};
      glm::dvec3 way = leg.path[1] - leg.path[0];
      way.z = 0;
      if (!(glm::length(way) > how_flat_m)) continue;
      const glm::dvec3 aside = glm::cross(to_sky, glm::normalize(way));
      for (const glm::dvec3& floor : along(leg, 0, design_.spacing_m))
        for (const double side : {1.0, -1.0})
          look(access, floor, floor, aside * side, route.width_m / 2 + beside_way_m);
    }
  }

  void around(const GeometryAccess& access, const AssessedArea& area) {
    const size_t corners = area.outline.size();
    for (size_t i = 0; i < corners; ++i) {
      const glm::dvec2 from = area.outline[i], to = area.outline[(i + 1) % corners];
      const double length = glm::length(to - from);
      if (!(length > 2 * half_of_flat_m)) continue;
      // The outline is counter-clockwise: the right side of an edge is outside.
      const glm::dvec2 way = (to - from) / length, out(way.y, -way.x);
      const int steps = std::max(1, static_cast<int>(std::ceil(length / design_.spacing_m)));
      for (int k = 0; k < steps; ++k) {
        const glm::dvec2 edge = from + way * (length * (k + 0.5) / steps);
        look(access, {edge, area.z_m}, {edge - out * within_edge_m, area.z_m}, {out, 0},
             within_edge_m + beside_area_m);
      }
    }
  }

  std::optional<double> wall_at(const GeometryAccess& access, const glm::dvec3& from,
                                const glm::dvec3& direction, double length_m) const {
    return wall_distance(bare_, access, from, direction, length_m);
  }

  /// `counted`: point of the route or area.
  void look(const GeometryAccess& access, const glm::dvec3& counted, const glm::dvec3& from,
            const glm::dvec3& direction, double length_m) {
    const glm::dvec3 eye = from + glm::dvec3(0, 0, design_.wall_height_m);
    const glm::dvec3 across = glm::cross(to_sky, direction) * half_of_flat_m;
    const auto middle = wall_at(access, eye, direction, length_m);
    if (!middle) return;  // no wall here
    const auto left = wall_at(access, eye + across, direction, 2 * length_m);
    const auto right = wall_at(access, eye - across, direction, 2 * length_m);
    const auto high = wall_at(access, eye + to_sky * half_of_flat_m, direction, 2 * length_m);
    const auto low = wall_at(access, eye - to_sky * half_of_flat_m, direction, 2 * length_m);
    if (!left || !right || !high || !low) return void(++left_out_.no_wall);
    const double slope = (*left - *right) / (2 * half_of_flat_m);
    if (std::abs(*left + *right - 2 * *middle) > how_flat_m ||
        std::abs(*high - *middle) > how_flat_m || std::abs(*low - *middle) > how_flat_m ||
        std::abs(slope) > max_aslant_of_wall)
      return void(++left_out_.no_wall);
    const glm::dvec3 along_wall = glm::normalize(across / half_of_flat_m + direction * slope);
    glm::dvec3 outward = glm::cross(along_wall, to_sky);
    if (glm::dot(outward, direction) > 0) outward = -outward;
    offer({eye + direction * *middle + outward * before_its_wall_m, outward, counted});
  }

  void offer(WallSpot spot) {
    constexpr double alike = 0.7;  // cosine
    spot.position = told_place(spot.position);
    spot.outward = told_direction(spot.outward);
    for (const WallSpot& other : spots_)
      if (glm::length(other.position - spot.position) < one_wall_spot * design_.spacing_m &&
          glm::dot(other.outward, spot.outward) > alike)
        return;
    spots_.push_back(spot);
  }

  void keep_free() {
    std::vector<char> good(spots_.size(), 1);
    furnished_.each(spots_.size(), [&](const GeometryAccess& access, size_t i) {
      good[i] = furnished_.in_solid(access, spots_[i].position) ? 0 : 1;
    });
    std::vector<WallSpot> out;
    for (size_t i = 0; i < spots_.size(); ++i) {
      if (good[i] == 0)
        ++left_out_.in_bodies;
      else if (near_sign(scene_, spots_[i].position, design_.sign_clearance_m))
        ++left_out_.near_signs;
      else if (kept_out(scene_, design_, spots_[i].position))
        ++left_out_.keep_out;
      else
        out.push_back(spots_[i]);
    }
    spots_ = std::move(out);
  }

  const SceneDescription& scene_;
  const DesignSettings& design_;
  const Building& bare_;
  const Building& furnished_;
  LeftOut& left_out_;
  std::vector<WallSpot> spots_;
};

}  // namespace

std::vector<WallSpot> wall_spots(const SceneDescription& scene, const DesignSettings& design,
                                 const Building& bare, const Building& furnished,
                                 LeftOut& left_out) {
  return WallSpotFinder(scene, design, bare, furnished, left_out).find();
}

glm::dvec3 aim_from_wall(const glm::dvec3& outward, double aim_deg) {
  const double angle = aim_deg * std::numbers::pi / 180;
  return told_direction(outward * std::sin(angle) - to_sky * std::cos(angle));
}

}  // namespace luxodus
