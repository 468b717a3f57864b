#include "actors/inspect/plane_cells.hpp"

#include <algorithm>

#include "actors/inspect/site.hpp"

namespace luxodus {

namespace {

/// A plane that lies in a floor or a table's top is looked at from above it [m].
constexpr double above_plane_m = 1e-3;
/// Right above the floor half of all directions show a body's bottom, or the floor that it stands
/// on and that lies in the same plane. So high up few do [m].
constexpr Real off_the_floor_m = 0.25_r;

/// In a body where it is, or as what is above it with nothing in between.
bool lies_in_body(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place,
                  const Vec3& normal, std::span<const char> turned) {
  if (in_body(scene, access, place, turned)) return true;
  const Vec3 above = place + normal * off_the_floor_m;
  return in_body(scene, access, above, turned) &&
         !first_stop(scene, access, place, normal, off_the_floor_m, [&](const Facing& f) {
           return f.surface >= scene.description->objects.size() || lets_light_through(f.kind);
         });
}

}  // namespace

std::vector<char> cells_in_bodies(const CompiledScene& scene, const ParallelFor& rows,
                                  size_t plane) {
  const PlaneMeasure& p = scene.description->planes[plane];
  const auto columns = static_cast<size_t>(p.cells_u);
  std::vector<char> inside(columns * static_cast<size_t>(p.cells_v), 0);
  const glm::dvec3 normal = glm::normalize(glm::cross(p.edge_u, p.edge_v));
  std::vector<char> turned;
  rows.run(1, [&](const GeometryAccess& access) -> ParallelFor::Worker {
    return [&, access](int64_t) { turned = turned_surfaces(scene, access); };
  });
  rows.run(p.cells_v, [&](const GeometryAccess& access) -> ParallelFor::Worker {
    return [&, access](int64_t row) {
      for (size_t u = 0; u < columns; ++u) {
        const glm::dvec3 centre = p.corner +
                                  p.edge_u * ((static_cast<double>(u) + 0.5) / p.cells_u) +
                                  p.edge_v * ((static_cast<double>(row) + 0.5) / p.cells_v);
        const Vec3 place(centre + normal * above_plane_m - scene.local_origin);
        if (lies_in_body(scene, access, place, Vec3(normal), turned))
          inside[static_cast<size_t>(row) * columns + u] = 1;
      }
    };
  });
  return inside;
}

void inspect_planes(const Site& site, Findings& out) {
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
