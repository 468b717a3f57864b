#include "scenes/light/transport/scene_parts.hpp"

#include <algorithm>

#include "scenes/light/transport/brick_object.hpp"
#include "scenes/light/transport/cell_object.hpp"
#include "scenes/light/transport/image_tile.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace {

std::vector<BrickTable> tables_of(const CompiledScene& scene) {
  if (scene.description->packed != nullptr) return scene.description->packed->tables;
  std::vector<BrickTable> tables;
  for (const Medium& medium : scene.description->media)
    tables.push_back(medium.kind == MediumKind::data_set ? brick_table(medium.data) : BrickTable{});
  return tables;
}

bool needed(const Medium& medium, const BrickTable& table, size_t brick) {
  const bool interpolates = medium.data.interpolate_emission && table.has_emission;
  return table.has_arrays() && !table.clear(brick, medium.emission.has_value(), interpolates);
}

uint64_t tiles_of(const Image& image) {
  return uint64_t{tile_columns(image)} * tile_rows(image);
}

}  // namespace

SceneParts::SceneParts(const SceneDescription& description, size_t cells,
                       std::vector<BrickTable> tables)
    : tables_(std::move(tables)) {
  for (uint32_t cell = 0; cell < cells; ++cell) parts_.push_back({ScenePart::Kind::cell, 0, cell});
  const auto next = [this] { return static_cast<uint32_t>(parts_.size()); };
  for (uint32_t m = 0; m < description.media.size(); ++m) {
    std::vector<uint32_t>& numbers = brick_.emplace_back();
    for (uint32_t brick = 0; brick < tables_[m].bricks.size(); ++brick) {
      const bool is_part = needed(description.media[m], tables_[m], brick);
      numbers.push_back(is_part ? next() : none_index);
      if (is_part) parts_.push_back({ScenePart::Kind::brick, m, brick});
    }
  }
  const auto images = distinct_images(description);
  for (uint32_t i = 0; i < images.size(); ++i) {
    first_tile_.push_back(next());
    for (uint32_t tile = 0; tile < tiles_of(*images[i]); ++tile)
      parts_.push_back({ScenePart::Kind::tile, i, tile});
  }
}

SceneParts::SceneParts(const CompiledScene& scene)
    : SceneParts(*scene.description, scene.cell_boxes.size(), tables_of(scene)) {}

uint64_t SceneParts::count_of(const SceneDescription& description, size_t cells,
                              const std::vector<BrickTable>& tables) {
  uint64_t count = cells;
  for (size_t m = 0; m < description.media.size(); ++m)
    for (size_t brick = 0; brick < tables[m].bricks.size(); ++brick)
      count += needed(description.media[m], tables[m], brick) ? 1 : 0;
  for (const auto& image : distinct_images(description)) count += tiles_of(*image);
  return count;
}

bool in_parts(const CompiledScene& scene) {
  return scene.cell_boxes.size() > 1 || !scene.images.empty() ||
         !scene.media.tables().grids.empty();
}

std::vector<std::shared_ptr<const Image>> distinct_images(const SceneDescription& description) {
  std::vector<std::shared_ptr<const Image>> images;
  for (const Material& material : description.materials) {
    const auto& image = material.reflectance_image;
    if (image != nullptr && std::find(images.begin(), images.end(), image) == images.end())
      images.push_back(image);
  }
  return images;
}

std::vector<std::byte> encode_part(const CompiledScene& scene, const ScenePart& part) {
  switch (part.kind) {
    case ScenePart::Kind::cell:
      return encode_cell(scene.cells[part.index]);
    case ScenePart::Kind::brick:
      return encode_brick(cut_brick(scene.description->media[part.owner].data, part.index));
    case ScenePart::Kind::tile:
      break;
  }
  return encode_tile(cut_tile(*scene.images[part.owner], part.index));
}

}  // namespace luxodus
