// Resolvers: how the transport loop reads what lies beyond the skeleton. The loop asks; a resolver
// answers at once (everything resident), or may wait in between (a fiber that fetches). What it
// answers is the same content either way, so the bits are the same. A reference that a resolver
// returns is good until its next call.
//
// A resolver has: nearest(ray) -> Hit, occluded(ray) -> bool, cell_of(hit) -> const GeometryCell&,
// brick(medium, brick) -> const Brick&, web(index) -> const PhotometricWeb&, image(index) -> const
// Image&.
#pragma once

#include <memory>
#include <vector>

#include "scenes/intersect/embree_scene.hpp"
#include "scenes/transport/compiled_scene.hpp"
#include "scenes/transport/object_source.hpp"

namespace luxodus {

/// The search structures over a scene's cells, built once and shared by all threads.
class SceneIndex {
 public:
  /// Requires: `scene` outlives this.
  /// Errors (exception): a packed scene whose triangles cannot be read.
  SceneIndex(const EmbreeDevice& device, const CompiledScene& scene);
  const CellScene& cell(uint32_t i) const { return *cells_[i]; }
  size_t cells() const { return cells_.size(); }
  /// Requires: cells() > 1.
  const ProxyScene& proxies() const { return *proxies_; }

 private:
  std::vector<GeometryCell> loaded_;  // of a packed scene
  std::vector<std::unique_ptr<CellScene>> cells_;
  std::unique_ptr<ProxyScene> proxies_;
};

/// Everything but geometry, resident.
class ResidentData {
 public:
  explicit ResidentData(const CompiledScene& scene) : scene_(&scene) {}

  const Brick& brick(int medium, int index) const { return scene_->media.brick(medium, index); }
  const PhotometricWeb& web(uint32_t i) const { return *scene_->webs[i]; }
  const Image& image(uint32_t i) const { return *scene_->images[i]; }

 private:
  const CompiledScene* scene_;
};

/// One merged cell, resident: no proxy on the path.
class MergedResolver : public ResidentData {
 public:
  MergedResolver(const CompiledScene& scene, const SceneIndex& index)
      : ResidentData(scene), cell_(&index.cell(0)) {}

  Hit nearest(const Ray& ray) const { return cell_->nearest(ray); }
  bool occluded(const Ray& ray) const { return cell_->occluded(ray); }

 private:
  const CellScene* cell_;
};

/// Many cells, all resident: candidates are collected, then visited front to back.
class PartitionResolver : public ResidentData {
 public:
  PartitionResolver(const CompiledScene& scene, const SceneIndex& index)
      : ResidentData(scene), index_(&index) {}

  Hit nearest(const Ray& ray) {
    return nearest_in_cells(index_->proxies(), ray, candidates_,
                            [this](uint32_t cell) { return &index_->cell(cell); });
  }
  bool occluded(const Ray& ray) {
    return occluded_in_cells(index_->proxies(), ray, candidates_,
                             [this](uint32_t cell) { return &index_->cell(cell); });
  }

 private:
  const SceneIndex* index_;
  std::vector<Candidate> candidates_;
};

/// Many cells, each of which may have to be waited for. A hit's triangle is copied, because its
/// cell may be gone when the next one is entered.
class SourcedResolver : public ResidentData {
 public:
  SourcedResolver(const CompiledScene& scene, const ProxyScene& proxies, ObjectSource& source)
      : ResidentData(scene), proxies_(&proxies), source_(&source) {}

  Hit nearest(const Ray& ray) {
    const auto enter = [this](uint32_t cell) { return source_->cell(cell); };
    return nearest_in_cells(*proxies_, ray, candidates_, enter,
                            [this](const Hit& hit) { return keep(hit); });
  }
  bool occluded(const Ray& ray) {
    return occluded_in_cells(*proxies_, ray, candidates_,
                             [this](uint32_t cell) { return source_->cell(cell); });
  }

 private:
  Hit keep(Hit hit) {
    triangle_ = *hit.triangle;
    kept_.texture_uv.clear();
    if (const auto* uv = hit.cell->uv_of(hit.index)) kept_.texture_uv.push_back(*uv);
    hit.triangle = &triangle_;
    hit.cell = &kept_;
    return hit;
  }

  const ProxyScene* proxies_;
  ObjectSource* source_;
  std::vector<Candidate> candidates_;
  TriangleRecord triangle_;
  GeometryCell kept_;  // holds the texture coordinates of that triangle only
};

/// What a tracer reaches geometry by: everything resident, or a source that may wait.
struct GeometryAccess {
  const SceneIndex* index = nullptr;
  const ProxyScene* proxies = nullptr;  // with `source`, instead of the index
  ObjectSource* source = nullptr;

  static GeometryAccess resident(const SceneIndex& index) { return {&index, nullptr, nullptr}; }
  static GeometryAccess through(const ProxyScene& proxies, ObjectSource& source) {
    return {nullptr, &proxies, &source};
  }
};

/// Calls `use(resolver)` with the resolver that fits, moved into place by whoever receives it.
template <class Use>
auto with_resolver(const CompiledScene& scene, const GeometryAccess& access, Use&& use) {
  if (access.source != nullptr) return use(SourcedResolver(scene, *access.proxies, *access.source));
  if (access.index->cells() > 1) return use(PartitionResolver(scene, *access.index));
  return use(MergedResolver(scene, *access.index));
}

}  // namespace luxodus
