// Writes a building, perhaps with its light, as one glTF 2.0 file (GLB). Meshes with linear vertex
// colours are drawn unlit (KHR_materials_unlit); lights are those of KHR_lights_punctual.
// Coordinates are the scene's, z up [m], and are written y up, as glTF requires, without rounding.
// Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// A GLB file states its size in 32 bits.
inline constexpr uint64_t glb_bytes = (uint64_t{1} << 32) - 1;
}  // namespace limits

/// The front of a triangle is the side from which its corners run counter-clockwise.
struct GlbMesh {
  std::string name;
  std::vector<glm::vec3> points;    // relative to the scene's origin [m], finite
  std::vector<glm::vec3> colours;   // of each point: linear RGB, 1 is white; or empty
  std::vector<uint32_t> triangles;  // three points each
  std::string material = "light as traced";
};

struct GlbLight {
  std::string name;
  glm::dvec3 position{0};                 // relative to the scene's origin [m]
  std::array<double, 3> colour{1, 1, 1};  // linear RGB, the largest 1
  double intensity_cd = 0;
  /// For a light in one direction: the direction, and its half cone [rad], over which it falls from
  /// full to none. 0: to all sides.
  glm::dvec3 direction{0, 0, -1};
  double inner_rad = 0, outer_rad = 0;
  Json extras;
};

struct GlbCamera {
  std::string name;
  glm::dvec3 eye{0}, target{1, 0, 0}, up{0, 0, 1};  // eye and target relative to the origin [m]
  double vertical_fov_rad = 1, aspect = 1;
};

struct GlbScene {
  std::string generator, title;
  glm::dvec3 origin{0};  // of all points [m]
  std::vector<GlbMesh> meshes;
  std::vector<GlbLight> lights;
  std::vector<GlbCamera> cameras;
  Json extras;
};

/// The file's bytes. Errors: points and colours of different numbers, an index out of range, a
/// number that is not finite, no triangles, more bytes than limits::glb_bytes.
Result<std::string> glb_bytes_of(const GlbScene& scene);
/// Errors: as glb_bytes_of and write_file_atomically.
Result<void> write_glb(const std::filesystem::path& path, const GlbScene& scene);

}  // namespace luxodus
