// Inspects furniture that floats or is sunk in the floor, and door leaves whose hinge is not at
// their edge.
#include <algorithm>
#include <cmath>
#include <set>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

namespace {

/// A flatter thing is a slab: a table top or a shelf, drawn without its support [m].
constexpr double slab_m = 0.15;
/// Feet, castors and carpets [m].
constexpr double foot_m = 0.05;
/// Distance of a support other than the floor: a wall beside it, a ceiling above it [m].
constexpr double beside_m = 0.1;
/// Tested this far below a foot [m].
constexpr double below_foot_m = 1e-3;
constexpr size_t feet_asked = 8;
/// A hinge farther from its leaf's edge than this makes the leaf leave its opening [m].
constexpr double hinge_slack_m = 0.15;
constexpr double leaf_height_m = 1.5;
/// A smaller opening angle lets nobody pass: it is in radians, or has a wrong decimal point [deg].
constexpr double min_open_deg = 10;
/// Furniture this deep in the floor is not just pressed into a carpet [m].
constexpr double sunk_m = 0.03;
/// A thing this far beyond a wall's face on both sides passes through it, and does not just touch
/// [m].
constexpr double through_m = 0.03;
/// Number of a thing's edges tested against walls; round things have more, but short ones.
constexpr size_t edges_asked = 400;
constexpr double level_edge = 0.1;

/// Some of the lowest points of a mesh.
std::vector<glm::dvec3> feet_of(const Mesh& mesh, double low) {
  std::vector<glm::dvec3> out;
  for (const glm::dvec3& p : mesh.positions)
    if (p.z < low + foot_m && out.size() < feet_asked) out.push_back(p);
  return out;
}

/// Distance from the lowest of a thing's feet to what is below it; none if something supports it.
std::optional<double> floats_by(const Site& site, const GeometryAccess& access,
                                const Object& object) {
  const Bounds box = bounds_of(object.mesh);
  const glm::dvec3 up(0, 0, 1), middle = (box.low + box.high) * 0.5;
  std::optional<double> least;
  for (const glm::dvec3& foot : feet_of(object.mesh, box.low.z)) {
    // Slightly inwards, so that feet on an edge are above their support.
    const glm::dvec3 inwards = glm::dvec3(middle.x - foot.x, middle.y - foot.y, 0) * 0.02;
    const glm::dvec3 from = foot + inwards - up * below_foot_m;
    if (site.in_body(access, from) || site.in_body(access, from - up * (foot_m / 2)))
      return std::nullopt;
    const auto below = solid_ahead(site, access, from, -up, floor_below_m);
    if (!below) return std::nullopt;
    const auto height = static_cast<double>(below->distance_m);
    least = std::min(least.value_or(height), height);
  }
  if (!least || *least <= foot_m) return std::nullopt;
  const glm::dvec3 half = (box.high - box.low) * 0.5;
  for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, up}) {
    const double reach = std::abs(glm::dot(half, way));
    if (solid_ahead(site, access, middle, way, reach + beside_m, false)) return std::nullopt;
  }
  return *least + below_foot_m;
}

/// Depth of all of a thing's feet below a floor that it extends above.
std::optional<double> sunk_by(const Site& site, const GeometryAccess& access,
                              const Object& object) {
  const Bounds box = bounds_of(object.mesh);
  const glm::dvec3 up(0, 0, 1), middle = (box.low + box.high) * 0.5;
  const double height = box.high.z - box.low.z;
  std::optional<double> least;
  for (const glm::dvec3& foot : feet_of(object.mesh, box.low.z)) {
    const glm::dvec3 inwards = glm::dvec3(middle.x - foot.x, middle.y - foot.y, 0) * 0.02;
    const auto floor = first_stop(
        site.building.scene(), access, site.building.local(foot + inwards + up * below_foot_m),
        Vec3(up), static_cast<Real>(height), [&](const FacedSurface& f) {
          return f.surface >= site.scene.objects.size() || lets_light_through(f.kind) ||
                 is_furniture(site.scene.objects[f.surface]) || !site.is_back(f);
        });
    if (!floor) return std::nullopt;
    const auto depth = static_cast<double>(floor->distance_m);
    least = std::min(least.value_or(depth), depth);
  }
  if (!least || *least <= sunk_m) return std::nullopt;
  return *least + below_foot_m;
}

/// A wall that horizontal edges of a thing pass through, and where.
std::optional<std::pair<const Object*, glm::dvec3>> reaches_through(const Site& site,
                                                                    const GeometryAccess& access,
                                                                    const Object& object) {
  const Mesh& mesh = object.mesh;
  const Bounds box = bounds_of(mesh);
  const glm::dvec3 middle = (box.low + box.high) * 0.5;
  size_t asked = 0;
  for (const glm::uvec3& t : mesh.triangles)
    for (const auto& [from, to] : {std::pair(t.x, t.y), {t.y, t.z}, {t.z, t.x}}) {
      // Slightly inwards, so that a back that touches its wall is in front of it.
      const glm::dvec3 a = glm::mix(mesh.positions[from], middle, 0.01);
      const glm::dvec3 b = glm::mix(mesh.positions[to], middle, 0.01);
      const double length = glm::length(b - a);
      if (length < 3 * through_m || std::abs(b.z - a.z) > level_edge * length) continue;
      if (++asked > edges_asked) return std::nullopt;
      const glm::dvec3 way = (b - a) / length;
      const auto wall =
          solid_ahead(site, access, a + way * through_m, way, length - 2 * through_m, false);
      if (!wall || site.scene.objects[wall->surface].door) continue;
      const double gone = through_m + static_cast<double>(wall->distance_m);
      return std::pair(&site.scene.objects[wall->surface], a + way * gone);
    }
  return std::nullopt;
}

/// For parts of one import, or copies of one thing, only one is reported.
void tell_sunk_or_through(const Site& site, Findings& out) {
  const auto& objects = site.scene.objects;
  std::vector<std::optional<double>> sunk(objects.size());
  std::vector<std::optional<std::pair<const Object*, glm::dvec3>>> through(objects.size());
  site.building.each(objects.size(), [&](const GeometryAccess& access, size_t i) {
    const Object& object = objects[i];
    if (!is_furniture(object) || object.mesh.positions.empty()) return;
    sunk[i] = sunk_by(site, access, object);
    if (!sunk[i]) through[i] = reaches_through(site, access, object);
  });
  std::set<std::pair<std::string, int>> told;
  for (size_t i = 0; i < objects.size(); ++i) {
    if (!sunk[i] && !through[i]) continue;
    if (!told.insert({objects[i].place.file, objects[i].place.line}).second) continue;
    const std::string what =
        sunk[i] ? fmt::format("is sunk by {} in what it stands on: give it the height of the floor",
                              length_text(*sunk[i]))
                : fmt::format(
                      "reaches through {} at {}: are its place, its size and its turn "
                      "right?",
                      object_text(*through[i]->first), place_text(through[i]->second));
    out.push_back({Severity::warning,
                   "furniture",
                   {objects[i].place, "the furniture \"" + objects[i].name + "\" " + what}});
  }
}

}  // namespace

void inspect_furniture(const Site& site, Findings& out) {
  tell_sunk_or_through(site, out);
  const auto& objects = site.scene.objects;
  std::vector<std::optional<double>> floats(objects.size());
  site.building.each(objects.size(), [&](const GeometryAccess& access, size_t i) {
    const Object& object = objects[i];
    // Parts of an import support one another.
    const bool alone = object.name.find('.') == std::string::npos;
    if (!alone || !is_furniture(object) || object.mesh.positions.empty()) return;
    const Bounds box = bounds_of(object.mesh);
    if (box.high.z - box.low.z > slab_m) floats[i] = floats_by(site, access, object);
  });
  for (size_t i = 0; i < objects.size(); ++i)
    if (floats[i])
      out.push_back(
          {Severity::warning,
           "floating",
           {objects[i].place,
            fmt::format("the furniture \"{}\" floats {} above what is below it, and hangs "
                        "on nothing: is its height right?",
                        objects[i].name, length_text(*floats[i]))}});
}

void inspect_doors(const SceneDescription& scene, Findings& out) {
  for (const Object& object : scene.objects) {
    if (!object.door || object.mesh.positions.empty()) continue;
    const Door& door = *object.door;
    const Bounds box = bounds_of(object.mesh);
    const glm::dvec3 axis = glm::normalize(door.axis);
    const auto tell = [&](Severity severity, const std::string& what) {
      out.push_back({severity, "door", {object.place, "the door \"" + object.name + "\" " + what}});
    };
    const glm::dvec3 middle = (box.low + box.high) * 0.5;
    const glm::dvec3 on_axis = door.hinge + axis * glm::dot(middle - door.hinge, axis);
    const double away = glm::length(on_axis - glm::clamp(on_axis, box.low, box.high));
    if (away > hinge_slack_m)
      tell(away > 1 ? Severity::error : Severity::warning,
           fmt::format("turns about a hinge that is {} away from its leaf, so that it leaves its "
                       "opening: give 'hinge' a point of the leaf's edge, in scene coordinates",
                       length_text(away)));
    else if (std::abs(door.open_angle_deg) < min_open_deg)
      tell(
          Severity::warning,
          fmt::format("opens by {:.3g} degrees, as good as closed: 'open_angle_deg' is in degrees, "
                      "90 for a door that stands open",
                      door.open_angle_deg));
    else if (std::abs(axis.z) < 0.7 && box.high.z - box.low.z > leaf_height_m)
      tell(Severity::warning,
           "turns about a level axis, as a flap does: leave out 'axis' if it is a door");
  }
}

}  // namespace luxodus
