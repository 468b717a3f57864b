// The geometry of a run as data objects: every cell of the partition as bytes with a name, who
// holds it, and how a node makes a search structure of it. Bytes are made once a process; a node's
// store answers for those cells that it holds. Thread rule: SceneObjects is immutable once made;
// the rest belongs to one node.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "runtime/fetch/object_cache.hpp"
#include "scenes/transport/cell_object.hpp"
#include "scenes/transport/compiled_scene.hpp"
#include "scenes/transport/object_source.hpp"
#include "scenes/transport/packed_geometry.hpp"

namespace luxodus {

class SceneObjects {
 public:
  /// Cell i is held by the i-th of `holders`, modulo their number, and by `replicas - 1` that
  /// follow. Requires: 1 <= replicas <= holders.size(); `scene` outlives this.
  SceneObjects(const CompiledScene& scene, std::span<const NodeId> holders, uint32_t replicas);

  /// Other holders, by cell. Requires: before any node is made; 1 to limits::holders of each.
  void place(const std::vector<std::vector<NodeId>>& holders);

  const std::vector<ObjectPlace>& places() const { return places_; }
  /// Of a packed scene out of its file, and empty where that holds no objects.
  SharedBytes bytes(uint32_t cell) const;
  uint64_t wire_bytes() const { return wire_bytes_; }
  uint64_t largest_wire_bytes() const { return largest_wire_bytes_; }

 private:
  void encode(const CompiledScene& scene);

  std::shared_ptr<const PackedGeometry> packed_;  // null: the bytes are below
  std::vector<std::shared_ptr<const std::vector<std::byte>>> bytes_;
  std::vector<ObjectPlace> places_;
  uint64_t wire_bytes_ = 0;
  uint64_t largest_wire_bytes_ = 0;
};

/// The cells that one node holds for all; beyond them what its process has stored, for itself.
class HeldCells final : public ObjectStore {
 public:
  HeldCells(const SceneObjects& objects, NodeId self);
  SharedBytes find(ObjectId object) override;
  SharedBytes find_in_storage(uint32_t object) override { return objects_.bytes(object); }

 private:
  const SceneObjects& objects_;
  std::vector<std::pair<ObjectId, uint32_t>> held_;  // ascending by name
};

/// A cell's records and the search structure over them.
class BuiltCell final : public BuiltObject {
 public:
  BuiltCell(const EmbreeDevice& device, GeometryCell cell);
  size_t bytes() const override { return bytes_; }
  const CellScene& scene() const { return *scene_; }

 private:
  GeometryCell cell_;
  std::unique_ptr<CellScene> scene_;
  size_t bytes_ = 0;
};

/// Builds on the node's own thread, between the turns of its fibers.
class CellBuilder final : public ObjectBuilder {
 public:
  explicit CellBuilder(const CompiledScene& scene);
  void build(uint32_t object, SharedBytes bytes, Client& client) override;

 private:
  CellLimits limits_;
  EmbreeDevice device_;
};

/// What a node's tracers ask for cells.
class CachedCells final : public ObjectSource {
 public:
  /// `trace` is told of waits of sampled particles; null: of none.
  CachedCells(ObjectCache& cache, const Fibers& fibers, NodeTrace* trace = nullptr)
      : cache_(cache), fibers_(fibers), trace_(trace) {}

  const CellScene* cell(uint32_t cell) override;
  bool spoilt() override;

 private:
  ObjectCache& cache_;
  const Fibers& fibers_;
  NodeTrace* const trace_;
  std::vector<FiberId> refused_;  // fibers that did not get what they asked for
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

}  // namespace luxodus
