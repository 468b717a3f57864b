#include "scenes/light/transport/packed_scene.hpp"

#include "runtime/core/hash.hpp"
#include "scenes/light/transport/brick_object.hpp"
#include "scenes/light/transport/cell_object.hpp"
#include "scenes/light/transport/flame_points.hpp"
#include "scenes/light/transport/image_tile.hpp"

namespace luxodus {

namespace {

std::vector<std::vector<glm::vec3>> all_flame_points(const CompiledScene& scene) {
  std::vector<std::vector<glm::vec3>> points;
  ResidentBricks bricks(scene.media);
  const auto& media = scene.description->media;
  for (uint32_t m = 0; m < media.size(); ++m) {
    points.emplace_back();
    if (media[m].kind == MediumKind::data_set && media[m].emission)
      points.back() = flame_points(scene.media, m, bricks);
  }
  return points;
}

Result<Brick> load_brick(const PackedScene& packed, const SceneParts& parts, uint32_t medium,
                         uint32_t brick) {
  const uint32_t object = parts.of_brick(static_cast<int>(medium), static_cast<int>(brick));
  if (object == none_index) return clear_brick();
  const auto bytes = object_bytes(packed, object);
  if (!bytes) return bytes.problem();
  auto decoded = decode_brick(bytes.value(), parts.table(medium), brick);
  if (!decoded) return problem_in(packed.file->name(), decoded.problem());
  return decoded;
}

Result<ImageTile> load_tile(const PackedScene& packed, const SceneParts& parts, uint32_t index,
                            const Image& image, uint32_t tile) {
  const auto bytes = object_bytes(packed, parts.of_tile(index, tile));
  if (!bytes) return bytes.problem();
  auto decoded = decode_tile(bytes.value(), image, tile);
  if (!decoded) return problem_in(packed.file->name(), decoded.problem());
  return decoded;
}

Result<std::shared_ptr<const Image>> load_image(const CompiledScene& scene, const SceneParts& parts,
                                                uint32_t index) {
  const PackedScene& packed = *scene.description->packed;
  auto image = std::make_shared<Image>(*scene.images[index]);
  image->texels.resize(static_cast<size_t>(image->width) * static_cast<size_t>(image->height) *
                       static_cast<size_t>(image->channels));
  for (uint32_t tile = 0; tile < tile_columns(*image) * tile_rows(*image); ++tile) {
    const auto decoded = load_tile(packed, parts, index, *image, tile);
    if (!decoded) return decoded.problem();
    place_tile(decoded.value(), tile, *image);
  }
  return std::shared_ptr<const Image>(std::move(image));
}

}  // namespace

PackedScene summary_of(const CompiledScene& scene, const SceneParts& parts, int partition) {
  PackedScene out;
  out.partition = partition;
  out.open_doors = open_doors(*scene.description, scene.scenario);
  out.bounds = scene.bounds;
  out.surfaces = scene.surfaces;
  out.triangles = scene.triangles;
  out.patch_count = scene.patch_count;
  out.total_area_m2 = scene.total_area_m2;
  for (const GeometryCell& cell : scene.cells)
    out.cells.push_back({cell.low, cell.high, static_cast<uint32_t>(cell.triangles.size())});
  out.tables = parts.tables();
  out.flame_points = all_flame_points(scene);
  out.objects.resize(parts.count());
  for (const Problem& warning : scene.warnings) out.warnings.push_back(warning.what);
  return out;
}

Result<std::span<const std::byte>> object_bytes(const PackedScene& packed, uint32_t object) {
  const auto bytes = packed.file->object(object);
  const SourcePlace place{packed.file->name(), 0};
  if (bytes.empty()) {
    return problem_in(place,
                      "this pack holds no objects, so the whole scene cannot be read from it: "
                      "use the pack that it was made of");
  }
  if (object_id_of(bytes) != packed.objects[object].id)
    return problem_in(place,
                      "scene part " + std::to_string(object) +
                          " of this pack is damaged: pack the scene again, or copy the pack again");
  return bytes;
}

Result<GeometryCell> load_cell(const CompiledScene& scene, uint32_t cell) {
  if (scene.description->packed == nullptr) return scene.cells[cell];
  const PackedScene& packed = *scene.description->packed;
  const auto bytes = object_bytes(packed, cell);
  if (!bytes) return bytes.problem();
  auto decoded =
      decode_cell(bytes.value(), {static_cast<uint32_t>(scene.surfaces.size()), scene.patch_count});
  if (!decoded) return problem_in(packed.file->name(), decoded.problem());
  return decoded;
}

Result<void> check_objects(const CompiledScene& scene) {
  if (scene.description->packed == nullptr) return {};
  const PackedScene& packed = *scene.description->packed;
  const SceneParts parts(scene);
  for (uint32_t i = 0; i < parts.count(); ++i) {
    const ScenePart part = parts[i];
    const auto checked = [](const auto& read) {
      return read ? Result<void>() : Result<void>(read.problem());
    };
    Result<void> ok;
    if (part.kind == ScenePart::Kind::cell) {
      ok = checked(load_cell(scene, part.index));
    } else if (part.kind == ScenePart::Kind::brick) {
      ok = checked(load_brick(packed, parts, part.owner, part.index));
    } else {
      ok = checked(load_tile(packed, parts, part.owner, *scene.images[part.owner], part.index));
    }
    if (!ok) return ok.problem();
  }
  return {};
}

Result<std::shared_ptr<const MediaBricks>> load_bricks(const CompiledScene& scene) {
  if (scene.description->packed == nullptr) return scene.media.bricks();
  const SceneParts parts(scene);
  MediaBricks out(scene.description->media.size());
  for (const PlacedGrid& placed : scene.media.tables().grids) {
    const auto medium = static_cast<uint32_t>(placed.grid.medium());
    for (uint32_t i = 0; i < parts.table(medium).bricks.size(); ++i) {
      auto brick = load_brick(*scene.description->packed, parts, medium, i);
      if (!brick) return brick.problem();
      out[medium].push_back(std::move(brick).value());
    }
  }
  return std::make_shared<const MediaBricks>(std::move(out));
}

Result<std::vector<std::shared_ptr<const Image>>> load_images(const CompiledScene& scene) {
  if (scene.description->packed == nullptr) return scene.images;
  const SceneParts parts(scene);
  std::vector<std::shared_ptr<const Image>> out;
  for (uint32_t i = 0; i < scene.images.size(); ++i) {
    auto image = load_image(scene, parts, i);
    if (!image) return image.problem();
    out.push_back(std::move(image).value());
  }
  return out;
}

}  // namespace luxodus
