#include "actors/judge/assess/plan_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

constexpr double breast_m = 1.2;
/// A place up to this far below a floor still belongs to it [m].
constexpr double sunk_m = 0.5;
/// Margin of an illuminance map around routes and areas [m].
constexpr double around_m = 3;
constexpr double map_spacing_m = 0.25;

using Line = std::pair<glm::dvec2, glm::dvec2>;

/// Adds the line in which a horizontal plane cuts a triangle.
void cut(const glm::dvec3 (&corners)[3], double z, std::vector<Line>& out) {
  glm::dvec2 ends[3];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.z < z) == (b.z < z)) continue;
    ends[count++] = glm::dvec2(glm::mix(a, b, (z - a.z) / (b.z - a.z)));
  }
  if (count == 2) out.emplace_back(ends[0], ends[1]);
}

bool stands_open(const Object& object, const Scenario& doors) {
  if (!object.door) return false;
  const auto named = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), object.name) != names.end();
  };
  return named(doors.doors_open) || (object.door->open && !named(doors.doors_closed));
}

/// Adds the sections of all objects except open doors.
void cut_level(const SceneDescription& scene, const Scenario& doors, PlanLevel& level) {
  for (const Object& object : scene.objects) {
    if (stands_open(object, doors)) continue;
    const bool is_furnishing =
        std::find(object.tags.begin(), object.tags.end(), "furniture") != object.tags.end();
    for (const auto& triangle : object.mesh.triangles) {
      const glm::dvec3 corners[3] = {object.mesh.positions[triangle[0]],
                                     object.mesh.positions[triangle[1]],
                                     object.mesh.positions[triangle[2]]};
      cut(corners, level.floor_m + breast_m, is_furnishing ? level.furniture : level.walls);
    }
  }
  level.walls = longest_lines(std::move(level.walls));
  level.furniture = longest_lines(std::move(level.furniture));
}

struct Box2 {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
  void take(const glm::dvec2& p, double beyond = 0) {
    low = glm::min(low, p - beyond);
    high = glm::max(high, p + beyond);
  }
  bool empty() const { return !(high.x > low.x && high.y > low.y); }
};

Box2 places_on(const SceneDescription& scene, const std::vector<PlanLevel>& levels, size_t level) {
  Box2 box;
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& p : route.path)
      if (level_of(levels, p.z) == level) box.take(glm::dvec2(p), route.width_m / 2 + around_m);
  for (const AssessedArea& area : scene.open_areas)
    for (const glm::dvec2& p : area.outline)
      if (level_of(levels, area.z_m) == level) box.take(p, around_m);
  return box;
}

/// The grid of a map over a box, without values.
LightMap grid_in(const Box2& box) {
  LightMap map;
  if (box.empty()) return map;
  const glm::dvec2 size = box.high - box.low;
  const auto count = [&](double length) { return std::ceil(length / map.spacing_m - 1e-9); };
  map.spacing_m = map_spacing_m;
  while (count(size.x) * count(size.y) > static_cast<double>(limits::map_places))
    map.spacing_m *= 2;
  map.columns = static_cast<int>(count(size.x));
  map.rows = static_cast<int>(count(size.y));
  // Points in the middle of cells: few of them lie in walls, which often stand on round
  // coordinates.
  map.corner = box.low + map.spacing_m / 2;
  return map;
}

}  // namespace

std::vector<Line> longest_lines(std::vector<Line> lines) {
  if (lines.size() <= limits::plan_lines) return lines;
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return glm::length(a.second - a.first) > glm::length(b.second - b.first);
  });
  lines.resize(limits::plan_lines);
  return lines;
}

std::vector<double> floors_of(const SceneDescription& scene) {
  std::vector<double> heights;
  for (const EscapeRoute& route : scene.routes)
    for (const glm::dvec3& p : route.path) heights.push_back(p.z);
  for (const AssessedArea& area : scene.open_areas) heights.push_back(area.z_m);
  std::sort(heights.begin(), heights.end());
  std::vector<double> out;
  for (const double z : heights)
    if (out.empty() || z - out.back() >= storey_m) out.push_back(z);
  return out;
}

std::vector<PlanLevel> plan_levels(const SceneDescription& scene, const Scenario& doors) {
  std::vector<double> floors = floors_of(scene);
  if (floors.empty()) floors.push_back(0);
  floors.resize(std::min(floors.size(), limits::plan_levels));
  std::vector<PlanLevel> out;
  for (const double z : floors) {
    out.emplace_back();
    out.back().floor_m = z;
    cut_level(scene, doors, out.back());
  }
  return out;
}

size_t level_of(const std::vector<PlanLevel>& levels, double z) {
  size_t best = 0;
  for (size_t i = 0; i < levels.size(); ++i)
    if (levels[i].floor_m <= z + sunk_m) best = i;
  return best;
}

LightMap map_of(const SceneDescription& scene, const std::vector<PlanLevel>& levels, size_t level) {
  Box2 box = places_on(scene, levels, level);
  Box2 walls;
  for (const auto& [a, b] : levels[level].walls) {
    walls.take(a);
    walls.take(b);
  }
  if (!walls.empty() && !box.empty()) {
    box.low = glm::max(box.low, walls.low);
    box.high = glm::min(box.high, walls.high);
  }
  return grid_in(box);
}

LightMap map_over(const AssessedArea& area) {
  Box2 box;
  for (const glm::dvec2& p : area.outline) box.take(p);
  return grid_in(box);
}

}  // namespace luxodus
