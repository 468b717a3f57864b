#include "actors/results/files/plane_cells.hpp"

#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

namespace {

/// Just above the floor, half of all directions hit a body's bottom, or the floor that it stands on
/// in the same plane. At this height few do [m].
constexpr Real off_the_floor_m = 0.25_r;

/// Whether a place lies in a body, or directly below one with nothing in between.
bool lies_in_body(const CompiledScene& scene, const GeometryAccess& access, const Vec3& place,
                  const Vec3& normal, std::span<const char> turned) {
  if (in_body(scene, access, place, turned)) return true;
  const Vec3 above = place + normal * off_the_floor_m;
  return in_body(scene, access, above, turned) &&
         !first_stop(scene, access, place, normal, off_the_floor_m, [&](const FacedSurface& f) {
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

}  // namespace luxodus
