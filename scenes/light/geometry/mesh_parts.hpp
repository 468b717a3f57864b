// Collects the parts of a mesh file: places them, checks positions and limits, joins equal
// vertices, drops degenerate triangles, and gives each part a name of its own. Internal to the
// import of meshes. One thread per object.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {

class MeshParts {
 public:
  MeshParts(std::string path, double metres_per_unit, UpAxis up);

  /// From the file's coordinates to those of the scene.
  const Transform& to_scene() const { return to_scene_; }

  /// Adds a part whose positions are in coordinates that `place` maps to the scene's. One without
  /// triangles is not added. Requires: triangles of positions that are there. Errors: positions or
  /// texture coordinates that are not finite or too far away, a place of no volume, a limit.
  Result<void> add(ImportedPart part, const Transform& place);

  /// All parts. Errors: none, and why.
  Result<std::vector<ImportedPart>> take();

 private:
  Problem problem(std::string what) const { return problem_in(path_, std::move(what)); }
  Result<void> check_finite(const ImportedPart& part) const;

  std::string path_;
  Transform to_scene_;
  uint64_t vertices_ = 0, triangles_ = 0;
  int64_t homeless_degenerates_ = 0;
  std::unordered_map<std::string, int> times_used_;
  std::vector<ImportedPart> parts_;
};

}  // namespace luxodus
