// A scene whose triangles, smoke data and textures are not in its description: the data kept in
// memory, and access to the rest. It holds for one state of the doors and one partition. Immutable;
// any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/core/ids.hpp"
#include "runtime/core/result.hpp"
#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/scene_parts.hpp"

namespace luxodus {

/// Scene parts by index, wherever they are stored.
class ObjectFile {
 public:
  virtual ~ObjectFile() = default;
  /// The bytes of a part, valid as long as this object; empty if they are not here.
  virtual std::span<const std::byte> object(uint32_t index) const = 0;
  /// Its name in messages.
  virtual const std::string& name() const = 0;
};

/// Results of compiling that are kept without the triangles and the data sets' arrays. (Texture
/// sizes are in the description.)
struct PackedScene {
  struct Cell {
    glm::vec3 low{0}, high{0};
    uint32_t triangles = 0;
  };
  struct Object {
    ObjectId id;  // the hash of its bytes
    uint64_t wire_bytes = 0;
  };

  int partition = 1;                    // requested number of cells
  std::vector<std::string> open_doors;  // of those that can be open or closed
  Bounds bounds;
  std::vector<CompiledSurface> surfaces;
  uint64_t triangles = 0;
  uint32_t patch_count = 0;
  double total_area_m2 = 0;
  std::vector<Cell> cells;
  std::vector<BrickTable> tables;                    // by medium; empty if it is not a data set
  std::vector<std::vector<glm::vec3>> flame_points;  // by medium, of data sets that glow
  std::vector<Object> objects;                       // in the order of SceneParts
  std::vector<std::string> warnings;

  std::shared_ptr<const ObjectFile> file;  // object i is part i
};

/// The doors that a scenario has open, by name.
std::vector<std::string> open_doors(const SceneDescription& description, const Scenario& scenario);

/// The summary of a scene compiled from a description with triangles; `objects` is left to the
/// caller who writes them. `partition`: the value it was compiled with.
PackedScene summary_of(const CompiledScene& scene, const SceneParts& parts, int partition);

/// The bytes of a packed scene's part, checked against its hash.
/// Errors: bytes that are missing or damaged.
Result<std::span<const std::byte>> object_bytes(const PackedScene& packed, uint32_t object);

/// A cell of the scene with its triangles, from memory or its file.
/// Errors: those of object_bytes; bytes that are not a cell of the scene.
Result<GeometryCell> load_cell(const CompiledScene& scene, uint32_t cell);
/// All bricks of the scenario's data sets, by medium. Errors: likewise.
Result<std::shared_ptr<const MediaBricks>> load_bricks(const CompiledScene& scene);
/// All pictures with their texels, as CompiledScene::images. Errors: likewise.
Result<std::vector<std::shared_ptr<const Image>>> load_images(const CompiledScene& scene);

/// Reads every part of a packed scene, one at a time. Otherwise nodes find damage only when a batch
/// needs the part, and then request it from each other in vain. Errors: as above.
Result<void> check_objects(const CompiledScene& scene);

/// Calls `visit(const GeometryCell&)` for every cell in turn; a packed scene has one at a time in
/// memory. Errors: those of load_cell; stops at the first.
template <class Visit>
Result<void> for_each_cell(const CompiledScene& scene, Visit&& visit) {
  for (uint32_t i = 0; i < scene.cell_boxes.size(); ++i) {
    if (scene.description->packed == nullptr) {
      visit(scene.cells[i]);
      continue;
    }
    auto cell = load_cell(scene, i);
    if (!cell) return cell.problem();
    visit(cell.value());
  }
  return {};
}

}  // namespace luxodus
