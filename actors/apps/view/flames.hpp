// Flames for a live view: where they glow within their box, as cells. Pure; any thread, as far as
// the scene's bricks may be read.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/resolver.hpp"

namespace luxodus {

namespace limits {
/// Flames with a shape of their own in a live view; others glow with their voxels.
inline constexpr size_t view_flames = 8;
/// Cells along the longest side of a flame.
inline constexpr int view_flame_cells = 24;
}  // namespace limits

/// What the shape of a steady flame at a moment follows from (scenes/light/optics/flame_shape.hpp).
struct LiveFlameShape {
  glm::dvec3 low{0}, size{0};   // of the body's box [m], in the scene's coordinates
  double extinction_per_m = 0;  // the largest of any band
  uint32_t seed = 0;
};

struct LiveFlame {
  std::string group;
  uint32_t medium = 0;
  glm::dvec3 low{0}, size{0};      // of its box [m], in the scene's coordinates
  glm::ivec3 count{1};             // of cells
  std::array<double, 3> colour{};  // of a cell of 255: linear sRGB emitted by a metre [cd/(m2 m)]
  std::string cells;               // a byte each, x fastest: glow relative to the brightest
  std::optional<LiveFlameShape> shape = {};  // none: as it is, such as that of a fire simulation
};

/// The flames with the most light, at most limits::view_flames. All cells of a flame together emit
/// its luminous flux.
std::vector<LiveFlame> flames_of(const CompiledScene& scene, const SceneIndex& index);

}  // namespace luxodus
