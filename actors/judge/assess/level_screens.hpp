// Horizontal opaque surfaces of a building, such as floor slabs, that separate places without
// tracing a ray. The answer "hidden" is certain; without it a place may still be hidden. Immutable
// once made; any thread.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Cells of one level, and of all levels. Beyond the first limit cells are larger, beyond the
/// second levels are left out.
inline constexpr size_t screen_cells = 250'000, all_screen_cells = 20'000'000;
/// Visits of cells by triangles, in all levels. A level that needs more than the rest of this is
/// left out: the light is the same, and computing it takes longer.
inline constexpr size_t screen_visits = 20'000'000;
}  // namespace limits

class LevelScreens {
 public:
  LevelScreens() = default;
  /// Made of the opaque objects of a scene except doors. A scene whose triangles are not in memory
  /// has no screens.
  explicit LevelScreens(const CompiledScene& scene);

  /// Whether every straight line from the place into the box is certainly blocked.
  bool hide(const glm::dvec3& place, const Bounds& box) const;

 private:
  /// The closed part of one level as cells, stored as sums over all cells below and to the left.
  struct Level {
    double z = 0;
    glm::dvec2 low{0}, cell_m{0};
    int columns = 0, rows = 0;
    std::vector<uint32_t> closed;  // (columns + 1) x (rows + 1)

    bool covers(const glm::dvec2& low_corner, const glm::dvec2& high_corner) const;
  };
  class Drawing;  // builds a level from its triangles

  std::vector<Level> levels_;  // by ascending z
};

}  // namespace luxodus
