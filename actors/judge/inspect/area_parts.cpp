// Finds areas that extend through walls: lays a grid of places over each, and joins places by
// straight steps that no wall crosses.
#include <algorithm>
#include <cmath>
#include <map>

#include "actors/judge/inspect/doorway.hpp"
#include "actors/judge/inspect/ways_size.hpp"

namespace luxodus {

namespace {

/// Spacing of places, less than any doorway, and their least distance from the outline [m].
constexpr double part_step_m = 0.5;
constexpr double part_border_m = 0.25;
/// Larger areas are halls, and get a coarser grid.
constexpr size_t max_part_places = 20'000;
/// Height of tests above a floor, and above a task plane: above tables, below lintels [m].
constexpr double over_floor_m = 1.65;
constexpr double over_task_m = 0.8;
/// How far below the area's height the floor may be [m].
constexpr double floor_slack_m = 0.3;
/// A narrower opening is a doorway, which does not make two rooms one [m].
constexpr double doorway_width_m = 1.25;
/// A part with a smaller share of the area, or with fewer places, is a niche or lies behind a
/// column.
constexpr double part_of_area = 0.1;
constexpr size_t min_part_places = 6;

struct PartGrid {
  std::vector<glm::dvec3> places;               // at the height of the wall tests
  std::vector<std::pair<size_t, size_t>> legs;  // pairs of neighbours, to the east and to the north
};

PartGrid grid_over(const AssessedArea& area, double above_m) {
  const PlanBox box = plan_box_of(area);
  const glm::dvec2 low = box.low, size = box.size();
  const double step = spacing_within(area, part_step_m, max_part_places);
  PartGrid grid;
  grid.places = within(area, part_border_m, step);
  // Neighbours are about one step apart, all others of a row or a column two or more.
  std::map<std::pair<int64_t, int64_t>, size_t> at;
  const auto pitch = [&](double length) {
    const double inner = length - 2 * part_border_m;
    return std::max(inner / std::max(1.0, std::ceil(inner / step * (1 - 1e-9))), 1e-6);
  };
  const glm::dvec2 apart(pitch(size.x), pitch(size.y));
  for (size_t i = 0; i < grid.places.size(); ++i) {
    const glm::dvec2 cell = (glm::dvec2(grid.places[i]) - low - part_border_m) / apart;
    at[{std::llround(cell.x), std::llround(cell.y)}] = i;
    grid.places[i].z += above_m;
  }
  for (const auto& [cell, i] : at)
    for (const auto& next : {std::pair(cell.first + 1, cell.second), {cell.first, cell.second + 1}})
      if (const auto other = at.find(next); other != at.end())
        grid.legs.emplace_back(i, other->second);
  return grid;
}

/// Whether a person can stand there: on a floor, not in a wall, not in a doorway.
bool is_room_place(const Site& site, const GeometryAccess& access, const glm::dvec3& place,
                   double floor_within_m, const std::vector<char>& furniture) {
  if (!solid_ahead(site, access, place, glm::dvec3(0, 0, -1), floor_within_m)) return false;
  if (site.building.in_solid(access, place, furniture)) return false;
  for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
    double clear = 0;
    for (const glm::dvec3& to : {way, -way}) {
      const auto wall = wall_ahead(site, access, place, to, doorway_width_m);
      clear += wall ? static_cast<double>(wall->distance_m) : doorway_width_m;
    }
    if (clear < doorway_width_m) return false;
  }
  return true;
}

/// Places by part, the largest part first.
std::vector<std::vector<size_t>> parts_of(size_t places, const std::vector<char>& counts,
                                          const std::vector<std::pair<size_t, size_t>>& joined) {
  std::vector<size_t> root(places);
  for (size_t i = 0; i < places; ++i) root[i] = i;
  const auto find = [&](size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b] : joined) root[find(a)] = find(b);
  std::map<size_t, std::vector<size_t>> by_root;
  for (size_t i = 0; i < places; ++i)
    if (counts[i] != 0) by_root[find(i)].push_back(i);
  std::vector<std::vector<size_t>> out;
  for (auto& [at, part] : by_root) out.push_back(std::move(part));
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return out;
}

void tell_parts(const Site& site, const char* word, const AssessedArea& area, bool is_floor,
                Findings& out) {
  const double above = is_floor ? over_floor_m : over_task_m;
  const PartGrid grid = grid_over(area, above);
  const std::vector<char> furniture = furniture_of(site);
  std::vector<char> counts(grid.places.size(), 0), free(grid.legs.size(), 0);
  // A task plane is at table height above the floor.
  const double floor_m = above + floor_slack_m + (is_floor ? 0 : over_floor_m);
  site.building.each(grid.places.size(), [&](const GeometryAccess& access, size_t i) {
    counts[i] = is_room_place(site, access, grid.places[i], floor_m, furniture) ? 1 : 0;
  });
  site.building.each(grid.legs.size(), [&](const GeometryAccess& access, size_t i) {
    const auto& [from, to] = grid.legs[i];
    if (counts[from] == 0 || counts[to] == 0) return;
    const glm::dvec3 way = grid.places[to] - grid.places[from];
    const double length = glm::length(way);
    free[i] = wall_ahead(site, access, grid.places[from], way / length, length) ? 0 : 1;
  });
  std::vector<std::pair<size_t, size_t>> joined;
  for (size_t i = 0; i < grid.legs.size(); ++i)
    if (free[i] != 0) joined.push_back(grid.legs[i]);
  const auto parts = parts_of(grid.places.size(), counts, joined);
  if (parts.size() < 2) return;
  const auto all = static_cast<double>(std::count(counts.begin(), counts.end(), 1));
  const auto second = static_cast<double>(parts[1].size());
  if (parts[1].size() < min_part_places || second < part_of_area * all) return;
  const glm::dvec3 there = grid.places[parts[1][parts[1].size() / 2]] - glm::dvec3(0, 0, above);
  out.push_back(
      {Severity::warning,
       "area",
       {area.place, fmt::format("{} \"{}\" reaches through walls: {} of it, such as {}, lie beyond "
                                "them; draw one for each room, within its walls",
                                word, area.name, percent_text(second / all), place_text(there))}});
}

}  // namespace

void inspect_area_parts(const Site& site, Findings& out) {
  for (const AssessedArea& area : site.scene.open_areas)
    tell_parts(site, "open area", area, true, out);
  for (const AssessedArea& area : site.scene.task_areas)
    tell_parts(site, "task area", area, false, out);
}

}  // namespace luxodus
