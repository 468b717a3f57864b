// Writes an imported building as a scene that the user goes on with.
//   building/*, building.toml, import.txt       overwritten by every import; tables of
//                                               building.toml with a GlobalId that the user has
//                                               changed or removed stay so
//   materials.toml, fixtures.toml, scene.toml   the user's: made if missing; what is new in a
//                                               model is added at the end of the first two
// Files are written atomically. Any thread; one import at a time writes to a folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "actors/import/building.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Photometric files of a folder that are searched.
inline constexpr size_t photometric_files = 10'000;
}  // namespace limits

struct WrittenBuilding {
  size_t parts = 0, doors = 0, rooms = 0, luminaires = 0, signs = 0;
  std::vector<std::string> asked;  // messages about types of fixtures that the user must complete
  std::vector<std::string> open_rooms, open_solids;
  std::vector<std::string> by_hand;  // tables of building.toml that a person has changed
  bool kept_scene = false;           // scene.toml existed
};

/// `photometry`: folder of photometric files; "" for none.
/// Errors: a folder or file that cannot be read or written, a malformed fixtures.toml.
Result<WrittenBuilding> write_building(const IfcBuilding& building, const std::string& out,
                                       const std::string& photometry);

// ---- steps of it, apart for tests
// ----------------------------------------------------------------

/// The parts as a binary glTF 2.0 about `origin`, one node for each part, one material for each
/// name; in single precision, since the scene translates the whole in double precision.
/// Errors: as glb_bytes_of.
Result<std::string> glb_of(const std::vector<BuildingPart>& parts, const glm::dvec3& origin);

/// Photometric files by the letters and digits of their stems, in lower case.
Result<std::map<std::string, std::filesystem::path>> photometry_by_name(const std::string& folder);
std::string letters_and_digits(std::string_view text);

}  // namespace luxodus
