// Resolvers: access of the transport loop to data outside the skeleton. A resolver answers at once
// (everything resident), or may wait (a fiber that fetches). The content is the same either way, so
// the bits are, too. A returned reference is valid until the next call. Thread rule: one resolver
// per thread or fiber; a SceneIndex is immutable and shared by all.
//
// A resolver has: nearest(ray) -> Hit, occluded(ray) -> bool, cell_of(hit) -> const GeometryCell&,
// brick(medium, brick) -> const Brick&, web(index) -> const PhotometricWeb&, texel(image, x, y) ->
// const float*, as many as the picture has channels.
#pragma once

#include <memory>
#include <vector>

#include "scenes/light/intersect/embree_scene.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/image_tile.hpp"
#include "scenes/light/transport/object_source.hpp"

namespace luxodus {

/// All parts of a scene in memory: the search structures over its cells, built once and shared by
/// all threads, bricks and textures.
class SceneIndex {
 public:
  /// Requires: `scene` outlives this.
  /// Errors (exception): a packed scene whose parts cannot be read.
  SceneIndex(const EmbreeDevice& device, const CompiledScene& scene);
  const CellScene& cell(uint32_t i) const { return *cells_[i]; }
  size_t cells() const { return cells_.size(); }
  /// Requires: cells() > 1.
  const ProxyScene& proxies() const { return *proxies_; }
  const MediaBricks& bricks() const { return *bricks_; }
  const Image& image(uint32_t i) const { return *images_[i]; }

 private:
  std::vector<GeometryCell> loaded_;  // of a packed scene
  std::vector<std::unique_ptr<CellScene>> cells_;
  std::unique_ptr<ProxyScene> proxies_;
  std::shared_ptr<const MediaBricks> bricks_;
  std::vector<std::shared_ptr<const Image>> images_;
};

/// Access to resident data other than geometry.
class ResidentData {
 public:
  ResidentData(const CompiledScene& scene, const SceneIndex& index)
      : scene_(&scene), bricks_(&index.bricks()), index_(&index) {}

  const Brick& brick(int medium, int index) const {
    return (*bricks_)[static_cast<size_t>(medium)][static_cast<size_t>(index)];
  }
  const PhotometricWeb& web(uint32_t i) const { return *scene_->webs[i]; }
  const float* texel(uint32_t i, int x, int y) const {
    const Image& image = index_->image(i);
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(image.width);
    return &image.texels[(row + static_cast<size_t>(x)) * static_cast<size_t>(image.channels)];
  }

 protected:
  const CompiledScene* scene_;
  const MediaBricks* bricks_;
  const SceneIndex* index_;
};

/// One merged cell, resident: without a proxy scene.
class MergedResolver : public ResidentData {
 public:
  MergedResolver(const CompiledScene& scene, const SceneIndex& index)
      : ResidentData(scene, index), cell_(&index.cell(0)) {}

  Hit nearest(const Ray& ray) const { return cell_->nearest(ray); }
  bool occluded(const Ray& ray) const { return cell_->occluded(ray); }

 private:
  const CellScene* cell_;
};

/// Many cells, all resident: candidates are collected, then entered front to back.
class PartitionResolver : public ResidentData {
 public:
  PartitionResolver(const CompiledScene& scene, const SceneIndex& index)
      : ResidentData(scene, index) {}

  Hit nearest(const Ray& ray) {
    return nearest_in_cells(index_->proxies(), ray, candidates_,
                            [this](const Candidate& c) { return &index_->cell(c.cell); });
  }
  bool occluded(const Ray& ray) {
    return occluded_in_cells(index_->proxies(), ray, candidates_,
                             [this](const Candidate& c) { return &index_->cell(c.cell); });
  }

 private:
  std::vector<Candidate> candidates_;
};

/// Many parts, each of which may have to be fetched. A hit's triangle is copied, because its cell
/// may be evicted when the next one is entered.
class SourcedResolver {
 public:
  SourcedResolver(const CompiledScene& scene, const ProxyScene& proxies, ObjectSource& source)
      : scene_(&scene), proxies_(&proxies), source_(&source) {}

  /// A clear brick if it is not available.
  const Brick& brick(int medium, int index) {
    const Brick* brick = source_->brick(medium, index);
    return brick != nullptr ? *brick : clear_brick();
  }
  const PhotometricWeb& web(uint32_t i) const { return *scene_->webs[i]; }
  /// Black if it is not available.
  const float* texel(uint32_t i, int x, int y) {
    static constexpr float black[4] = {};
    const ImageTile* tile = source_->tile(i, tile_of(*scene_->images[i], x, y));
    return tile != nullptr ? tile->texel(x, y) : black;
  }

  Hit nearest(const Ray& ray) {
    return nearest_in_cells(
        *proxies_, ray, candidates_, [this](const Candidate& c) { return enter(c); },
        [this](const Hit& hit) { return keep(hit); });
  }
  bool occluded(const Ray& ray) {
    return occluded_in_cells(*proxies_, ray, candidates_,
                             [this](const Candidate& c) { return enter(c); });
  }

 private:
  const CellScene* enter(const Candidate& c) {
    const Candidate* const end = candidates_.data() + candidates_.size();
    return source_->cell(c.cell, {&c + 1, end});
  }
  Hit keep(Hit hit) {
    triangle_ = *hit.triangle;
    kept_.texture_uv.clear();
    if (const auto* uv = hit.cell->uv_of(hit.index)) kept_.texture_uv.push_back(*uv);
    hit.triangle = &triangle_;
    hit.cell = &kept_;
    return hit;
  }

  const CompiledScene* scene_;
  const ProxyScene* proxies_;
  ObjectSource* source_;
  std::vector<Candidate> candidates_;
  TriangleRecord triangle_;
  GeometryCell kept_;  // holds only the texture coordinates of that triangle
};

/// Access to a scene's parts: everything resident, or a source that may wait.
struct GeometryAccess {
  const SceneIndex* index = nullptr;
  const ProxyScene* proxies = nullptr;  // used with `source`, instead of the index
  ObjectSource* source = nullptr;

  static GeometryAccess resident(const SceneIndex& index) { return {&index, nullptr, nullptr}; }
  static GeometryAccess through(const ProxyScene& proxies, ObjectSource& source) {
    return {nullptr, &proxies, &source};
  }
};

/// Calls `use(resolver)` with the matching resolver as an rvalue.
template <class Use>
auto with_resolver(const CompiledScene& scene, const GeometryAccess& access, Use&& use) {
  if (access.source != nullptr) return use(SourcedResolver(scene, *access.proxies, *access.source));
  if (access.index->cells() > 1) return use(PartitionResolver(scene, *access.index));
  return use(MergedResolver(scene, *access.index));
}

}  // namespace luxodus
