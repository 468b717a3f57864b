// Writes the building of a fire simulation as tables of a scene file, snapped to the grid as FDS
// computed it: obstructions as boxes, those without thickness as quads, and the closed faces of
// meshes as rectangles. Plain values and pure functions; any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fire_tables.hpp"
#include "scenes/light/geometry/mesh.hpp"

namespace luxodus {

namespace limits {
/// Objects that are written: the reader of scenes accepts no more.
inline constexpr size_t fire_objects = 100'000;
}  // namespace limits

namespace fds {
struct Case;
}

/// A body of triangles.
struct FireBody {
  std::string name, material;  // as in the scene
  Mesh mesh;
};

struct FireBuilding {
  fds::FireTables tables;               // its objects and materials
  std::vector<FireBody> bodies;         // with names and materials of `tables`
  size_t solids = 0;                    // boxes
  size_t plates = 0;                    // quads
  size_t faces = 0;                     // rectangles of closed faces of meshes
  std::vector<std::string> open_sides;  // values of the scene's key open_sides
  std::vector<glm::dvec3> exits;    // middles of openings that reach the floor of their mesh [m]
  std::vector<std::string> absent;  // obstructions that are absent at this time, but exist at
                                    // others
  std::vector<std::string> notes;   // what the user should know about it
  Bounds bounds;                    // of the meshes [m]
  glm::dvec3 lamp{0};               // a place in gas under the ceiling of the first mesh [m]
};

/// The building over time: obstructions that come and go have times. `at_s`: the time that notes
/// describe. Faces of meshes exist where any obstruction before them ever vanishes. Colours are
/// those of the surfaces in Smokeview, for display: FDS knows no reflectances. Errors: as
/// fds_case.hpp; more than limits::fire_objects.
Result<FireBuilding> read_fire_building(const std::filesystem::path& index, double at_s);

/// The building of a case whose meshes and obstructions come from another source.
Result<FireBuilding> fire_building_of(fds::Case fire, double at_s);

}  // namespace luxodus
