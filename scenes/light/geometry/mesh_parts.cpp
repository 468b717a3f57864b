#include "scenes/light/geometry/mesh_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/core/printable.hpp"

namespace luxodus {

MeshParts::MeshParts(std::string path, double metres_per_unit, UpAxis up)
    : path_(std::move(path)), to_scene_(to_z_up(up) * scaling(glm::dvec3(metres_per_unit))) {}

Result<void> MeshParts::check_finite(const ImportedPart& part) const {
  const Mesh& mesh = part.mesh;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!is_finite(mesh.positions[i]))
      return problem(fmt::format("part \"{}\": the position of vertex {} is not a finite number",
                                 excerpt(part.name), i + 1));
  }
  for (size_t i = 0; i < mesh.texture_uv.size(); ++i) {
    if (!std::isfinite(mesh.texture_uv[i].x) || !std::isfinite(mesh.texture_uv[i].y))
      return problem(
          fmt::format("part \"{}\": the texture coordinate of vertex {} is not a finite number",
                      excerpt(part.name), i + 1));
  }
  return {};
}

Result<void> MeshParts::add(ImportedPart part, const Transform& place) {
  vertices_ += part.mesh.positions.size();
  triangles_ += part.mesh.triangles.size();
  if (vertices_ > limits::mesh_vertices || triangles_ > limits::mesh_triangles ||
      parts_.size() >= limits::mesh_parts)
    return problem(
        fmt::format("more than {} vertices, {} triangles or {} parts: simplify or split the file",
                    limits::mesh_vertices, limits::mesh_triangles, limits::mesh_parts));
  if (part.mesh.triangles.empty()) return {};
  if (!place.usable())
    return problem(
        fmt::format("part \"{}\": its node is scaled by 0 or not finite", excerpt(part.name)));
  if (auto ok = check_finite(part); !ok) return ok.problem();
  apply(place, part.mesh);
  for (const glm::dvec3& p : part.mesh.positions) {
    const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (farthest <= limits::mesh_coordinate_m) continue;
    return problem(
        fmt::format("part \"{}\": a coordinate of {:.3g} m, the most are {:g} m: is the "
                    "unit right?",
                    excerpt(part.name), farthest, limits::mesh_coordinate_m));
  }
  join_identical_vertices(part.mesh);
  part.degenerate_triangles = clean_mesh(part.mesh);
  if (part.mesh.triangles.empty()) {
    homeless_degenerates_ += part.degenerate_triangles;
    return {};
  }
  if (part.base_colour) {
    for (const double c : {part.base_colour->x, part.base_colour->y, part.base_colour->z}) {
      if (c >= 0 && c <= 1) continue;  // NaN fails
      return problem(
          fmt::format("material \"{}\": a component of its base colour is {:g}: give 0 to 1",
                      excerpt(part.material_name), c));
    }
  }
  const std::string wish = part.name;
  while (times_used_.contains(part.name))
    part.name = fmt::format("{}#{}", wish, ++times_used_[wish]);
  times_used_[part.name] = 1;
  parts_.push_back(std::move(part));
  return {};
}

Result<std::vector<ImportedPart>> MeshParts::take() {
  if (parts_.empty() && homeless_degenerates_ > 0)
    return problem(
        fmt::format("all {} triangles are degenerate: none has an area", homeless_degenerates_));
  if (parts_.empty())
    return problem("the file holds no triangles: points, lines and empty objects are not read");
  parts_.front().degenerate_triangles += std::exchange(homeless_degenerates_, 0);
  return std::move(parts_);
}

}  // namespace luxodus
