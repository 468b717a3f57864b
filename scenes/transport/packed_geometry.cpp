#include "scenes/transport/packed_geometry.hpp"

#include "runtime/core/hash.hpp"
#include "scenes/transport/cell_object.hpp"

namespace luxodus {

PackedGeometry summary_of(const CompiledScene& scene, int partition) {
  PackedGeometry out;
  out.partition = partition;
  out.open_doors = open_doors(*scene.description, scene.scenario);
  out.bounds = scene.bounds;
  out.surfaces = scene.surfaces;
  out.triangles = scene.triangles;
  out.patch_count = scene.patch_count;
  out.total_area_m2 = scene.total_area_m2;
  for (const GeometryCell& cell : scene.cells) {
    const auto count = static_cast<uint32_t>(cell.triangles.size());
    out.cells.push_back({cell.low, cell.high, count, {}, 0});
  }
  for (const Problem& warning : scene.warnings) out.warnings.push_back(warning.what);
  return out;
}

Result<GeometryCell> load_cell(const CompiledScene& scene, uint32_t cell) {
  if (scene.description->packed == nullptr) return scene.cells[cell];
  const PackedGeometry& packed = *scene.description->packed;
  const auto bytes = packed.file->object(cell);
  const SourcePlace place{packed.file->name(), 0};
  if (bytes.empty()) {
    return Problem{place,
                   "this pack holds no objects, so the whole scene cannot be read from it: "
                   "use the pack that it was made of"};
  }
  if (object_id_of(bytes) != packed.cells[cell].object)
    return Problem{place, "geometry cell " + std::to_string(cell) +
                              " of this pack is damaged: pack the scene again"};
  auto decoded =
      decode_cell(bytes, {static_cast<uint32_t>(scene.surfaces.size()), scene.patch_count});
  if (!decoded.ok()) return Problem{place, decoded.problem().what};
  return decoded;
}

}  // namespace luxodus
