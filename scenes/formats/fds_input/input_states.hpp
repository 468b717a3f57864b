// What exact and snapped buildings share: which objects exist at a time, notes about them, and
// limits. Pure functions; any thread.
#pragma once

#include <string>

#include "scenes/formats/fds_input/input_building.hpp"

namespace luxodus::fds_input {

/// Whether an object exists: by its clock, and not left out by its handle.
bool is_there(const FdsTitle& title, const FdsCourse& course, const FdsInputOptions& options);

/// Whether an obstruction exists at any time, and is not left out by its handle.
bool is_ever_there(const FdsObstruction& o, const FdsInputOptions& options);
/// When clocks make it appear and vanish.
fds::FireTimes times_of(const FdsCourse& course);

/// Errors: a name in `without` that no object has.
Result<void> names_known(const FdsInput& input, const FdsInputOptions& options);

Problem too_many_objects(const FdsInput& input);
Problem too_much_to_compare(const FdsInput& input);

/// Adds bodies of triangles and notes for the user: which objects are absent, and which no clock
/// drives.
void add_bodies_and_notes(const FdsInput& input, const FdsInputOptions& options, FireBuilding& out);

/// The appearance of a surface, or of an object with a colour of its own.
fds::FireLook input_look(const FdsInput& input, size_t surface,
                         const std::optional<glm::dvec3>& rgb, double opacity);

}  // namespace luxodus::fds_input
