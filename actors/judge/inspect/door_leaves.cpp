// Inspects door leaves and the walls around them: leaves in a wall, closed or while opening, in
// front of a wall without an opening, or in no wall at all.
#include <algorithm>
#include <array>
#include <cmath>

#include "actors/judge/inspect/doorway.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace {

/// Sizes of door leaves: lower ones are flaps and hatches, wider and thicker ones gates [m].
constexpr double min_leaf_height_m = 1.5;
constexpr double min_leaf_width_m = 0.4;
constexpr double max_leaf_width_m = 6;
constexpr double max_leaf_depth_m = 0.3;
/// A wall this close behind all of a closed leaf has no opening there [m].
constexpr double behind_leaf_m = 0.3;
/// A frame is this close to a leaf's edge [m].
constexpr double to_frame_m = 0.3;
constexpr double off_leaf_m = 5e-3;
/// Numbers of three by three sample places: more than half, and nearly all.
constexpr int many_places = 5;
constexpr int nearly_all_places = 8;
/// Range of the way from hinge to edge, as shares, in which a wall obstructs an opening leaf.
constexpr double from_hinge = 0.03;
constexpr double to_edge = 0.95;

/// A leaf as a rectangle.
struct Leaf {
  glm::dvec3 middle{0}, across{1, 0, 0}, normal{0, 1, 0};  // across: away from the hinge
  double width_m = 0, height_m = 0, depth_m = 0;

  glm::dvec3 at(double u, double v) const {
    return middle + across * (u * width_m) + glm::dvec3(0, 0, v * height_m);
  }
};

/// The leaf along the axis of largest spread, seen from above; none if the object is not a door.
std::optional<Leaf> leaf_of(const Object& object) {
  const auto& p = object.mesh.positions;
  if (!object.door || p.empty() || std::abs(glm::normalize(object.door->axis).z) < 0.9)
    return std::nullopt;
  glm::dvec2 mean(0);
  for (const glm::dvec3& q : p) mean += glm::dvec2(q) / static_cast<double>(p.size());
  double xx = 0, xy = 0, yy = 0;
  for (const glm::dvec3& q : p) {
    const glm::dvec2 d = glm::dvec2(q) - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  Leaf leaf;
  leaf.across = {std::cos(angle), std::sin(angle), 0};
  if (glm::dot(leaf.across, glm::dvec3(mean, 0) - object.door->hinge) < 0)
    leaf.across = -leaf.across;
  leaf.normal = {-leaf.across.y, leaf.across.x, 0};
  Bounds box;  // across, normal, up
  for (const glm::dvec3& q : p)
    box.extend({glm::dot(q, leaf.across), glm::dot(q, leaf.normal), q.z});
  const glm::dvec3 size = box.high - box.low, middle = (box.low + box.high) * 0.5;
  leaf.middle = leaf.across * middle.x + leaf.normal * middle.y + glm::dvec3(0, 0, middle.z);
  leaf.width_m = size.x;
  leaf.depth_m = size.y;
  leaf.height_m = size.z;
  const bool is_leaf = size.z >= min_leaf_height_m && size.x >= min_leaf_width_m &&
                       size.x <= max_leaf_width_m && size.y <= max_leaf_depth_m;
  return is_leaf ? std::optional(leaf) : std::nullopt;
}

Leaf opened(const Leaf& leaf, const Door& door) {
  Leaf out = leaf;
  const auto turn = rotation(door.axis, door.open_angle_deg);
  if (!turn) return out;
  out.middle = door.hinge + turn->vector(leaf.middle - door.hinge);
  out.across = turn->vector(leaf.across);
  out.normal = turn->vector(leaf.normal);
  return out;
}

/// Three by three places of a leaf, within its edges.
std::array<glm::dvec3, 9> places_of(const Leaf& leaf) {
  std::array<glm::dvec3, 9> out;
  for (size_t i = 0; i < out.size(); ++i)
    out[i] =
        leaf.at(0.35 * (static_cast<double>(i % 3) - 1), 0.3 * (static_cast<double>(i / 3) - 1));
  return out;
}

/// Leaves and furniture, by surface, which are not walls.
std::vector<char> movables_of(const Site& site) {
  std::vector<char> out = furniture_of(site);
  for (size_t i = 0; i < out.size(); ++i)
    if (site.scene.objects[i].door) out[i] = 1;
  return out;
}

bool stands_in_wall(const Site& site, const GeometryAccess& access, const Leaf& leaf,
                    const std::vector<char>& movables) {
  const auto places = places_of(leaf);
  const auto inside = std::count_if(places.begin(), places.end(), [&](const glm::dvec3& p) {
    return site.building.in_solid(access, p, movables);
  });
  return inside >= many_places;
}

/// A wall directly behind nearly all of a closed leaf.
std::optional<uint32_t> wall_behind(const Site& site, const GeometryAccess& access,
                                    const Leaf& leaf) {
  for (const glm::dvec3& way : {leaf.normal, -leaf.normal}) {
    int met = 0;
    uint32_t surface = 0;
    for (const glm::dvec3& p : places_of(leaf)) {
      const glm::dvec3 from = p - way * (leaf.depth_m / 2 + off_leaf_m);
      const auto wall = wall_ahead(site, access, from, way, leaf.depth_m + behind_leaf_m);
      if (!wall) continue;
      ++met;
      surface = wall->surface;
    }
    if (met >= nearly_all_places) return surface;
  }
  return std::nullopt;
}

/// Whether there is anything beside or above a closed leaf, in or near its plane.
bool has_frame(const Site& site, const GeometryAccess& access, const Leaf& leaf) {
  const auto meets = [&](const glm::dvec3& edge, const glm::dvec3& way) {
    for (const double aside : {0.0, 0.04, -0.04})
      if (wall_ahead(site, access, edge - way * off_leaf_m + leaf.normal * aside, way, to_frame_m))
        return true;
    return false;
  };
  return meets(leaf.at(0.5, 0), leaf.across) || meets(leaf.at(-0.5, 0), -leaf.across) ||
         meets(leaf.at(0, 0.5), glm::dvec3(0, 0, 1));
}

/// The wall that an open leaf passes through, tested at two of three heights and on both its faces,
/// since a leaf that lies flat on a wall has the room in front.
std::optional<uint32_t> wall_in_way(const Site& site, const GeometryAccess& access,
                                    const Leaf& leaf) {
  int met = 0;
  uint32_t surface = 0;
  for (const double height : {-0.3, 0.0, 0.3}) {
    const auto ahead = [&](double aside) {
      return wall_ahead(site, access, leaf.at(from_hinge - 0.5, height) + leaf.normal * aside,
                        leaf.across, (to_edge - from_hinge) * leaf.width_m);
    };
    const auto wall = ahead(off_leaf_m);
    if (!wall || !ahead(-off_leaf_m)) continue;
    ++met;
    surface = wall->surface;
  }
  return met >= 2 ? std::optional(surface) : std::nullopt;
}

std::optional<std::string> closed_wrong(const Site& site, const GeometryAccess& access,
                                        const Leaf& leaf, const std::vector<char>& movables) {
  if (stands_in_wall(site, access, leaf, movables))
    return "stands in a wall when it is closed: give the wall an opening there, or move the leaf "
           "into the one that it has";
  if (const auto wall = wall_behind(site, access, leaf))
    return "stands before " + object_text(site.scene.objects[*wall]) +
           ", which has no opening there: open or closed, it leads nowhere; give the wall an "
           "opening as large as the leaf";
  if (!has_frame(site, access, leaf))
    return fmt::format(
        "stands in no opening: no wall is within {} of its edges; is its place "
        "right? A leaf is drawn closed",
        length_text(to_frame_m));
  return std::nullopt;
}

std::optional<std::string> opened_wrong(const Site& site, const GeometryAccess& access,
                                        const Leaf& leaf, const Door& door,
                                        const std::vector<char>& movables) {
  const char* advice =
      ": turn it to the other side by the sign of 'open_angle_deg', or move its hinge";
  const Leaf open = opened(leaf, door);
  if (const auto wall = wall_in_way(site, access, open))
    return fmt::format("opens by {:.4g} degrees into {}{}", door.open_angle_deg,
                       object_text(site.scene.objects[*wall]), advice);
  if (stands_in_wall(site, access, open, movables))
    return fmt::format("opens by {:.4g} degrees into a wall or body{}", door.open_angle_deg,
                       advice);
  return std::nullopt;
}

}  // namespace

void inspect_leaves(const Site& site, Findings& out) {
  const auto& objects = site.scene.objects;
  const auto open = open_doors(site.scene, site.building.scene().scenario);
  const std::vector<char> movables = movables_of(site);
  std::vector<std::optional<std::string>> found(objects.size());
  site.building.each(objects.size(), [&](const GeometryAccess& access, size_t i) {
    const Object& object = objects[i];
    const auto leaf = leaf_of(object);
    if (!leaf || is_furniture(object) || site.remote.told("", leaf->middle)) return;
    found[i] = closed_wrong(site, access, *leaf, movables);
    const bool is_open = std::count(open.begin(), open.end(), object.name) > 0;
    if (!found[i] && is_open) found[i] = opened_wrong(site, access, *leaf, *object.door, movables);
  });
  for (size_t i = 0; i < objects.size(); ++i)
    if (found[i])
      out.push_back({Severity::warning,
                     "door",
                     {objects[i].place, "the door \"" + objects[i].name + "\" " + *found[i]}});
}

}  // namespace luxodus
