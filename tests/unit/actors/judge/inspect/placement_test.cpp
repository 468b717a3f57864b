// Places of luminaires, signs and eyes: each mistake, and a similar scene that is correct.
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

std::string lamp_at(const std::string& name, const std::string& position,
                    const std::string& more = "distribution = \"isotropic\"\n") {
  return "[[emitter]]\nname = \"" + name + "\"\nshape = \"point\"\nposition = " + position +
         "\nflux_lm = 100\n" + more;
}

std::string panel(const std::string& position, const std::string& more = "") {
  return "[[emitter]]\nname = \"panel\"\nshape = \"rectangle\"\nposition = " + position +
         "\nsize = [0.6, 0.6]\nflux_lm = 1000\n" + more;
}

std::string camera_at(const std::string& eye, const std::string& target) {
  return "[[camera]]\nname = \"view\"\neye = " + eye + "\ntarget = " + target + "\n";
}

std::string box(const std::string& low, const std::string& high,
                const std::string& material = "grey50") {
  return "[[object]]\nname = \"box\"\nshape = \"box\"\nlow = " + low + "\nhigh = " + high +
         "\nmaterial = \"" + material + "\"\n";
}

}  // namespace

TEST_CASE("a closed room with a lamp and a sign has no findings", "[inspect]") {
  CHECK(found_in(furnished_room).empty());
}

TEST_CASE("a luminaire in a wall is an error, one on a wall is not", "[inspect]") {
  // In the middle of 0.2 m: no light escapes, although it travels farther than 2 cm.
  const auto inside = found_in(furnished_room + thick_wall + lamp_at("lost", "[8.1, -1.5, 2]"));
  check_found(inside, Severity::error, "emitter \"lost\" lies inside \"partition\"");
  const auto near = found_in(furnished_room + thick_wall +
                             lamp_at("lost", "[8.01, -1.5, 2]",
                                     "distribution = \"cosine_power\"\ncosine_power = 2\n"
                                     "direction = [-1, 0, 0]\n"));
  check_found(near, Severity::error, "emitter \"lost\" lies in a wall or body: 88 %");
  // A tenth of a millimetre in front: half of its light ends there, as intended.
  check_no_alarm(found_in(furnished_room + thick_wall + lamp_at("right", "[7.9999, -1.5, 2]")));
}

TEST_CASE("lamps in a ceiling's plane, in a recess and with a body of their own are accepted",
          "[inspect]") {
  check_no_alarm(found_in(furnished_room + panel("[3, 0, 3]")));
  check_no_alarm(found_in(furnished_room + panel("[3, 0, 2.98]", "body_material = \"grey50\"\n")));
  const std::string slab = replaced(closed_room, "material = \"grey50\"",
                                    "material = \"grey50\"\nomit = [\"ceiling\"]") +
                           lamp + exit_sign;
  // A ceiling with a hole of 0.7 m, and a housing over it.
  const std::string ceiling = R"(
[[object]]
name = "ceiling with a hole"
shape = "wall"
from = [0, 0, 0]
to = [12, 0, 0]
height = 4
thickness = 0.1
material = "grey50"
opening = [{ at = 2.65, sill = 1.65, width = 0.7, height = 0.7 }]
rotate_deg = [90, 0, 0]
translate = [0, 2, 3]
[[object]]
name = "housing"
shape = "box"
low = [2.65, -0.35, 3.1]
high = [3.35, 0.35, 3.2]
material = "grey50"
)";
  check_no_alarm(found_in(slab + ceiling + panel("[3, 0, 3.095]")));
}

TEST_CASE("a lamp above the ceiling is an error", "[inspect]") {
  const char* above = "is above the ceiling: \"room.ceiling\"";
  check_found(found_in(furnished_room + panel("[3, 0, 3.05]")), Severity::error, above);
  check_found(found_in(furnished_room + lamp_at("lost", "[3, 0, 3.6]")), Severity::error, above);
  const std::string roof_slab = box("[0, -2, 3]", "[12, 2, 3.4]");
  check_found(found_in(furnished_room + roof_slab + lamp_at("lost", "[3, 0, 3.7]")),
              Severity::error, "is above the ceiling: \"box\"");
  // High above the roof, and on a roof on which people walk.
  check_no_alarm(found_in(furnished_room + lamp_at("mast", "[3, 0, 7]")));
  const std::string roof_way =
      "[[route]]\nname = \"roof\"\npath = [[1, 0, 3], [11, 0, 3]]\nwidth = 1\n";
  CHECK(that_say(found_in(furnished_room + roof_way + lamp_at("roof", "[3, 0, 3.9]")),
                 "above the ceiling")
            .empty());
  // On the roof, and facing away from it.
  const auto roof = found_in(furnished_room + panel("[3, 0, 3.05]", "direction = [0, 0, 1]\n"));
  check_no_alarm(roof);
  check_found(roof, Severity::note, "emitter \"panel\" stands outside the building");
}

TEST_CASE("light passes glass globes, so a lamp in one is accepted, and one in a box is not",
          "[inspect]") {
  const std::string in_box = furnished_room + lamp_at("boxed", "[3, 0, 1.5]");
  check_no_alarm(found_in(R"([[material]]
name = "glass"
kind = "glass"
transmittance = 0.9
)" + in_box + box("[2.9, -0.1, 1.4]", "[3.1, 0.1, 1.6]", "glass")));
  check_found(found_in(in_box + box("[2.9, -0.1, 1.4]", "[3.1, 0.1, 1.6]")), Severity::error,
              "emitter \"boxed\" lies inside \"box\"");
}

TEST_CASE(
    "a thing farther away than ten times the building's height is reported as in another unit",
    "[inspect]") {
  check_found(found_in(furnished_room + lamp_at("mm", "[6000, 0, 2500]")), Severity::error,
              "emitter \"mm\" is 6.49 km from everything solid");
  check_found(found_in(furnished_room + camera_at("[6000, 0, 1600]", "[0, 0, 1600]")),
              Severity::error, "camera \"view\" is ");
  check_found(found_in(replaced(furnished_room, "[11.95, 0, 2.2]", "[11950, 0, 2200]")),
              Severity::error, "sign \"exit\" is ");
  // A lamp in the street: nine heights away.
  const auto street = found_in(furnished_room + lamp_at("street", "[39, 0, 2.5]"));
  check_no_alarm(street);
  check_found(street, Severity::note, "emitter \"street\" stands outside the building");
}

TEST_CASE("outside is found by rays, not by the bounding box", "[inspect]") {
  // An L of two rooms: its bounding box includes the yard between them.
  const std::string wing = R"(
[[object]]
name = "wing"
shape = "room"
low = [0, 2.3, 0]
high = [4, 12, 3]
material = "grey50"
)";
  const std::string in_wing = lamp_at("inside", "[2, 8, 2]");
  const auto yard = found_in(furnished_room + wing + in_wing + lamp_at("yard", "[8, 8, 2]"));
  check_found(yard, Severity::note, "emitter \"yard\" stands outside the building");
  CHECK(that_say(yard, "inside\"").empty());
  check_no_alarm(yard);
}

TEST_CASE("a lamp level with a missing ceiling is inside, one on a post beside the room is not",
          "[inspect]") {
  const std::string roofless = replaced(furnished_room, "material = \"grey50\"",
                                        "material = \"grey50\"\nomit = [\"ceiling\"]");
  const std::string ground =
      "[[object]]\nname = \"ground\"\nshape = \"quad\"\ncorner = [-50, -50, -0.1]\n"
      "edge_u = [200, 0, 0]\nedge_v = [0, 100, 0]\nmaterial = \"grey50\"\n";
  for (const char* height : {"2.97", "3", "3.2"})
    CHECK(that_say(found_in(roofless + panel("[9, 0, " + std::string(height) + "]")),
                   "stands outside")
              .empty());
  check_found(found_in(roofless + ground + panel("[60, 0, 4]")), Severity::note,
              "emitter \"panel\" stands outside");
}

TEST_CASE("luminaires nearer than five openings give a warning where codes judge their light",
          "[inspect]") {
  // A round opening of 0.2 m that shines down: five openings are 1 m.
  const std::string ies =
      "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 -0.2 -0.2 0\n1 1 10\n0 45 90\n0\n"
      "300 200 0\n";
  const auto found = [&](const std::string& text) {
    return found_in(furnished_room +
                        "[[luminaire]]\nname = \"low lamp\"\nfile = \"lamp.ies\"\n"
                        "position = [3, 0, 0.9]\ncircuit = \"low\"\n"
                        "emergency = \"maintained\"\nemergency_factor = 1\n"
                        "maintenance_factor = 0.8\nemergency_flux_is = "
                        "\"initial\"\nend_of_duration_factor = 0.7\n" +
                        text,
                    {{"lamp.ies", ies}});
  };
  const std::string way = "[[route]]\nname = \"way\"\npath = [[1, 0, 0], [11, 0, 0]]\nwidth = 1\n";
  const std::string sentence = "route \"way\" is 0.9 m from luminaire \"low lamp\"";
  const std::string emergency = "[[scenario]]\nname = \"lit\"\noperation = \"emergency\"\n";
  check_found(found(way), Severity::note, sentence);
  check_found(found(way + emergency), Severity::warning, sentence);
  check_found(found("[[probe]]\nname = \"spot\"\nposition = [3, 0, 0.2]\n"), Severity::note,
              "probe \"spot\" is 0.7 m from luminaire \"low lamp\"");
  // Only the state with the lamp on, of two states of light with the same doors.
  const std::string dark = replaced(emergency, "lit", "dark") + "circuits = { low = 0 }\n";
  check_found(found(way + emergency + dark), Severity::warning, "(in scenario \"lit\")");
  check_no_alarm(found(replaced(way, "[[1, 0, 0]", "[[5, 0, 0]") + emergency));
}

TEST_CASE("two luminaires or two signs in one place are reported, intended pairs are not",
          "[inspect]") {
  const std::string first_lamp = lamp_at("first", "[3, 0, 2.5]");
  check_found(found_in(furnished_room + first_lamp + lamp_at("again", "[3, 0.001, 2.5]")),
              Severity::warning, "emitter \"again\" stands where emitter \"first\" (line ");
  // Beside it; and in the same place, but on when the other is off.
  check_no_alarm(found_in(furnished_room + first_lamp + lamp_at("beside", "[3, 0.05, 2.5]")));
  check_no_alarm(found_in(furnished_room + lamp_at("of the mains", "[6, 0, 2.5]")));
  const std::string second = replaced(exit_sign, "\"exit\"", "\"second\"");
  check_found(found_in(furnished_room + second), Severity::warning,
              "sign \"second\" hangs where sign \"exit\" (line ");
  // Back to back, in the room's middle.
  const std::string first = replaced(exit_sign, "[11.95, 0, 2.2]", "[7, 0, 2.2]");
  const std::string back =
      replaced(replaced(first, "\"exit\"", "\"back\""), "[-1, 0, 0]", "[1, 0, 0]");
  check_no_alarm(found_in(closed_room + lamp + first + back));
}

TEST_CASE("a sign in a wall is an error, one that faces a wall a warning", "[inspect]") {
  check_found(found_in(replaced(furnished_room, "[11.95, 0, 2.2]", "[11.95, 0, 2.2]") + thick_wall +
                       replaced(replaced(exit_sign, "\"exit\"", "\"walled\""), "[11.95, 0, 2.2]",
                                "[8.01, -1.5, 2]")),
              Severity::error, "sign \"walled\" lies in a wall or body: \"partition\"");
  check_found(found_in(replaced(furnished_room, "facing = [-1, 0, 0]", "facing = [1, 0, 0]")),
              Severity::warning, "sign \"exit\" faces a wall less than 0.3 m before it");
  check_found(found_in(replaced(furnished_room, "facing = [-1, 0, 0]",
                                "facing = [-1, 0, 0]\ndouble_sided = true")),
              Severity::warning, "sign \"exit\" is double-sided and its back face looks at a wall");
  check_no_alarm(found_in(replaced(
      replaced(furnished_room, "facing = [-1, 0, 0]", "facing = [-1, 0, 0]\ndouble_sided = true"),
      "[11.95, 0, 2.2]", "[10, 0, 2.2]")));
}

TEST_CASE("an emergency luminaire that lights no judged place is noted, if places are judged",
          "[inspect]") {
  const std::string wall = R"([[object]]
name = "partition"
shape = "wall"
from = [8.2, -2, 0]
to = [8.2, 2, 0]
height = 3
thickness = 0.2
material = "grey50"
)";
  const std::string far =
      "emergency = \"non-maintained\"\nemergency_flux = 100\n"
      "maintenance_factor = 1\nemergency_flux_is = \"initial\"\nend_of_duration_factor = 1\n"
      "distribution = \"isotropic\"\n";
  const std::string rooms = furnished_room + wall + lamp_at("store", "[10, 0, 2.5]", far);
  const std::string route =
      "[[route]]\nname = \"way\"\npath = [[1, 0, 0], [7, 0, 0]]\nwidth = 1.6\n";
  CHECK(that_say(found_in(rooms), "no route").empty());
  const auto judged = found_in(rooms + route);
  check_found(judged, Severity::note, "emitter \"store\" is an emergency luminaire");
  CHECK(that_say(judged, "\"lamp\" is an emergency luminaire").empty());
}

TEST_CASE(
    "a route without light from emergency luminaires is reported, with a lamp that could light it",
    "[inspect]") {
  const std::string wall =
      replaced(thick_wall, "opening = [{ at = 1, width = 2, height = 2.1 }]\n",
               "opening = [{ at = 0.2, width = 1, height = 2.1 }]\n");  // outside the lamp's light
  const std::string route =
      "[[route]]\nname = \"way\"\npath = [[9, 1, 0], [11.5, 1, 0]]\nwidth = 1\n";
  const auto found = [&](const std::string& store) {
    return found_in(furnished_room + wall + route + lamp_at("store", "[10, 0, 2.5]", store));
  };
  const auto dark = found("distribution = \"isotropic\"\n");
  check_found(dark, Severity::warning,
              "route \"way\" gets no direct light of an emergency luminaire on ");
  CHECK(that_say(dark, "fails with the mains: is its 'emergency' missing?").size() == 1);
  CHECK(that_say(found("distribution = \"isotropic\"\nemergency = \"maintained\"\n"
                       "emergency_flux = 90\nmaintenance_factor = 0.8\n"
                       "emergency_flux_is = \"initial\"\nend_of_duration_factor = 0.8\n"),
                 "gets no direct light")
            .empty());
}

TEST_CASE("eyes and probes in bodies are errors, those that see nothing warnings", "[inspect]") {
  const std::string block = box("[2, -0.5, 0]", "[3, 0.5, 1.2]");
  check_found(found_in(furnished_room + block + camera_at("[2.5, 0, 0.6]", "[8, 0, 1]")),
              Severity::error, "camera \"view\" is inside a wall or body");
  check_no_alarm(found_in(furnished_room + block + camera_at("[2.5, 0, 1.3]", "[8, 0, 1]")));
  const std::string observer = "[[observer]]\nname = \"eye\"\ntarget = [11.95, 0, 2.2]\neye = ";
  check_found(found_in(furnished_room + block + observer + "[2.5, 0, 0.6]\n"), Severity::error,
              "observer \"eye\" is inside a wall or body");
  check_no_alarm(found_in(furnished_room + block + observer + "[5, 0, 1.6]\n"));
  const std::string probe = "[[probe]]\nname = \"spot\"\nposition = ";
  check_found(found_in(furnished_room + block + probe + "[2.5, 0, 0.6]\n"), Severity::error,
              "probe \"spot\" is inside a wall or body");
  // On the floor, and on the box.
  check_no_alarm(found_in(furnished_room + block + probe + "[5, 0, 0]\n"));
  check_no_alarm(found_in(furnished_room + block + probe + "[2.5, 0, 1.2]\n"));
  check_found(found_in(furnished_room + camera_at("[14, 0, 1.5]", "[20, 0, 1.5]")),
              Severity::warning, "camera \"view\" sees nothing");
  // Under a lamp in the open, with nothing else; and facing away from it.
  const std::string street = lamp_at("street", "[20, 0, 4]") + probe + "[20, 0, 0]\n";
  check_no_alarm(found_in(furnished_room + street));
  check_found(found_in(furnished_room + street + "normal = [0, 0, -1]\n"), Severity::warning,
              "probe \"spot\" sees nothing");
  // Behind the sign.
  const std::string hung = replaced(furnished_room, "[11.95, 0, 2.2]", "[6, 1, 2.2]");
  check_found(found_in(hung + observer + "[9, 1, 1.6]\n"), Severity::warning,
              "observer \"eye\" sees no sign");
}
