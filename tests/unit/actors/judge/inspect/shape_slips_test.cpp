// Mistakes in shapes and sizes: furniture in floors and walls, planes slightly tilted or tiny,
// imports on their side or in another unit; each, and a similar scene that is correct.
#include <fmt/format.h>

#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

std::string furniture_box(const std::string& low, const std::string& high) {
  return "[[object]]\nname = \"cupboard\"\nshape = \"box\"\nmaterial = \"grey50\"\nlow = " + low +
         "\nhigh = " + high + "\ntags = [\"furniture\"]\n";
}

std::string desk_plane(const std::string& corner, const std::string& u, const std::string& v) {
  return "[[plane]]\nname = \"desk\"\ncorner = " + corner + "\nedge_u = " + u + "\nedge_v = " + v +
         "\ncells = [4, 4]\n";
}

/// A house of one storey, 20 x 10 x 3 m in its own unit of `unit_m`, its faces inwards; `z_up`: z
/// is up in the file, else y. `named`: whether its parts have names.
std::string house_obj(double unit_m, bool z_up, bool named) {
  std::string out;
  for (const double z : {0.0, 3.0})
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {20.0, 0.0}, {20.0, 10.0}, {0.0, 10.0}}) {
      const double a = x / unit_m, b = y / unit_m, c = z / unit_m;
      out += z_up ? fmt::format("v {} {} {}\n", a, b, c) : fmt::format("v {} {} {}\n", a, c, -b);
    }
  out += std::string("o ") + (named ? "Floor" : "p1") + "\nusemtl A\nf 1 2 3 4\n";
  out += std::string("o ") + (named ? "Ceiling" : "p2") + "\nusemtl A\nf 8 7 6 5\no p3\nusemtl A\n";
  for (const auto& [a, b] : {std::pair(1, 2), {2, 3}, {3, 4}, {4, 1}})
    out += fmt::format("f {} {} {} {}\n", a, a + 4, b + 4, b);
  return out;
}

std::vector<Finding> house(const std::string& obj, const std::string& units,
                           const std::string& up) {
  return found_in("[[import]]\nname = \"house\"\nfile = \"house.obj\"\nunits = \"" + units +
                      "\"\nup = \"" + up +
                      "\"\nmaterials = { A = \"grey50\" }\n"
                      "[[emitter]]\nname = \"lamp\"\nshape = \"point\"\n"
                      "distribution = \"isotropic\"\nposition = [2, 1.5, 2.7]\nflux_lm = 100\n",
                  {{"house.obj", obj}});
}

}  // namespace

TEST_CASE("furniture sunk in the floor is reported", "[inspect]") {
  check_found(found_in(furnished_room + furniture_box("[5, -0.5, -0.4]", "[6, 0.5, 1.4]")),
              Severity::warning, "the furniture \"cupboard\" is sunk by 0.4 m");
  // On the floor, pressed into a carpet, on a podium, and below a gallery.
  CHECK(found_in(furnished_room + furniture_box("[5, -0.5, 0]", "[6, 0.5, 1.4]")).empty());
  CHECK(found_in(furnished_room + furniture_box("[5, -0.5, -0.02]", "[6, 0.5, 1.4]")).empty());
  const std::string podium =
      "[[object]]\nname = \"podium\"\nshape = \"box\"\nmaterial = \"grey50\"\n"
      "low = [4, -1, 0]\nhigh = [7, 1, 0.4]\n";
  CHECK(
      found_in(furnished_room + podium + furniture_box("[5, -0.5, 0.4]", "[6, 0.5, 1.4]")).empty());
  check_found(found_in(furnished_room + podium + furniture_box("[5, -0.5, 0]", "[6, 0.5, 1.4]")),
              Severity::warning, "the furniture \"cupboard\" is sunk by 0.4 m");
}

TEST_CASE("furniture through a wall is reported, and furniture that touches one is not",
          "[inspect]") {
  check_found(found_in(furnished_room + thick_wall + furniture_box("[7, 1.2, 0]", "[9, 1.8, 1.4]")),
              Severity::warning, "the furniture \"cupboard\" reaches through \"partition\"");
  check_found(found_in(furnished_room + furniture_box("[5, 1.5, 0]", "[6, 2.5, 1.4]")),
              Severity::warning, "the furniture \"cupboard\" reaches through \"room.y1\"");
  CHECK(found_in(furnished_room + furniture_box("[5, 1.5, 0]", "[6, 2, 1.4]")).empty());
  CHECK(found_in(furnished_room + thick_wall + furniture_box("[7, -0.4, 0]", "[9, 0.4, 0.8]"))
            .empty());
}

TEST_CASE("planes slightly off horizontal, vertical or rectangular are reported", "[inspect]") {
  const auto plane = [](const std::string& u, const std::string& v) {
    return found_in(furnished_room + desk_plane("[1, -1, 0.8]", u, v));
  };
  check_found(plane("[5, 0, 0.08]", "[0, 2, 0]"), Severity::warning,
              "plane \"desk\" is tilted by 0.92 degrees, its edges rise by 80 mm");
  check_found(plane("[5, 0, 0]", "[0, -0.05, 1.5]"), Severity::warning,
              "plane \"desk\" leans by 1.9 degrees from the upright");
  check_found(plane("[5, 0.1, 0]", "[0, 2, 0]"), Severity::warning,
              "plane \"desk\" is no rectangle: its edges meet at 88.85 degrees");
  CHECK(plane("[5, 0, 0]", "[0, 2, 0]").empty());
  CHECK(plane("[5, 0, 0]", "[0, 0, 1.5]").empty());
  CHECK(plane("[4, 1, 0]", "[-0.4, 1.6, 0]").empty());
  CHECK(plane("[3, 0, 1.5]", "[0, 2, 0]").empty());
}

TEST_CASE("a plane that follows a ramp is accepted", "[inspect]") {
  const std::string ramp =
      "[[object]]\nname = \"ramp\"\nshape = \"quad\"\ncorner = [1, -1, 0.01]\n"
      "edge_u = [5, 0, 0.2]\nedge_v = [0, 2, 0]\nmaterial = \"grey50\"\n";
  const std::string over = desk_plane("[1, -1, 0.03]", "[5, 0, 0.2]", "[0, 2, 0]");
  CHECK(that_say(found_in(furnished_room + ramp + over), "tilted").empty());
  CHECK(that_say(found_in(furnished_room + over), "tilted").size() == 1);
}

TEST_CASE("a plane slanted over the floor of a route is reported", "[inspect]") {
  const auto found = [](const std::string& corner, const std::string& u, const std::string& v,
                        const std::string& more = "") {
    return found_in(furnished_room + long_way + more + desk_plane(corner, u, v));
  };
  check_found(found("[1, -1, 0.02]", "[8, 0, 0]", "[0, 2, 0.4]"), Severity::warning,
              "plane \"desk\" is tilted by 11 degrees over the level floor of route \"way\"");
  CHECK(found("[1, -1, 0.02]", "[8, 0, 0]", "[0, 2, 0]").empty());
  // A sloped desk is above the floor, and a wall's plane is vertical.
  CHECK(found("[5, -1, 0.8]", "[2, 0, 0]", "[0, 2, 0.4]").empty());
  CHECK(found("[1, -1, 0.02]", "[8, 0, 0]", "[0, 0, 2]").empty());
  // Over a ramp, while the route beside it is horizontal.
  const std::string ramp =
      "[[object]]\nname = \"ramp\"\nshape = \"quad\"\ncorner = [1, -1, 0.01]\n"
      "edge_u = [5, 0, 0]\nedge_v = [0, 2, 0.3]\nmaterial = \"grey50\"\n";
  CHECK(that_say(found("[1, -1, 0.03]", "[5, 0, 0]", "[0, 2, 0.3]", ramp), "tilted").empty());
}

TEST_CASE("a plane with swapped numbers of cells is reported", "[inspect]") {
  const auto found = [](const std::string& cells) {
    return found_in(furnished_room + replaced(desk_plane("[1, -1, 0.8]", "[10, 0, 0]", "[0, 2, 0]"),
                                              "[4, 4]", cells));
  };
  check_found(found("[10, 50]"), Severity::warning,
              "has cells of 1 m by 40 mm, which smear its minimum and its uniformity");
  CHECK(found("[50, 10]").empty());
  CHECK(found("[50, 1]").empty());
}

TEST_CASE("a plane in millimetres is reported", "[inspect]") {
  check_found(
      found_in(furnished_room + desk_plane("[1, -1, 0.8]", "[0.005, 0, 0]", "[0, 0.004, 0]")),
      Severity::warning, "plane \"desk\" is 5 mm x 4 mm large: its edges are in metres");
}

TEST_CASE("a lamp larger than any building is reported, and its light is no hole in the room",
          "[inspect]") {
  const auto lamp_of = [](const std::string& size) {
    return found_in(furnished_room +
                    "[[emitter]]\nname = \"panel\"\nshape = \"rectangle\"\nflux_lm = 3000\n"
                    "position = [3, 0, 2.9]\nsize = " +
                    size + "\n");
  };
  const auto found = lamp_of("[600, 600]");
  check_found(found, Severity::warning,
              "emitter \"panel\" is 600 m large, and the building 12 m: sizes are in metres");
  CHECK(that_say(found, "not closed").empty());
  CHECK(lamp_of("[0.6, 0.6]").empty());
}

TEST_CASE("a building whose doors have sizes in feet is reported", "[inspect]") {
  // The closed room with its doorway and leaves, `scale` times as large.
  const auto found = [](double scale, int leaves, const std::string& more = "") {
    const auto m = [&](double length) { return fmt::format("{:.6g}", length * scale); };
    std::string text =
        "[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [0, 0, 0]\nhigh = [" + m(12) + ", " +
        m(4) + ", " + m(3) + "]\nmaterial = \"grey50\"\n[[emitter]]\nname = \"lamp\"\n" +
        "shape = \"point\"\ndistribution = \"isotropic\"\nflux_lm = 100\nposition = [" + m(6) +
        ", " + m(2) + ", " + m(2.5) + "]\n" + more;
    for (int i = 0; i < leaves; ++i)
      text +=
          fmt::format("[[object]]\nname = \"leaf {}\"\nshape = \"box\"\nlow = [{}, 0, 0]\n", i,
                      m(2 + 2 * i)) +
          fmt::format("high = [{}, {}, {}]\nmaterial = \"grey50\"\ndoor = {{ hinge = [{}, 0, 0] ",
                      m(2.9 + 2 * i), m(0.04), m(2.05), m(2 + 2 * i)) +
          "}\n";
    return found_in(text);
  };
  const std::string words = "if that is in feet";
  check_found(
      found(1 / 0.3048, 2), Severity::warning,
      "all 2 doors, \"leaf 0\" first, are 6.73 m high, as no door is, and 2.05 m if that is "
      "in feet");
  CHECK(that_say(found(1, 2), words).empty());
  // A single gate of a hall, and a gate beside a door of normal size.
  CHECK(that_say(found(1 / 0.3048, 1), words).empty());
  CHECK(that_say(found(1 / 0.3048, 2,
                       "[[object]]\nname = \"door\"\nshape = \"box\"\nlow = [15, 0, 0]\n"
                       "high = [15.9, 0.04, 2.05]\nmaterial = \"grey50\"\n"
                       "door = { hinge = [15, 0, 0] }\n"),
                 words)
            .empty());
}

TEST_CASE("an imported building on its side is reported", "[inspect]") {
  for (const bool named : {false, true}) {
    INFO("parts have names: " << named);
    CHECK(that_say(house(house_obj(1, true, named), "m", "z"), "on its side").empty());
    CHECK(that_say(house(house_obj(1, false, named), "m", "y"), "on its side").empty());
    CHECK(that_say(house(house_obj(1, false, named), "m", "z"), "on its side").size() == 1);
    CHECK(that_say(house(house_obj(1, true, named), "m", "y"), "on its side").size() == 1);
  }
  check_found(house(house_obj(1, false, true), "m", "z"), Severity::warning,
              "its part \"house.Floor\" stands upright");
}

TEST_CASE("an imported building in inches is detected by the height of its storey", "[inspect]") {
  const std::string inches = house_obj(0.0254, true, false);
  CHECK(that_say(house(inches, "in", "z"), "its unit right").empty());
  check_found(house(inches, "m", "z"), Severity::warning,
              "\"house\" is 118 m from its floor to its ceiling, as no storey is: is its unit "
              "right: inches read as metres (it would be 3 m)?");
  check_found(house(inches, "cm", "z"), Severity::warning,
              "inches read as centimetres (it would be 3 m)");
  check_found(house(inches, "mm", "z"), Severity::warning,
              "inches read as millimetres (it would be 3 m)");
}
