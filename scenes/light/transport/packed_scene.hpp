// A scene whose triangles, smoke data and pictures are not in its description: what remains of them
// in memory, and a way to the rest. It belongs to one scenario's doors, cut into parts once and for
// all. Immutable; any thread.
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

/// Scene parts by their place, wherever they lie.
class ObjectFile {
 public:
  virtual ~ObjectFile() = default;
  /// The bytes of an object, good as long as this is; empty where they are not here.
  virtual std::span<const std::byte> object(uint32_t index) const = 0;
  /// What its messages call it.
  virtual const std::string& name() const = 0;
};

/// What compiling leaves of geometry beside the triangles, and of data sets beside their arrays.
/// (Of pictures their sizes stay in the description.)
struct PackedScene {
  struct Cell {
    glm::vec3 low{0}, high{0};
    uint32_t triangles = 0;
  };
  struct Object {
    ObjectId id;  // the hash of its bytes
    uint64_t wire_bytes = 0;
  };

  int partition = 1;                    // cells that were asked for
  std::vector<std::string> open_doors;  // of those that can be open or closed
  Bounds bounds;
  std::vector<CompiledSurface> surfaces;
  uint64_t triangles = 0;
  uint32_t patch_count = 0;
  double total_area_m2 = 0;
  std::vector<Cell> cells;
  std::vector<BrickTable> tables;                    // by medium; empty where it is no data set
  std::vector<std::vector<glm::vec3>> flame_points;  // by medium, of data sets that glow
  std::vector<Object> objects;                       // in the order of SceneParts
  std::vector<std::string> warnings;

  std::shared_ptr<const ObjectFile> file;  // object i is part i
};

/// The doors that a scenario has open, by name.
std::vector<std::string> open_doors(const SceneDescription& description, const Scenario& scenario);

/// What there is of a scene compiled from a description with triangles; its objects are for whoever
/// writes them to say. `partition`: as it was compiled with.
PackedScene summary_of(const CompiledScene& scene, const SceneParts& parts, int partition);

/// The bytes of a packed scene's object, which are what its name says.
/// Errors: bytes that are not here, or damaged.
Result<std::span<const std::byte>> object_bytes(const PackedScene& packed, uint32_t object);

/// A cell of the scene with its triangles, out of memory or of its file.
/// Errors: as object_bytes; bytes that are no cell of the scene.
Result<GeometryCell> load_cell(const CompiledScene& scene, uint32_t cell);
/// All bricks of the scenario's data sets, by medium. Errors: likewise.
Result<std::shared_ptr<const MediaBricks>> load_bricks(const CompiledScene& scene);
/// All pictures with their texels, as CompiledScene::images. Errors: likewise.
Result<std::vector<std::shared_ptr<const Image>>> load_images(const CompiledScene& scene);

/// Reads every object of a packed scene, one at a time in memory. Nodes find damage only when a
/// batch needs the object, and then ask each other for it in vain. Errors: as those above.
Result<void> check_objects(const CompiledScene& scene);

/// Calls `visit(const GeometryCell&)` for every cell in turn, one of a packed scene at a time in
/// memory. Errors: as load_cell; the first ends it.
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
