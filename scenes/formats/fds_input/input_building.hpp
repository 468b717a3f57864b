// The building of an FDS input file as tables of a scene: as it is written, or as FDS snaps it to
// the cells of its meshes. Any thread.
#pragma once

#include <set>
#include <string>

#include "scenes/formats/fds_input/fds_input.hpp"
#include "scenes/formats/fields/fds_building.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus {

class ReadingShare;

struct FdsInputOptions {
  double at_s = 0;
  /// Obstructions, holes and openings that are not there, by name: for those that no clock drives.
  std::set<std::string> without;
  /// Hears how many obstructions are done, where given.
  ReadingShare* reading = nullptr;
};

/// To the last digit as written. Holes cut obstructions of PERMIT_HOLE exactly; faces of meshes are
/// closed where no other mesh and no opening is. Obstructions that touch no mesh are left out, and
/// counted in the notes.
/// Errors: more than limits::fire_objects, or than limits::fds_input_pairs; a name in `without`
/// that nothing has.
Result<FireBuilding> exact_building(const FdsInput& input, const FdsInputOptions& options);

/// As FDS computes it: like `fire_building_of` of its results. Bodies of triangles stay as written.
/// Errors: as exact_building.
Result<FireBuilding> snapped_building(const FdsInput& input, const FdsInputOptions& options);

/// The meshes, obstructions and openings that FDS would have, at one time. Obstructions are snapped
/// to the nearest nodes; thin ones become plates, or thicken by their THICKEN. One that straddles
/// the middle of a cell and is thinner than a quarter of it goes to the nearer node.
/// Errors: as exact_building.
Result<fds::Case> snapped_case(const FdsInput& input, const FdsInputOptions& options);

}  // namespace luxodus
