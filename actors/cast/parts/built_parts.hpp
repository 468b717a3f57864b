// Objects built from the parts of a scene: search structures over cells, bricks of smoke data,
// tiles of pictures. Thread rule: a builder belongs to one node; built objects may be used and
// released on any thread.
#pragma once

#include <memory>
#include <mutex>

#include "runtime/fetch/object_builder.hpp"
#include "scenes/light/transport/cell_object.hpp"
#include "scenes/light/transport/image_tile.hpp"
#include "scenes/light/transport/scene_parts.hpp"

namespace luxodus {

/// Embree device for builds, one at a time, so that the memory of each can be measured.
struct BuildDevice {
  /// Parts are small and come one by one: threads woken for each would mostly spin.
  EmbreeDevice embree{BuildThreads::calling};
  /// Held during a build, and while a node releases a shared object.
  std::mutex measuring;
};

/// A cell's geometry and the search structure over it.
class BuiltCell final : public BuiltObject {
 public:
  BuiltCell(std::shared_ptr<BuildDevice> device, GeometryCell cell);
  ~BuiltCell() override;
  size_t bytes() const override { return bytes_; }
  SharedBytes wire_bytes() const override;
  const CellScene& scene() const { return *scene_; }

 private:
  std::shared_ptr<BuildDevice> device_;
  GeometryCell cell_;
  std::unique_ptr<CellScene> scene_;
  size_t bytes_ = 0;
};

class BuiltBrick final : public BuiltObject {
 public:
  explicit BuiltBrick(Brick brick) : brick_(std::move(brick)) {}
  size_t bytes() const override { return sizeof *this - sizeof brick_ + brick_.bytes(); }
  SharedBytes wire_bytes() const override;
  const Brick& brick() const { return brick_; }

 private:
  Brick brick_;
};

class BuiltTile final : public BuiltObject {
 public:
  explicit BuiltTile(ImageTile tile) : tile_(std::move(tile)) {}
  size_t bytes() const override { return sizeof *this + tile_.texels.capacity() * sizeof(float); }
  SharedBytes wire_bytes() const override;
  const ImageTile& tile() const { return tile_; }

 private:
  ImageTile tile_;
};

/// Builds on the node's own thread, between the turns of its fibers.
class PartBuilder final : public ObjectBuilder {
 public:
  /// `device` may be shared by builders of one thread. Requires: scene and parts outlive this.
  PartBuilder(const CompiledScene& scene, const SceneParts& parts,
              std::shared_ptr<BuildDevice> device = std::make_shared<BuildDevice>());
  void build(uint32_t object, SharedBytes bytes, Client& client) override;

  /// Builds a part. Errors: bytes that are not of this part.
  Result<std::shared_ptr<const BuiltObject>> built(uint32_t object,
                                                   std::span<const std::byte> bytes);

 private:
  const CompiledScene& scene_;
  const SceneParts& parts_;
  const std::shared_ptr<BuildDevice> device_;
};

/// Estimated memory of a built cell [bytes] from its serialised size, for planning: a triangle has
/// 64 bytes on the wire, and 64 plus Embree's 111 in memory (`luxodus_bench memory`).
constexpr uint64_t built_bytes_of(uint64_t wire_bytes) {
  constexpr uint64_t of_any_cell = 2048;  // an empty search structure, and its owner
  return of_any_cell + wire_bytes * 3;
}
/// Peak memory during the build: Embree's builder takes up to 1.6 times the result.
constexpr uint64_t peak_build_bytes_of(uint64_t wire_bytes) {
  return built_bytes_of(wire_bytes) * 8 / 5;
}
/// The estimate for any part. A brick of emission alone has 4 bytes a cell on the wire and 12 with
/// its running sum; a tile's texels stay as they are.
constexpr uint64_t built_bytes_of(ScenePart::Kind kind, uint64_t wire_bytes) {
  if (kind == ScenePart::Kind::tile) return wire_bytes + sizeof(BuiltTile);
  if (kind == ScenePart::Kind::brick) return wire_bytes * 3 + sizeof(BuiltBrick);
  return built_bytes_of(wire_bytes);
}
constexpr uint64_t peak_build_bytes_of(ScenePart::Kind kind, uint64_t wire_bytes) {
  return kind == ScenePart::Kind::cell ? peak_build_bytes_of(wire_bytes)
                                       : built_bytes_of(kind, wire_bytes);
}

/// Memory of all built data sets and pictures of a scene, clear bricks included: equal for a scene
/// and its pack, and known without reading the data.
uint64_t built_bytes_beside_cells(const CompiledScene& scene);

}  // namespace luxodus
