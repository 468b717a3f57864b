// The folder of a fire simulation's building: a scene that a person goes on with.
//   geometry.toml, geometry.glb   written anew by every import; the latter where there are bodies
//   of
//                                 triangles
//   materials.toml, scene.toml    a person's: made where they are not there; new surfaces are added
//                                 at the end of the first
// Files appear whole or not at all. One import at a time writes to a folder.
#pragma once

#include <optional>
#include <string>

#include "runtime/core/result.hpp"
#include "scenes/formats/fields/fds_building.hpp"

namespace luxodus {

struct FireOrigin {
  std::string title;
  std::string made_of;  // "The building of corridor.smv as FDS computed it"
  /// The index of the results, for the smoke; none where there are none.
  std::optional<std::string> index;
  std::string at_text;  // "60s"
  double at_s = 0;
};

/// Whether scene.toml was there, and is as it was.
/// Errors: a folder or file that cannot be read or written, a materials.toml that is no TOML.
Result<bool> write_fire(const FireBuilding& building, const FireOrigin& source,
                        const std::string& out);

}  // namespace luxodus
