// Luminous faces of lamps for a live view: where they are, and how bright each looks from any
// direction. Points and flames have no face; those of signs are sent with the signs. Pure; any
// thread.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

namespace limits {
/// Directions of a table: from the axis to its opposite, and around.
inline constexpr int lamp_polar = 72;
inline constexpr int lamp_azimuth = 24;
/// Limits on faces in a live view, their tables, triangles of a mesh, corners of all meshes, and
/// the width of one [m]: others are not shown. They keep the message within what pages read.
inline constexpr size_t view_lamps = 2048;
inline constexpr size_t view_lamp_tables = 512;
inline constexpr size_t view_lamp_triangles = 512;
inline constexpr size_t view_lamp_corners = 32768;
inline constexpr double view_lamp_m = 1e4;
/// Limits on flux by area, in each channel [lm/m2], and on the largest value of a table [1/sr].
inline constexpr double view_lamp_colour = 1e9;
inline constexpr double view_lamp_peak = 1e9;
}  // namespace limits

/// Light of a face by direction: density [1/sr] divided by the cosine to the axis; density alone if
/// the axis is a luminaire's and the face is not flat. Cells of 180 / lamp_polar by 360 /
/// lamp_azimuth degrees, azimuth fastest, at their centres.
struct LampTable {
  double peak = 0;     // the largest value
  std::string values;  // two bytes each, little endian, 65535 for the peak
  bool operator==(const LampTable&) const = default;
};

struct LiveLamp {
  std::string group;
  EmitterKind kind = EmitterKind::rectangle;
  glm::dvec3 origin{0};              // [m], in the scene's coordinates
  std::array<glm::dvec3, 3> axes{};  // unit
  glm::dvec3 size{0};                // [m]
  std::vector<glm::dvec3> corners;   // mesh: three per triangle
  std::array<double, 3> colour{};    // flux by area, linear sRGB [lm/m2]
  uint32_t table = 0;
  /// The table's axis is that of the luminaire, not the normal of each point. If the face is also
  /// not flat, each point is brighter than the table by one over the cosine to its normal.
  bool of_luminaire = false;
};

struct LiveLamps {
  std::vector<LiveLamp> lamps;
  std::vector<LampTable> tables;
};

/// Faces that rays from eyes can hit, in the order of the scene.
LiveLamps lamps_of(const CompiledScene& scene);

}  // namespace luxodus
