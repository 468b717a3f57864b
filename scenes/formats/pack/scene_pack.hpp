// A scene as one file that many machines can share: its triangles, smoke data and pictures, cut
// into content-addressed scene parts, and the skeleton that every machine reads. The file is
// mapped, not read: an object takes memory only while it is accessed, and a scene may be larger
// than a machine. A pack may hold the skeleton alone, for machines that get all objects from
// others.
//
//   head (128 B) | object 0 | object 1 | ... | skeleton        objects begin at multiples of 64
//
// Reading checks the hashes of head and skeleton, and the skeleton's values against what a scene
// may say, because an attacker can recompute hashes. Whoever takes an object checks it. Thread
// rule: an open pack is immutable. Nobody may shorten the file while it is open.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "runtime/core/result.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace limits {
inline constexpr uint32_t pack_version = 12;
/// Size of a skeleton: 100 times that of a tower of six million triangles.
inline constexpr uint64_t max_skeleton_bytes = uint64_t{1} << 30;
}  // namespace limits

/// What was written, for display.
struct PackReport {
  uint64_t file_bytes = 0;
  uint64_t skeleton_bytes = 0;
  uint64_t object_bytes = 0;
  size_t objects = 0;
  uint64_t largest_object_bytes = 0;
  size_t bricks = 0;  // objects that hold smoke data
  size_t tiles = 0;   // objects that hold pictures

  void add(ScenePart::Kind kind, uint64_t bytes);
};

/// Writes a scene, compiled with `partition` cells from a description with triangles, atomically.
/// `progress` gets the share of the objects written, and returns false to cancel. Errors: as
/// AtomicFile; a scene without triangles; cancelled by `progress`.
Result<PackReport> write_pack(const std::filesystem::path& path, const CompiledScene& scene,
                              int partition, const std::function<bool(double)>& progress = {});

/// Copies a pack without its objects. Errors: as read_pack and AtomicFile.
Result<PackReport> write_skeleton_pack(const std::filesystem::path& path,
                                       const std::filesystem::path& from);

/// Whether a file begins with the mark of packs; false where it cannot be read.
bool is_pack(const std::filesystem::path& path);

/// The scene of a pack, ready to be compiled; it keeps the file mapped.
/// Errors: not a pack, one of another version, cut short, damaged.
Result<std::shared_ptr<const SceneDescription>> read_pack(const std::filesystem::path& path);

}  // namespace luxodus
