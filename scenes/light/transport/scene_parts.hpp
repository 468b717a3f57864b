// The parts of a scene outside its skeleton, numbered: the geometry cells, then the bricks of its
// data sets, then the tiles of its reflectance textures. Every machine gets the same numbers, from
// the scene's file or from a pack, for any scenario. Clear bricks, which rays skip, have no number.
// Immutable once made; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scenes/light/optics/smoke_grid.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

struct ScenePart {
  enum class Kind : uint8_t { cell, brick, tile };
  Kind kind = Kind::cell;
  uint32_t owner = 0;  // the medium or picture
  uint32_t index = 0;  // within its owner; for a cell, its number
};

class SceneParts {
 public:
  /// `tables` by medium; empty for media that are not data sets.
  SceneParts(const SceneDescription& description, size_t cells, std::vector<BrickTable> tables);
  /// Reads all data of a scene that is not packed.
  explicit SceneParts(const CompiledScene& scene);

  size_t count() const { return parts_.size(); }
  const ScenePart& operator[](size_t part) const { return parts_[part]; }
  /// The part of a brick; none_index if rays skip it.
  uint32_t of_brick(int medium, int brick) const {
    return brick_[static_cast<size_t>(medium)][static_cast<size_t>(brick)];
  }
  uint32_t of_tile(uint32_t image, uint32_t tile) const { return first_tile_[image] + tile; }
  const BrickTable& table(uint32_t medium) const { return tables_[medium]; }
  const std::vector<BrickTable>& tables() const { return tables_; }

  /// Number of parts without making them, in case it is too large. Requires: tables fit the media.
  static uint64_t count_of(const SceneDescription& description, size_t cells,
                           const std::vector<BrickTable>& tables);

 private:
  std::vector<ScenePart> parts_;
  std::vector<BrickTable> tables_;
  std::vector<std::vector<uint32_t>> brick_;  // [medium][brick]
  std::vector<uint32_t> first_tile_;          // by texture
};

/// Whether a scene has more than one part, so that a node may hold some and fetch others.
bool in_parts(const CompiledScene& scene);

/// The distinct reflectance textures of a scene's materials, in the order of CompiledScene::images.
std::vector<std::shared_ptr<const Image>> distinct_images(const SceneDescription& description);

/// A part as bytes. Requires: the scene is not packed.
std::vector<std::byte> encode_part(const CompiledScene& scene, const ScenePart& part);

}  // namespace luxodus
