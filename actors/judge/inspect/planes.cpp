#include <algorithm>

#include "actors/judge/inspect/site.hpp"
#include "actors/results/files/plane_cells.hpp"

namespace luxodus {

namespace {

/// A plane with a surface this close in front of it measures that surface's light [m].
constexpr Real shut_m = 0.05_r;
/// People's heads are lower; a plane this close above a ceiling was meant below it [m].
constexpr double head_height_m = 2;
constexpr double close_above_m = 0.5;
/// Share of the cells that is no coincidence.
constexpr double max_share = 0.9;
constexpr double part_share = 0.1;

/// Sampled cells of a plane: those outside, and those with a surface directly in front, and which
/// surface.
struct CellPlaces {
  int all = 0, outside = 0, shut = 0;
  uint32_t surface = 0;
};

CellPlaces places_of_cells(const Site& site, const PlaneMeasure& p,
                           const std::vector<char>& in_bodies) {
  constexpr int steps = 20;
  const int across = std::min(p.cells_u, steps), down = std::min(p.cells_v, steps);
  const glm::dvec3 normal = glm::normalize(glm::cross(p.edge_u, p.edge_v));
  const auto count = static_cast<size_t>(across) * static_cast<size_t>(down);
  std::vector<char> counts(count, 0), outside(count, 0);
  std::vector<std::optional<FacedSurface>> shut(count);
  site.building.each(count, [&](const GeometryAccess& access, size_t i) {
    const int u = static_cast<int>((static_cast<int>(i) % across + 0.5) / across * p.cells_u);
    const int v = static_cast<int>((static_cast<int>(i) / across + 0.5) / down * p.cells_v);
    if (in_bodies[static_cast<size_t>(v) * static_cast<size_t>(p.cells_u) +
                  static_cast<size_t>(u)] != 0)
      return;
    counts[i] = 1;
    const glm::dvec3 place = p.corner + p.edge_u * ((u + 0.5) / p.cells_u) +
                             p.edge_v * ((v + 0.5) / p.cells_v) + normal * above_plane_m;
    outside[i] = site.is_outside(access, place) ? 1 : 0;
    shut[i] =
        first_stop(site.building.scene(), access, site.building.local(place), Vec3(normal), shut_m,
                   [&](const FacedSurface& f) {
                     return f.surface >= site.scene.objects.size() || lets_light_through(f.kind);
                   });
  });
  CellPlaces out;
  for (size_t i = 0; i < count; ++i) {
    out.all += counts[i];
    out.outside += outside[i];
    if (!shut[i]) continue;
    ++out.shut;
    out.surface = shut[i]->surface;
  }
  return out;
}

/// Reports a plane that extends outside the building, or faces a surface directly.
void tell_places(const Site& site, const PlaneMeasure& plane, const CellPlaces& cells,
                 bool rooms_are_lit, Findings& out) {
  const std::string name = "plane \"" + plane.name + "\"";
  const auto tell = [&](Severity severity, const std::string& what) {
    out.push_back({severity, "plane", {plane.place, name + what}});
  };
  if (cells.all == 0) return;
  const glm::dvec3 middle = plane.corner + 0.5 * (plane.edge_u + plane.edge_v);
  double plane_height = 0;
  bool above_ceiling = false;
  site.building.each(1, [&](const GeometryAccess& access, size_t) {
    const glm::dvec3 normal = glm::cross(plane.edge_u, plane.edge_v);
    if (normal.z < 0.9 * glm::length(normal)) return;
    const auto below = solid_ahead(site, access, middle + glm::dvec3(0, 0, above_plane_m),
                                   glm::dvec3(0, 0, -1), floor_below_m, false);
    if (!below) return;
    plane_height = static_cast<double>(below->distance_m) - above_plane_m;
    above_ceiling = site.is_back(*below) && plane_height < close_above_m;
  });
  if (cells.shut > max_share * cells.all) {
    tell(Severity::warning,
         fmt::format(" looks at {}, less than {} before it: light is counted on the side that "
                     "cross(edge_u, edge_v) looks to; swap the two edges, or move it",
                     object_text(site.scene.objects[cells.surface]),
                     length_text(static_cast<double>(shut_m))));
    return;
  }
  if (cells.outside == cells.all) {
    if (above_ceiling) {
      tell(Severity::warning,
           " lies above the ceiling, with all of its cells: is its height right?");
      return;
    }
    if (rooms_are_lit) tell(Severity::note, " lies outside the building, with all of its cells");
    return;
  }
  if (plane_height > head_height_m)
    tell(Severity::note,
         fmt::format(" lies {} above what is below it, over people's heads: is its height right?",
                     length_text(plane_height)));
  if (cells.outside > part_share * cells.all)
    tell(Severity::warning,
         fmt::format(": {:.0f} % of its cells lie outside the building, and count in its mean, "
                     "minimum and uniformity; draw it as large as the room",
                     100.0 * cells.outside / cells.all));
}

}  // namespace

void inspect_planes(const Site& site, const std::vector<char>& outside, Findings& out) {
  const bool rooms_are_lit = std::count(outside.begin(), outside.end(), 0) > 0;
  const SceneDescription& scene = site.scene;
  for (size_t i = 0; i < scene.planes.size(); ++i) {
    const PlaneMeasure& plane = scene.planes[i];
    const std::string name = "plane \"" + plane.name + "\"";
    const auto tell = [&](Severity severity, const char* kind, const std::string& what) {
      out.push_back({severity, kind, {plane.place, what}});
    };
    if (auto far = site.remote.told(name, plane.corner + 0.5 * (plane.edge_u + plane.edge_v))) {
      tell(Severity::error, "far", *far);
      continue;
    }
    const auto inside = cells_in_bodies(site.building.scene(), site.building.rows(), i);
    const auto count = std::count(inside.begin(), inside.end(), 1);
    const auto all = static_cast<std::ptrdiff_t>(inside.size());
    tell_places(site, plane, places_of_cells(site, plane, inside), rooms_are_lit, out);
    if (count == 0) continue;
    if (count == all)
      tell(Severity::error, "plane", name + " lies inside a body, with all of its cells: move it");
    else
      tell(2 * count > all ? Severity::warning : Severity::note, "plane",
           fmt::format("{}: {} of {} cells lie inside bodies; they are left out of its mean, "
                       "minimum, maximum and map",
                       name, count, all));
  }
}

}  // namespace luxodus
