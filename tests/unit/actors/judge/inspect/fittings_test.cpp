// Mistakes in places, signs, eyes and routes: equipment in the air, faces that look up, arrows that
// point back, barriers across a route; each, and a similar scene that is correct.
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

std::string emphasis(const std::string& kind, const std::string& position,
                     const std::string& facing = "") {
  return "[[emphasis]]\nname = \"point\"\nkind = \"" + kind + "\"\nposition = " + position + "\n" +
         (facing.empty() ? "" : "facing = " + facing + "\n");
}

std::string route_of(const std::string& path) {
  return "[[route]]\nname = \"way\"\npath = " + path + "\nwidth = 1\n";
}

std::string bar(const std::string& low, const std::string& high) {
  return "[[object]]\nname = \"bar\"\nshape = \"box\"\nmaterial = \"grey50\"\nlow = " + low +
         "\nhigh = " + high + "\n";
}

std::string with(const std::string& from, const std::string& to) {
  return closed_room + lamp + replaced(exit_sign, from, to);
}

const std::string in_place = "position = [11.95, 0, 2.2]";

}  // namespace

TEST_CASE("equipment that hangs on nothing, is out of reach or outside is reported", "[inspect]") {
  const auto extinguisher = [](const std::string& position) {
    return found_in(furnished_room + emphasis("fire_equipment", position));
  };
  check_found(extinguisher("[6, 0, 1]"), Severity::warning, "hangs in the air");
  check_found(extinguisher("[0.1, 0, 2.7]"), Severity::warning, "lies 2.7 m above what is below");
  check_found(extinguisher("[-2, 0, 1]"), Severity::warning, "lies outside the building");
  check_found(extinguisher("[6, 0, 5]"), Severity::warning, "lies outside the building");
  CHECK(extinguisher("[0.1, 0, 1]").empty());
  CHECK(extinguisher("[0, 0, 1]").empty());
  CHECK(extinguisher("[6, 0, 0]").empty());
}

TEST_CASE("doors away from every wall and marks far above the floor are reported", "[inspect]") {
  const std::string hall =
      replaced(replaced(furnished_room, "low = [0, -2, 0]", "low = [0, -8, 0]"),
               "high = [12, 2, 3]", "high = [12, 8, 3]");
  check_found(found_in(hall + emphasis("final_exit", "[6, 0, 0]")), Severity::warning,
              "is a door, at (6.00, 0.00, 0.00), and no wall is within 3 m");
  CHECK(found_in(hall + emphasis("final_exit", "[11.9, 0, 0]")).empty());
  CHECK(found_in(hall + emphasis("intersection", "[6, 0, 0]")).empty());
  check_found(found_in(hall + emphasis("intersection", "[6, 0, 2]")), Severity::warning,
              "lies 2 m above what is below it");
}

TEST_CASE("equipment whose front faces its wall, or up, is reported", "[inspect]") {
  const auto panel = [](const std::string& facing) {
    return found_in(furnished_room + emphasis("alarm_panel", "[0.1, 0, 1.5]", facing));
  };
  check_found(panel("[-1, 0, 0]"), Severity::warning, "has a front that faces a wall");
  check_found(panel("[0, 0, 1]"), Severity::warning, "has a front that looks up or down");
  CHECK(panel("[1, 0, 0]").empty());
}

TEST_CASE("signs that look up, hang on their side or have an implausible size are reported",
          "[inspect]") {
  check_found(found_in(with("position = [11.95, 0, 2.2]\nfacing = [-1, 0, 0]",
                            "position = [8, 0, 2.2]\nfacing = [0, 0, -1]\nup = [1, 0, 0]")),
              Severity::warning, "sign \"exit\" faces the floor");
  check_found(found_in(with("facing = [-1, 0, 0]", "facing = [-1, 0, 0]\nup = [0, 0, -1]")),
              Severity::warning, "sign \"exit\" hangs upside down");
  check_found(found_in(with("facing = [-1, 0, 0]", "facing = [-1, 0, 0]\nup = [0, 1, 0]")),
              Severity::warning, "sign \"exit\" hangs on its side");
  check_found(found_in(with("width = 0.4\nheight = 0.2", "width = 1.5\nheight = 0.75")),
              Severity::warning, "sign \"exit\" is 0.75 m high in a room of 3 m");
  CHECK(found_in(with(in_place, "position = [11.95, 0, 2.3]")).empty());
}

TEST_CASE("signs through a ceiling, above it or at waist height are reported", "[inspect]") {
  check_found(found_in(with(in_place, "position = [11.95, 0, 2.98]")), Severity::warning,
              "sign \"exit\" sticks through \"room.ceiling\"");
  check_found(found_in(with(in_place, "position = [11.5, 0, 3.4]")), Severity::warning,
              "sign \"exit\" hangs above the ceiling");
  check_found(found_in(with(in_place, "position = [11.95, 0, 1.2]")), Severity::note,
              "where people and furniture hide it");
  CHECK(found_in(with(in_place, "position = [11.95, 0, 0.3]")).empty());
}

TEST_CASE("an arrow that points back along its route is reported", "[inspect]") {
  // On the north wall: the reader looks north, and east is to the right.
  const auto arrow = [](const std::string& text) {
    const std::string words =
        "[[sign]]\nname = \"arrow\"\nposition = [6, 1.95, 2.2]\n"
        "facing = [0, -1, 0]\nwidth = 0.9\nheight = 0.3\ntext = \"" +
        text +
        "\"\nmains_white = 100\nmains_green = 10\nemergency_white = 100\n"
        "emergency_green = 10\n";
    return words;
  };
  const auto told = [&](const std::string& file, const std::string& path) {
    const test::TemporaryFolder folder;
    const auto drawing = std::filesystem::path(LUX_SOURCE_DIR) / "scenes/library/signs" / file;
    std::filesystem::copy_file(drawing, folder / file);
    const std::string sign = replaced(
        replaced(arrow("X"), "text = \"X\"", "file = \"" + file + "\"\nsmallest_detail = 0.01"),
        "width = 0.9", "width = 0.6");
    return inspected(described(folder.write("scene.toml", furnished_room + sign + route_of(path))));
  };
  const std::string east = "[[1, 0, 0], [11, 0, 0]]", west = "[[11, 0, 0], [1, 0, 0]]";
  check_found(told("exit_left.svg", east), Severity::warning,
              "sign \"arrow\" points to the left, and route \"way\"");
  check_found(told("exit_right.svg", west), Severity::warning,
              "sign \"arrow\" points to the right");
  CHECK(that_say(told("exit_right.svg", east), "points to").empty());
  CHECK(that_say(told("exit_straight.svg", east), "points to").empty());
  // The route ends before the sign, and its arrow points through the door beside it.
  CHECK(that_say(told("exit_left.svg", "[[1, 0, 0], [6, 0, 0]]"), "points to").empty());
}

TEST_CASE("observers that look up or away, and eyes at implausible heights, are reported",
          "[inspect]") {
  const auto eye = [](const std::string& at, const std::string& gaze) {
    return found_in(furnished_room + "[[observer]]\nname = \"eye\"\neye = " + at +
                    "\ngaze = " + gaze + "\n");
  };
  check_found(eye("[2, 0, 1.6]", "[0, 0, 1]"), Severity::warning, "looks at the ceiling");
  check_found(eye("[2, 0, 1.6]", "[-1, 0, 0]"), Severity::warning, "looks away from every sign");
  check_found(eye("[2, 0, 2.8]", "[1, 0, 0]"), Severity::warning, "has its eye 2.8 m above");
  check_found(eye("[2, 0, 0.1]", "[1, 0, 0]"), Severity::warning, "has its eye 0.1 m above");
  CHECK(eye("[2, 0, 0.6]", "[1, 0, 0]").empty());
}

TEST_CASE("barriers, sills and beams across a route are reported", "[inspect]") {
  const std::string way = route_of("[[1, 0, 0], [11, 0, 0]]");
  check_found(found_in(furnished_room + way + bar("[5, -2, 0]", "[5.1, 2, 0.6]")),
              Severity::warning, "route \"way\" climbs over \"bar\"");
  check_found(found_in(furnished_room + way + bar("[5, -2, 0.9]", "[5.1, 2, 1.3]")),
              Severity::warning, "route \"way\" climbs over or ducks under \"bar\"");
  check_found(found_in(furnished_room + way + bar("[5, -2, 1.2]", "[5.1, 2, 1.5]")),
              Severity::warning, "route \"way\" ducks under \"bar\"");
  check_found(found_in(furnished_room + way + bar("[5, -2, 0]", "[5.1, 2, 0.4]")),
              Severity::warning, "route \"way\" climbs over \"bar\"");
  check_found(found_in(furnished_room + way + bar("[5, -2, 1.8]", "[5.1, 2, 3]")),
              Severity::warning, "has less than 1.9 m of headroom under \"bar\"");
  CHECK(found_in(furnished_room + way + bar("[5, -2, 2.1]", "[5.1, 2, 3]")).empty());
}

TEST_CASE("floating furniture is reported, and slabs, hung and stacked things are not",
          "[inspect]") {
  const auto piece = [](const std::string& low, const std::string& high) {
    return found_in(furnished_room + bar(low, high) + "tags = [\"furniture\"]\n");
  };
  check_found(piece("[5, -0.5, 0.4]", "[6, 0.5, 1.4]"), Severity::warning,
              "the furniture \"bar\" floats 0.4 m above");
  CHECK(piece("[5, -0.5, 0]", "[6, 0.5, 1]").empty());
  CHECK(piece("[5, -0.5, 0.72]", "[6, 0.5, 0.75]").empty());
  CHECK(piece("[5, 1.6, 1.4]", "[6, 2, 2]").empty());
}

TEST_CASE("a door whose hinge is away from its leaf is reported", "[inspect]") {
  const auto leaf = [](const std::string& door) {
    return found_in(furnished_room + thick_wall + bar("[8.05, -1, 0.01]", "[8.09, 1, 2.1]") +
                    "door = { " + door + " }\n");
  };
  check_found(leaf("hinge = [8.07, 4, 0]"), Severity::error,
              "turns about a hinge that is 3 m away");
  check_found(leaf("hinge = [8.07, 1.3, 0]"), Severity::warning, "a hinge that is 0.3 m away");
  check_found(leaf("hinge = [8.07, 1, 0], axis = [1, 0, 0]"), Severity::warning,
              "turns about a level axis");
  check_found(leaf("hinge = [8.07, 1, 0], open_angle_deg = -1.5"), Severity::warning,
              "opens by -1.5 degrees, as good as closed");
  CHECK(leaf("hinge = [8.07, 1, 0]").empty());
}

TEST_CASE("objects placed exactly on each other are reported", "[inspect]") {
  const std::string second = replaced(bar("[5, 1, 0]", "[6, 2, 1]"), "\"bar\"", "\"again\"");
  check_found(found_in(furnished_room + bar("[5, 1, 0]", "[6, 2, 1]") + second), Severity::warning,
              "\"again\" fills the very space of \"bar\"");
  check_found(found_in(furnished_room + bar("[0, -2, 0]", "[12, 2, 3]")), Severity::warning,
              "\"bar\" fills the very space of \"room\"");
  const std::string beside = replaced(bar("[6, 1, 0]", "[7, 2, 1]"), "\"bar\"", "\"beside\"");
  CHECK(found_in(furnished_room + bar("[5, 1, 0]", "[6, 2, 1]") + beside).empty());
}

TEST_CASE("planes above people's heads and above the ceiling are reported", "[inspect]") {
  const auto plane = [](const std::string& z) {
    return found_in(furnished_room + "[[plane]]\nname = \"desk\"\ncorner = [1, -1, " + z +
                    "]\nedge_u = [5, 0, 0]\nedge_v = [0, 2, 0]\ncells = [5, 2]\n");
  };
  check_found(plane("2.2"), Severity::note, "lies 2.2 m above what is below it");
  check_found(plane("3.2"), Severity::warning, "plane \"desk\" lies above the ceiling");
  CHECK(plane("0.85").empty());
}
