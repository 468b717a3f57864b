// Mistakes in plan: routes that end nowhere, turn back or are written twice, areas through walls,
// signs seen edge-on or in a doorway, doors in walls; each, and a similar scene that is correct.
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

std::string path_named(const std::string& name, const std::string& path) {
  return "[[route]]\nname = \"" + name + "\"\npath = " + path + "\nwidth = 1\n";
}

std::string exit_point(const std::string& kind, const std::string& position) {
  return "[[emphasis]]\nname = \"point\"\nkind = \"" + kind + "\"\nposition = " + position + "\n";
}

std::string outline_of(const std::string& kind, const std::string& outline,
                       const std::string& more = "") {
  return "[[" + kind + "]]\nname = \"hall\"\noutline = " + outline + "\n" + more;
}

/// A wall across the room without an opening, its faces at x = 8 and 8.2.
std::string shut_wall() {
  return replaced(thick_wall, "opening = [{ at = 1, width = 2, height = 2.1 }]\n", "");
}

std::string leaf_at(const std::string& low, const std::string& high, const std::string& door) {
  return "[[object]]\nname = \"leaf\"\nshape = \"box\"\nmaterial = \"grey50\"\nlow = " + low +
         "\nhigh = " + high + "\ndoor = { " + door + " }\n";
}

std::string hung(const std::string& position, const std::string& facing,
                 const std::string& more = "") {
  return replaced(
      replaced(replaced(exit_sign, "\"exit\"", "\"hung\""), "[11.95, 0, 2.2]", position),
      "facing = [-1, 0, 0]", "facing = " + facing + "\n" + more);
}

}  // namespace

TEST_CASE("a route that ends away from any exit is reported", "[inspect]") {
  const std::string nowhere = path_named("way", "[[1, 0, 0], [6, 0, 0]]");
  check_found(found_in(furnished_room + nowhere), Severity::warning,
              "route \"way\" ends at (6.00, 0.00, 0.00), where nobody gets out");
  // The exit sign at its end, a point of emphasis, an opening, and a route that continues.
  check_no_alarm(found_in(furnished_room + long_way));
  for (const char* kind : {"exit_door", "final_exit", "stairs", "refuge"})
    check_no_alarm(found_in(furnished_room + nowhere + exit_point(kind, "[6, 1.9, 0]")));
  check_found(found_in(furnished_room + nowhere + exit_point("call_point", "[6, 1.9, 1.2]")),
              Severity::warning, "where nobody gets out");
  check_no_alarm(found_in(furnished_room + thick_wall + nowhere));
  check_found(found_in(furnished_room + shut_wall() + nowhere), Severity::warning,
              "where nobody gets out");
  check_no_alarm(
      found_in(furnished_room + nowhere + path_named("on", "[[6, 0.5, 0], [11, 0.5, 0]]")));
  // A route that only goes back does not continue it.
  check_found(found_in(furnished_room + nowhere + path_named("back", "[[6, 0, 0], [1, 0, 0]]") +
                       exit_point("final_exit", "[0.1, 0, 0]")),
              Severity::warning, "route \"way\" ends at");
  // Without named exits, nothing says where routes should end.
  CHECK(that_say(found_in(closed_room + lamp + nowhere), "gets out").empty());
}

TEST_CASE("a route written from its exit inwards is reported as such", "[inspect]") {
  const std::string in = path_named("way", "[[11, 0, 0], [4, 0, 0]]");
  check_found(found_in(furnished_room + in + exit_point("final_exit", "[11.9, 0, 0]")),
              Severity::warning, "it begins at an exit: write its points the other way round");
}

TEST_CASE("a route that turns back on itself is reported", "[inspect]") {
  check_found(found_in(furnished_room + path_named("way",
                                                   "[[1, 0, 0], [9, 0, 0], [6, 0, 0], "
                                                   "[6, 1, 0], [11, 1, 0]]")),
              Severity::warning, "route \"way\" turns back on itself at");
  // Stairs with a half landing: two flights beside each other.
  check_no_alarm(found_in(
      furnished_room +
      path_named("way",
                 "[[1, -1, 0], [9, -1, 0], [9, 1, 0], [6, 1, 0], [6, 0.2, 0], [11, 0, 0]]")));
}

TEST_CASE("a route written twice is reported, the way back is not", "[inspect]") {
  check_found(found_in(furnished_room + long_way +
                       path_named("again", "[[1, 0, 0], [5, 0, 0], [11, 0, 0]]")),
              Severity::warning, "route \"again\" leads the very way of route \"way\" (line ");
  const std::string west = exit_point("final_exit", "[0.1, 0, 0]");
  check_no_alarm(
      found_in(furnished_room + long_way + west + path_named("back", "[[11, 0, 0], [1, 0, 0]]")));
}

TEST_CASE("areas that extend through walls are reported", "[inspect]") {
  const std::string both = "[[0.2, -1.8], [11.8, -1.8], [11.8, 1.8], [0.2, 1.8]]";
  check_found(found_in(furnished_room + shut_wall() + outline_of("open_area", both)),
              Severity::warning, "open area \"hall\" reaches through walls");
  check_found(found_in(furnished_room + shut_wall() +
                       outline_of("task_area", both, "z = 0.85\nmains_lx = 500\n")),
              Severity::warning, "task area \"hall\" reaches through walls");
  // A doorway joins two rooms, but does not make them one.
  const std::string narrow = replaced(thick_wall, "at = 1, width = 2", "at = 1.5, width = 0.9");
  check_found(found_in(furnished_room + narrow + outline_of("open_area", both)), Severity::warning,
              "open area \"hall\" reaches through walls");
  // One room, a screen in it, and furniture across it.
  CHECK(that_say(found_in(furnished_room + outline_of("open_area", both)), "reaches").empty());
  const std::string screen = replaced(shut_wall(), "to = [8.2, 2, 0]", "to = [8.2, 0, 0]");
  CHECK(that_say(found_in(furnished_room + screen + outline_of("open_area", both)), "reaches")
            .empty());
  CHECK(that_say(found_in(furnished_room + shut_wall() + "tags = [\"furniture\"]\n" +
                          outline_of("open_area", both)),
                 "reaches")
            .empty());
}

TEST_CASE("a sign seen edge-on from the route beside it is reported", "[inspect]") {
  const std::string lone = closed_room + lamp + long_way + exit_point("final_exit", "[11.9, 0, 0]");
  check_found(found_in(lone + hung("[7, 0, 2.4]", "[0, 1, 0]", "double_sided = true\n")),
              Severity::warning, "sign \"hung\" shows only its edge to route \"way\" (line ");
  check_no_alarm(found_in(lone + hung("[7, 0, 2.4]", "[-1, 0, 0]", "double_sided = true\n")));
  // On the side wall it is read by people who pass; its back serves the other direction.
  check_no_alarm(found_in(lone + hung("[7, 1.95, 2.4]", "[0, -1, 0]")));
  const auto back = found_in(lone + hung("[7, 0, 2.4]", "[1, 0, 0]"));
  check_no_alarm(back);
  check_found(back, Severity::note, "sign \"hung\" shows only its back to those on route \"way\"");
  const std::string return_way = path_named("return", "[[11, 0, 0], [1, 0, 0]]");
  CHECK(
      that_say(found_in(lone + return_way + hung("[7, 0, 2.4]", "[1, 0, 0]")), "its back").empty());
  // People on the floor beside the route read it.
  check_no_alarm(found_in(lone + hung("[7, 0, 2.4]", "[0, 1, 0]", "double_sided = true\n") +
                          outline_of("open_area", "[[0, -2], [12, -2], [12, 2], [0, 2]]")));
}

TEST_CASE("a sign that hangs in a doorway's opening is reported", "[inspect]") {
  const auto found = [](const std::string& position) {
    return found_in(closed_room + lamp + thick_wall + hung(position, "[-1, 0, 0]"));
  };
  check_found(found("[8.1, 0, 1.9]"), Severity::warning,
              "sign \"hung\" hangs in the opening of a doorway, its lower edge 1.8 m above");
  check_no_alarm(found("[7.95, 0, 2.3]"));
  CHECK(that_say(found("[5, 0, 1.9]"), "doorway").empty());
}

TEST_CASE("a door leaf in a wall, before a wall, or in no opening is reported", "[inspect]") {
  const std::string hinge = "hinge = [8.07, 1, 0]";
  const auto in = [&](const std::string& wall, const std::string& low, const std::string& high,
                      const std::string& door) {
    return found_in(furnished_room + wall + leaf_at(low, high, door));
  };
  check_found(in(shut_wall(), "[8.05, -1, 0.01]", "[8.09, 1, 2.1]", hinge), Severity::warning,
              "the door \"leaf\" stands in a wall when it is closed");
  check_found(in(shut_wall(), "[7.9, -1, 0.01]", "[7.94, 1, 2.1]", "hinge = [7.92, 1, 0]"),
              Severity::warning, "the door \"leaf\" stands before \"partition\"");
  check_found(in("", "[6, -0.5, 0.01]", "[6.04, 0.5, 2.1]", "hinge = [6, 0.5, 0]"),
              Severity::warning, "the door \"leaf\" stands in no opening");
  CHECK(in(thick_wall, "[8.05, -1, 0.01]", "[8.09, 1, 2.1]", hinge).empty());
}

TEST_CASE("a door leaf that opens into a wall is reported, in the scenarios where it is open",
          "[inspect]") {
  // At the end of its opening beside a side wall, so that it opens by at most 90 degrees.
  const std::string corner = replaced(thick_wall, "at = 1, width = 2", "at = 0.1, width = 1");
  const auto opened = [&](const std::string& door, const std::string& more) {
    return found_in(
        furnished_room + corner +
        leaf_at("[8.01, -1.89, 0.01]", "[8.05, -0.91, 2.1]", "hinge = [8.01, -1.89, 0], " + door) +
        more);
  };
  check_found(opened("open = true, open_angle_deg = 170", ""), Severity::warning,
              "the door \"leaf\" opens by 170 degrees into \"room.y0\"");
  CHECK(opened("open = true, open_angle_deg = 90", "").empty());
  CHECK(opened("open_angle_deg = 170", "").empty());
  const std::string scenarios =
      "[[scenario]]\nname = \"shut\"\n[[scenario]]\nname = \"wide\"\ndoors_open = [\"leaf\"]\n";
  const auto told = opened("open_angle_deg = 170", scenarios);
  CHECK(that_say(told, "(in scenario \"wide\")").size() == 1);
}
