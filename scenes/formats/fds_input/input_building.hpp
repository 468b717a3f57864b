// Turns the building of an FDS input file into tables of a scene: exactly as written, or snapped to
// the mesh cells as FDS does it. Pure functions but for `reading`; any thread.
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
  /// Handles of obstructions, holes and openings to leave out, for those that no clock drives.
  std::set<std::string> without;
  /// Receives how many obstructions are done, where given.
  ReadingShare* reading = nullptr;
};

/// Keeps coordinates as written. Holes cut obstructions with PERMIT_HOLE exactly; faces of meshes
/// are closed where no other mesh and no opening is. Obstructions that touch no mesh are left out
/// and counted in the notes.
/// Errors: more than limits::fire_objects or limits::fds_input_pairs; a name in `without` that no
/// object has.
Result<FireBuilding> exact_building(const FdsInput& input, const FdsInputOptions& options);

/// Snaps the building as FDS does: like `fire_building_of` of its results. Bodies of triangles stay
/// as written.
/// Errors: as snapped_case.
Result<FireBuilding> snapped_building(const FdsInput& input, const FdsInputOptions& options);

/// The meshes, obstructions and openings that FDS would have at one time. Obstructions are snapped
/// to the nearest nodes; thin ones become plates, or get thickness by THICKEN. One that straddles
/// the middle of a cell and is thinner than a quarter of it is snapped to the nearer node.
/// Errors: as exact_building; a stretched grid.
Result<fds::Case> snapped_case(const FdsInput& input, const FdsInputOptions& options);

}  // namespace luxodus
