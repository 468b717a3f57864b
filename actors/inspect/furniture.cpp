// What stands and what turns: furniture that floats or is sunk in the floor, door leaves that turn
// about a hinge that is not theirs.
#include <algorithm>
#include <cmath>

#include "actors/inspect/site.hpp"

namespace luxodus {

namespace {

/// Flatter is a slab: a table's top or a shelf, drawn without what bears it [m].
constexpr double slab_m = 0.15;
/// Feet, castors and carpets [m].
constexpr double foot_m = 0.05;
/// What bears a thing that does not stand: a wall beside it, a ceiling above it [m].
constexpr double beside_m = 0.1;
/// Asked so far below a foot [m].
constexpr double below_foot_m = 1e-3;
constexpr size_t feet_asked = 8;
/// A hinge is at its leaf's edge; farther away the leaf leaves its opening [m].
constexpr double hinge_slack_m = 0.15;
constexpr double leaf_height_m = 1.5;

Bounds extent_of(const Mesh& mesh) {
  Bounds out;
  for (const glm::dvec3& p : mesh.positions) out.extend(p);
  return out;
}

/// Lowest points of a mesh, some of them.
std::vector<glm::dvec3> feet_of(const Mesh& mesh, double low) {
  std::vector<glm::dvec3> out;
  for (const glm::dvec3& p : mesh.positions)
    if (p.z < low + foot_m && out.size() < feet_asked) out.push_back(p);
  return out;
}

/// How far the nearest of a thing's feet is above what is below it; none if something bears it.
std::optional<double> floats_by(const Site& site, const GeometryAccess& access,
                                const Object& object) {
  const Bounds box = extent_of(object.mesh);
  const glm::dvec3 up(0, 0, 1), middle = (box.low + box.high) * 0.5;
  std::optional<double> least;
  for (const glm::dvec3& foot : feet_of(object.mesh, box.low.z)) {
    // A little inwards, so that feet on an edge are above what bears them.
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

}  // namespace

void inspect_furniture(const Site& site, Findings& out) {
  const auto& objects = site.scene.objects;
  std::vector<std::optional<double>> floats(objects.size());
  site.building.each(objects.size(), [&](const GeometryAccess& access, size_t i) {
    const Object& object = objects[i];
    // Parts of an import bear one another.
    const bool alone = object.name.find('.') == std::string::npos;
    if (!alone || !is_furniture(object) || object.mesh.positions.empty()) return;
    const Bounds box = extent_of(object.mesh);
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
    const Bounds box = extent_of(object.mesh);
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
    else if (std::abs(axis.z) < 0.7 && box.high.z - box.low.z > leaf_height_m)
      tell(Severity::warning,
           "turns about a level axis, as a flap does: leave out 'axis' if it is a door");
  }
}

}  // namespace luxodus
