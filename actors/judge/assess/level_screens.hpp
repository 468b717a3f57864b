// Level surfaces of a building that no light passes, such as floor slabs: which places lie behind
// one from each other, told without a ray. It only ever says so where it is certain; whatever it
// does not say may be hidden all the same. Immutable once made; any thread.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Cells of one level, and of all: above it cells are larger, or levels are left out.
inline constexpr size_t screen_cells = 250'000, all_screen_cells = 20'000'000;
/// A triangle is looked at in each cell around it: so often in all levels together. A level that
/// takes more than is left of this is left out: light is the same, and takes longer.
inline constexpr size_t screen_visits = 20'000'000;
}  // namespace limits

class LevelScreens {
 public:
  LevelScreens() = default;
  /// Of the opaque objects of a scene; doors are none. A scene whose triangles are elsewhere has
  /// no screens.
  explicit LevelScreens(const CompiledScene& scene);

  /// Whether every straight line from the place into the box is certainly stopped.
  bool hide(const glm::dvec3& place, const Bounds& box) const;

 private:
  /// The part of one level that is closed, by cells; sums over all cells below and left of one.
  struct Level {
    double z = 0;
    glm::dvec2 low{0}, cell_m{0};
    int columns = 0, rows = 0;
    std::vector<uint32_t> closed;  // (columns + 1) x (rows + 1)

    bool covers(const glm::dvec2& low_corner, const glm::dvec2& high_corner) const;
  };
  class Drawing;  // of a level, from its triangles

  std::vector<Level> levels_;  // by ascending z
};

}  // namespace luxodus
