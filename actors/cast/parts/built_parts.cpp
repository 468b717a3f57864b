#include "actors/cast/parts/built_parts.hpp"

#include "scenes/light/transport/brick_object.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace {

SharedBytes shared(std::vector<std::byte> bytes) {
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  return {std::span(*owner), owner};
}

}  // namespace

BuiltCell::BuiltCell(std::shared_ptr<BuildDevice> device, GeometryCell cell)
    : device_(std::move(device)), cell_(std::move(cell)) {
  const std::lock_guard lock(device_->measuring);
  const int64_t before = device_->embree.bytes();
  scene_ = std::make_unique<CellScene>(device_->embree, cell_);
  bytes_ = sizeof *this + static_cast<size_t>(device_->embree.bytes() - before) +
           cell_.triangles.capacity() * sizeof(TriangleRecord) +
           cell_.texture_uv.capacity() * sizeof(GeometryCell::TriangleUv);
}

BuiltCell::~BuiltCell() {
  const std::lock_guard lock(device_->measuring);
  scene_.reset();
}

SharedBytes BuiltCell::wire_bytes() const {
  return shared(encode_cell(cell_));
}
SharedBytes BuiltBrick::wire_bytes() const {
  return shared(encode_brick(brick_));
}
SharedBytes BuiltTile::wire_bytes() const {
  return shared(encode_tile(tile_));
}

PartBuilder::PartBuilder(const CompiledScene& scene, const SceneParts& parts,
                         std::shared_ptr<BuildDevice> device)
    : scene_(scene), parts_(parts), device_(std::move(device)) {}

void PartBuilder::build(uint32_t object, SharedBytes bytes, Client& client) {
  client.built(object, built(object, bytes.bytes));
}

Result<std::shared_ptr<const BuiltObject>> PartBuilder::built(uint32_t object,
                                                              std::span<const std::byte> bytes) {
  const ScenePart& part = parts_[object];
  std::shared_ptr<const BuiltObject> out;
  switch (part.kind) {
    case ScenePart::Kind::cell: {
      auto cell =
          decode_cell(bytes, {static_cast<uint32_t>(scene_.surfaces.size()), scene_.patch_count});
      if (!cell) return cell.problem();
      out = std::make_shared<BuiltCell>(device_, std::move(cell).value());
      break;
    }
    case ScenePart::Kind::brick: {
      auto brick = decode_brick(bytes, parts_.table(part.owner), part.index);
      if (!brick) return brick.problem();
      out = std::make_shared<BuiltBrick>(std::move(brick).value());
      break;
    }
    case ScenePart::Kind::tile: {
      auto tile = decode_tile(bytes, *scene_.images[part.owner], part.index);
      if (!tile) return tile.problem();
      out = std::make_shared<BuiltTile>(std::move(tile).value());
      break;
    }
  }
  return out;
}

uint64_t built_bytes_beside_cells(const CompiledScene& scene) {
  const SceneDescription& description = *scene.description;
  const PackedScene* packed = description.packed.get();
  uint64_t bytes = 0;
  for (size_t m = 0; m < description.media.size(); ++m) {
    const Medium& medium = description.media[m];
    if (medium.kind != MediumKind::data_set) continue;
    const DataSet& d = medium.data;
    const BrickTable has =
        packed != nullptr
            ? packed->tables[m]
            : BrickTable{!d.extinction.empty(), !d.albedo.empty(), !d.emission.empty(), {}};
    // Emission needs a running sum besides, in double.
    const size_t floats =
        (has.has_extinction ? 1u : 0u) + (has.has_albedo ? 1u : 0u) + (has.has_emission ? 3u : 0u);
    bytes += brick_count(d) * (sizeof(BuiltBrick) + floats * limits::brick_cells * sizeof(float));
  }
  for (const auto& image : scene.images)
    bytes += static_cast<uint64_t>(image->width) * static_cast<uint64_t>(image->height) *
             static_cast<uint64_t>(image->channels) * sizeof(float);
  return bytes;
}

}  // namespace luxodus
