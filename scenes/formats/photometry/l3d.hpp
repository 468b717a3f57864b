// Reads shapes of luminaires (L3D, versions 0.9 to 0.11): a ZIP with `structure.xml`, which places
// parts and luminous openings, and a Wavefront OBJ file for each shape, which is passed on with the
// names and diffuse colours of its material library (MTL). Textures, sensors, connectors and
// assignments of luminous faces are not read. Joints take their `DefaultRotation`. Called in the
// process that reads a container (gldf.hpp), which has limits on memory and time. Plain values; any
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace limits {
/// Sizes of `structure.xml`, and of all shapes of a container's models, unpacked [bytes].
inline constexpr uint64_t l3d_xml_bytes = uint64_t{1} << 20;
inline constexpr uint64_t l3d_all_bytes = uint64_t{128} << 20;
/// Size of the material library of a shape [bytes].
inline constexpr uint64_t l3d_library_bytes = uint64_t{1} << 20;
/// Numbers of parts, of luminous openings, and of parts in a chain of joints.
inline constexpr size_t l3d_parts = 1000;
inline constexpr size_t l3d_openings = 1000;
inline constexpr int l3d_depth = 32;
/// Largest distance of a part from the point that the part above is placed by [m].
inline constexpr double l3d_farthest_m = 100;
}  // namespace limits

/// The name by which a shape refers to its material library, after reading.
inline constexpr const char* l3d_library = "colours.mtl";

struct L3dShape {
  std::string name;  // of its file in the model: "geom_1/housing.obj"
  std::string obj;
  /// Its material library, which `obj` refers to as colours.mtl, with only "newmtl NAME" and "Kd R
  /// G B"; "" where there is none.
  std::string colours;
  double metres_per_unit = 1;
  std::string odd_colour;  // describes the first colour that cannot be read; "" for none
};

struct L3dPart {
  std::string name;
  size_t shape = 0;
  Transform place;       // from the shape's metres; the model's z is up
  bool measured = true;  // it was there when the intensities were measured, which lack its shadow
};

/// A luminous opening, which shines along `down`.
struct L3dOpening {
  std::string name;
  glm::dvec3 centre_m{0};
  glm::dvec3 down{0, 0, -1};
};

struct L3dModel {
  std::vector<L3dShape> shapes;
  std::vector<L3dPart> parts;
  std::vector<L3dOpening> openings;
};

/// `file` names the model in messages. Its shapes have at most `max_bytes` together.
/// Errors: not a ZIP, names that lead out of it, no `structure.xml`, a document type (entities), a
/// part without its shape, place or unit, `includedInMeasurement` that is neither true nor false,
/// more than the limits.
Result<L3dModel> l3d_of(std::string_view bytes, const std::string& file, uint64_t max_bytes);

}  // namespace luxodus
