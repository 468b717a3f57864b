// What both kinds of building share: what is there at a time, what is told of it, and limits. Any
// thread.
#pragma once

#include <string>

#include "scenes/formats/fds_input/input_building.hpp"

namespace luxodus::fds_input {

/// Whether something is there: by its clock, and not taken away by its name.
bool is_there(const std::string& name, const FdsCourse& course, const FdsInputOptions& options);

/// Whether an obstruction is there at any time, and not taken away by its name.
bool is_ever_there(const FdsObstruction& o, const FdsInputOptions& options);
/// When it comes or goes by a clock.
fds::FireTimes times_of(const FdsCourse& course);

/// Errors: a name in `without` that nothing has.
Result<void> names_known(const FdsInput& input, const FdsInputOptions& options);

Problem too_many_objects(const FdsInput& input);
Problem too_much_to_compare(const FdsInput& input);

/// Bodies of triangles, and what a person must know: what is not there, what no clock drives.
void add_bodies_and_notes(const FdsInput& input, const FdsInputOptions& options, FireBuilding& out);

/// How a surface, or what has a colour of its own, looks.
fds::FireLook input_look(const FdsInput& input, size_t surface,
                         const std::optional<glm::dvec3>& rgb, double opacity);

}  // namespace luxodus::fds_input
