// The parts of a run's scene as bytes with ids (cells, bricks, tiles), their holders, and the
// tracers' access to them. Bytes are made once per process; a node's store serves those that it
// holds. Thread rule: SceneObjects is immutable after start; the rest belongs to one node.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "actors/cast/parts/built_parts.hpp"
#include "actors/cast/parts/parts_source.hpp"
#include "runtime/fetch/object_cache.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/object_source.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

class SceneObjects {
 public:
  /// Object i is part i of the scene. It is held by the i-th of `holders`, modulo their number, and
  /// by the `replicas - 1` that follow. Requires: 1 <= replicas <= holders.size(); `scene` outlives
  /// this.
  SceneObjects(const CompiledScene& scene, std::span<const NodeId> holders, uint32_t replicas);

  /// Sets other holders, by object. Requires: before any node is made; 1 to limits::holders for
  /// each.
  void place(const std::vector<std::vector<NodeId>>& holders);

  const SceneParts& parts() const { return parts_; }
  const std::vector<ObjectPlace>& places() const { return places_; }
  /// For a packed scene read from its file; empty if that contains no objects.
  SharedBytes bytes(uint32_t object) const;
  /// "scene part 7 of tower.luxpack"; for a scene that is not packed, its file.
  std::string stored_name(uint32_t object) const;
  uint64_t wire_bytes() const { return wire_bytes_; }
  uint64_t largest_wire_bytes() const { return largest_wire_bytes_; }
  /// Largest expected peak memory of a build.
  uint64_t largest_build_bytes() const { return largest_build_bytes_; }
  /// Expected memory of a built object.
  uint64_t built_bytes(uint32_t object) const {
    return built_bytes_of(parts_[object].kind, places_[object].wire_bytes);
  }

 private:
  void encode(const CompiledScene& scene);

  SceneParts parts_;
  std::shared_ptr<const PackedScene> packed_;  // null: the bytes are below
  std::string file_;                           // of the scene, or of its pack
  std::vector<std::shared_ptr<const std::vector<std::byte>>> bytes_;
  std::vector<ObjectPlace> places_;
  uint64_t wire_bytes_ = 0;
  uint64_t largest_wire_bytes_ = 0;
  uint64_t largest_build_bytes_ = 0;
};

/// Expected memory of all built parts of a scene [bytes]: budgets are given as shares of it.
uint64_t built_bytes_of(const CompiledScene& scene);

/// The objects that one node holds for all; for itself also what its process has stored.
class HeldObjects final : public ObjectStore {
 public:
  HeldObjects(const SceneObjects& objects, NodeId self);
  SharedBytes find(ObjectId object) override;
  SharedBytes find_in_storage(uint32_t object) override { return objects_.bytes(object); }
  std::string stored_name(uint32_t object) const override { return objects_.stored_name(object); }

 private:
  const SceneObjects& objects_;
  std::vector<std::pair<ObjectId, uint32_t>> held_;  // sorted by id
};

/// The tracers' access to parts of the scene, through a node's cache.
class CachedObjects final : public PartsSource<CachedObjects> {
 public:
  /// When a fiber waits for a cell, `prefetch` of the cells that the ray enters next are requested
  /// as well. `trace` records waits of sampled particles; null: none.
  CachedObjects(const SceneParts& parts, ObjectCache& cache, const Fibers& fibers,
                size_t prefetch = 0, NodeTrace* trace = nullptr)
      : PartsSource(parts), cache_(cache), fibers_(fibers), prefetch_(prefetch), trace_(trace) {}

  bool spoilt() override;

 private:
  friend PartsSource;

  const BuiltObject* part(uint32_t object, std::span<const Candidate> next);
  const BuiltObject* wait_for(uint32_t object, std::span<const Candidate> next);

  ObjectCache& cache_;
  const Fibers& fibers_;
  const size_t prefetch_;
  NodeTrace* const trace_;
  std::vector<uint32_t> ahead_;   // to be prefetched
  std::vector<FiberId> refused_;  // fibers whose request failed
};

}  // namespace luxodus
