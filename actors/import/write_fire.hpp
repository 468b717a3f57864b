// Writes a fire simulation's building as a scene that the user goes on with.
//   geometry.toml, geometry.glb   overwritten by every import; the latter if there are bodies of
//                                 triangles
//   materials.toml, scene.toml    the user's: made if missing; new surfaces are added at the end
//                                 of the first
// Files are written atomically. Any thread; one import at a time writes to a folder.
#pragma once

#include <optional>
#include <string>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_building.hpp"

namespace luxodus {

struct FireOrigin {
  std::string title;
  std::string made_of;  // "The building of corridor.smv as FDS computed it"
  /// The index of the results, for the smoke; none without results.
  std::optional<std::string> index;
  std::string at_text;  // "60s"
  double at_s = 0;
};

/// Returns whether scene.toml existed, and was kept.
/// Errors: a folder or file that cannot be read or written, a malformed materials.toml.
Result<bool> write_fire(const FireBuilding& building, const FireOrigin& source,
                        const std::string& out);

}  // namespace luxodus
