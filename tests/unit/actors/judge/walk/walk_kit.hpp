// A hall of 20 m x 6 m with a route from west to east, a sign over its end and one that leads
// nowhere, and people who walk along it. Any thread.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/kit/walkers.hpp"
#include "tests/kit/described.hpp"

namespace luxodus::test {

/// A sign on the east wall.
inline std::string hall_sign(const std::string& name, double y) {
  return fmt::format(
      "\n[[sign]]\nname = \"{}\"\nplain = \"green\"\nsmallest_detail = 0.02\nwidth = 0.4\n"
      "height = 0.2\nposition = [19.9, {}, 2.3]\nfacing = [-1, 0, 0]\nmains_white = 500\n"
      "mains_green = 60\nemergency_white = 200\nemergency_green = 30\n",
      name, y);
}

/// Walls, floor and ceiling of a box, a partition with a door at x = 10, signs and a route.
inline const std::string hall_text = R"(
[[object]]
name = "hall"
shape = "room"
low = [0, 0, 0]
high = [20, 6, 3]
material = "grey50"

[[object]]
name = "south partition"
shape = "box"
low = [9.9, 0, 0]
high = [10.1, 2.5, 3]
material = "grey50"

[[object]]
name = "north partition"
shape = "box"
low = [9.9, 3.5, 0]
high = [10.1, 6, 3]
material = "grey50"

[[object]]
name = "door"
shape = "quad"
corner = [10, 2.5, 0]
edge_u = [0, 1, 0]
edge_v = [0, 0, 2.1]
material = "grey50"
door = { hinge = [10, 2.5, 0], open_angle_deg = 90 }
)" + hall_sign("exit", 3) + R"([[sign.leads_to]]
route = "out"
arrow = "ahead"
)" + hall_sign("elsewhere", 1) + R"(
[[route]]
name = "out"
path = [[1, 3, 0], [19, 3, 0]]
width = 1.6

[[scenario]]
name = "mains"
operation = "mains"
)";

}  // namespace luxodus::test
