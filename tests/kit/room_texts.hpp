// Pieces of scene files, shared by tests of several rooms. Constant data and pure functions; any
// thread.
#pragma once

#include <string>

namespace luxodus::test {

/// A closed room with its corner at the origin and reflectance 0.5. `high`: the opposite corner, in
/// the scene file's syntax.
inline std::string white_room(const std::string& high) {
  return R"(
[[material]]
name = "white"
reflectance = 0.5
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = )" +
         high + "\nmaterial = \"white\"\n";
}

/// A point source of 1000 lm over the middle of a room of 12 m by 4 m, with the emergency data that
/// the codes require.
inline const std::string middle_lamp = R"(
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [6, 0, 2.5]
flux_lm = 1000
emergency = "non-maintained"
emergency_flux = 500
maintenance_factor = 0.8
emergency_flux_is = "initial"
end_of_duration_factor = 0.75
)";

/// How people are judged on a route in a room, after the mains have failed. `path` in the scene
/// file's syntax; `more`: further keys of the scenario.
inline std::string judged_way(const std::string& path, const std::string& width,
                              const std::string& more = "") {
  return R"(
[assessment]
irritant_smoke = false
spacing_m = 4
eye_heights_m = [1.65]

[[route]]
name = "way"
path = )" +
         path + "\nwidth = " + width + R"(

[[scenario]]
name = "failed"
operation = "emergency"
)" + more;
}

/// A sign on an east wall that faces west. `position` in the scene file's syntax.
inline std::string exit_sign_at(const std::string& position) {
  return "\n[[sign]]\nname = \"exit\"\nposition = " + position + R"(
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10
)";
}

}  // namespace luxodus::test
