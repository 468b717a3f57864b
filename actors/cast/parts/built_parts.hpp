// What a node makes of the parts of a scene: search structures over cells, bricks of smoke data,
// tiles of pictures. Thread rule: a builder belongs to one node; what is built may be used and let
// go on any thread.
#pragma once

#include <memory>
#include <mutex>

#include "runtime/fetch/object_builder.hpp"
#include "scenes/light/transport/cell_object.hpp"
#include "scenes/light/transport/image_tile.hpp"
#include "scenes/light/transport/scene_parts.hpp"

namespace luxodus {

/// Where search structures are built, one at a time, so that what each takes can be told.
struct BuildDevice {
  /// Parts are small and come one by one: threads woken for each would mostly spin.
  EmbreeDevice embree{BuildThreads::calling};
  /// Held while one is built, and while one is let go of by a node that shared it.
  std::mutex measuring;
};

/// A cell's records and the search structure over them.
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
  /// `device`: one of several builders of a thread, or its own. Requires: scene and parts outlive
  /// this.
  PartBuilder(const CompiledScene& scene, const SceneParts& parts,
              std::shared_ptr<BuildDevice> device = std::make_shared<BuildDevice>());
  void build(uint32_t object, SharedBytes bytes, Client& client) override;

  /// The part of these bytes. Errors: bytes that are not of this part.
  Result<std::shared_ptr<const BuiltObject>> built(uint32_t object,
                                                   std::span<const std::byte> bytes);

 private:
  const CompiledScene& scene_;
  const SceneParts& parts_;
  const std::shared_ptr<BuildDevice> device_;
};

/// What a cell takes once it is built [bytes], from its bytes on the wire, for a plan before
/// anything is built: of a triangle 64 travel; 64 and Embree's 111 stay (`luxodus_bench memory`).
constexpr uint64_t built_bytes_of(uint64_t wire_bytes) {
  constexpr uint64_t of_any_cell = 2048;  // an empty search structure, and what refers to it
  return of_any_cell + wire_bytes * 3;
}
/// And the most while it is built: Embree's builder takes up to 1.6 times the result.
constexpr uint64_t peak_build_bytes_of(uint64_t wire_bytes) {
  return built_bytes_of(wire_bytes) * 8 / 5;
}
/// The same of any part. A brick of emission alone has 4 bytes a cell on the wire and 12 when its
/// running sum is made; a tile's texels stay as they came.
constexpr uint64_t built_bytes_of(ScenePart::Kind kind, uint64_t wire_bytes) {
  if (kind == ScenePart::Kind::tile) return wire_bytes + sizeof(BuiltTile);
  if (kind == ScenePart::Kind::brick) return wire_bytes * 3 + sizeof(BuiltBrick);
  return built_bytes_of(wire_bytes);
}
constexpr uint64_t peak_build_bytes_of(ScenePart::Kind kind, uint64_t wire_bytes) {
  return kind == ScenePart::Kind::cell ? peak_build_bytes_of(wire_bytes)
                                       : built_bytes_of(kind, wire_bytes);
}

/// What all data sets and pictures of a scene take once they are built, clear bricks included: the
/// same of a scene and of its pack, and known without a look at the data.
uint64_t built_bytes_beside_cells(const CompiledScene& scene);

}  // namespace luxodus
