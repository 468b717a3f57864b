// Luminous faces of lamps as a live view shows them: where they are, and how bright each looks from
// any side. Points and flames have no face, those of signs are told with the signs. Pure; any
// thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scenes/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Directions of a table: from the axis to its opposite, and around.
inline constexpr int lamp_polar = 72;
inline constexpr int lamp_azimuth = 24;
/// Faces of a live view at most, and triangles of one that is a mesh: others are not shown.
inline constexpr size_t view_lamps = 2048;
inline constexpr size_t view_lamp_triangles = 512;
}  // namespace limits

/// What leaves a face by direction: density [1/sr] by the cosine to the axis. Cells of
/// 180 / lamp_polar by 360 / lamp_azimuth degrees, azimuth fastest, at their middles.
struct LampTable {
  double peak = 0;     // of the largest value
  std::string values;  // two bytes each, little endian, 65535 for the peak
  bool operator==(const LampTable&) const = default;
};

struct LiveLamp {
  std::string group;
  EmitterKind kind = EmitterKind::rectangle;
  glm::dvec3 origin{0};              // [m], in the scene's coordinates
  std::array<glm::dvec3, 3> axes{};  // unit
  glm::dvec3 size{0};                // [m]
  std::vector<glm::dvec3> corners;   // mesh: three a triangle
  std::array<double, 3> colour{};    // flux by area, linear sRGB [lm/m2]
  uint32_t table = 0;
  /// The table's axis is that of the luminaire, not the normal of each point.
  bool of_luminaire = false;
};

struct LiveLamps {
  std::vector<LiveLamp> lamps;
  std::vector<LampTable> tables;
};

/// All that rays from eyes can meet, in the order of the scene.
LiveLamps lamps_of(const CompiledScene& scene);

}  // namespace luxodus
