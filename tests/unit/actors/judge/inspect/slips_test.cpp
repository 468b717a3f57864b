// Mistakes that were once missed, or reported for correct scenes: smoke and flames outside the
// building, furniture on a route, faces of a room drawn one by one, places that nobody sees.
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

std::string slip_smoke(const std::string& where) {
  return "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 0.5\nalbedo = 0.3\n" +
         where;
}

std::string layers(double low, double high) {
  return "[[medium]]\nname = \"smoke\"\nkind = \"layered\"\nlayer = [{ z_low = " +
         std::to_string(low) + ", z_high = " + std::to_string(high) +
         ", extinction = 0.5, albedo = 0.3 }]\n";
}

std::string flame(const std::string& name, const std::string& position,
                  const std::string& radii = "[0.2, 0.2, 0.5]") {
  return "[[medium]]\nname = \"" + name +
         "\"\nkind = \"bounded\"\nbody = \"ellipsoid\"\nposition = " + position +
         "\nradii = " + radii +
         "\nextinction = 0.5\nalbedo = 0.2\n[medium.emission]\npower_w = 50000\n"
         "temperature_k = 1400\n";
}

std::string rack(const std::string& more) {
  return "[[object]]\nname = \"rack\"\nshape = \"box\"\nlow = [4, -0.5, 0]\nhigh = [5, 0.5, 1.9]\n"
         "material = \"grey50\"\n" +
         more;
}

std::string face(const std::string& name, const std::string& corner, const std::string& u,
                 const std::string& v) {
  return "[[object]]\nname = \"" + name + "\"\nshape = \"quad\"\ncorner = " + corner +
         "\nedge_u = " + u + "\nedge_v = " + v + "\nmaterial = \"grey50\"\n";
}

/// The closed room as six faces in tables of their own, all facing inwards or outwards.
std::string six_faces(bool inward) {
  const auto one = [&](const char* name, const char* corner, const char* u, const char* v) {
    return inward ? face(name, corner, v, u) : face(name, corner, u, v);
  };
  return one("floor", "[0, -2, 0]", "[0, 4, 0]", "[12, 0, 0]") +
         one("ceiling", "[0, -2, 3]", "[12, 0, 0]", "[0, 4, 0]") +
         one("west", "[0, -2, 0]", "[0, 0, 3]", "[0, 4, 0]") +
         one("east", "[12, -2, 0]", "[0, 4, 0]", "[0, 0, 3]") +
         one("south", "[0, -2, 0]", "[12, 0, 0]", "[0, 0, 3]") +
         one("north", "[0, 2, 0]", "[0, 0, 3]", "[12, 0, 0]");
}

std::string plane(const std::string& corner, const std::string& u, const std::string& v) {
  return "[[plane]]\nname = \"desk\"\ncorner = " + corner + "\nedge_u = " + u + "\nedge_v = " + v +
         "\ncells = [12, 8]\n";
}

std::string with_sign(const std::string& from, const std::string& to) {
  return closed_room + lamp + replaced(exit_sign, from, to);
}

}  // namespace

TEST_CASE("smoke that reaches no part of the building is reported", "[inspect]") {
  check_found(found_in(furnished_room + slip_smoke("box = [[20, -2], [28, 2]]\n")),
              Severity::warning, "the medium \"smoke\" lies outside the building");
  check_found(found_in(furnished_room + slip_smoke("z_low = 1500\nz_high = 3000\n")),
              Severity::error, "the medium \"smoke\" is 1.5 km from everything solid");
  const std::string two = replaced(layers(1.5, 2.2), " }]",
                                   " }, { z_low = 2200, z_high = 3000, extinction = 1, "
                                   "albedo = 0.3 }]");
  check_found(found_in(furnished_room + two), Severity::warning,
              "layer 2 of the medium \"smoke\", from z = 2200 to 3000 m, lies outside");
  check_no_alarm(found_in(furnished_room + layers(1.5, 30)));
  check_no_alarm(found_in(furnished_room + slip_smoke("box = [[10, -2], [28, 2]]\n")));
}

TEST_CASE("smoke whose box has swapped numbers is reported, with the order that fits",
          "[inspect]") {
  const std::string judged = furnished_room + long_way;
  const auto found = [&](const std::string& box) {
    return found_in(judged + slip_smoke("box = " + box + "\n"));
  };
  check_found(found("[[-2, 0], [2, 12]]"), Severity::warning,
              "box = [[0, -2], [12, 2]], nothing would");
  check_found(found("[[1, 11], [-1, 1]]"), Severity::warning,
              "box = [[1, -1], [11, 1]], nothing would");
  // Shifted equally far to the east: no order of its numbers fits.
  check_found(found("[[10, -2], [28, 2]]"), Severity::note,
              "of the smoke of the medium \"smoke\" lies outside the building, where");
  CHECK(that_say(found("[[-40, -40], [50, 50]]"), "lies outside").empty());
  CHECK(that_say(found("[[0, -2], [12, 2]]"), "lies outside").empty());
  // Without judged people it may be intended.
  check_no_alarm(found_in(furnished_room + slip_smoke("box = [[-2, 0], [2, 12]]\n")));
}

TEST_CASE("flames in bodies, outside and twice in one place are reported", "[inspect]") {
  const std::string cupboard =
      "[[object]]\nname = \"box\"\nshape = \"box\"\nlow = [3, -1.5, 0]\nhigh = [5, 0, 2]\n"
      "material = \"grey50\"\n";
  check_found(found_in(furnished_room + cupboard + flame("fire", "[4, -0.75, 1]")), Severity::error,
              "the flame \"fire\" lies inside a wall or body, with 100 %");
  check_found(found_in(furnished_room + flame("fire", "[3000, 1000, 800]")), Severity::error,
              "the flame \"fire\" is ");
  const auto through = found_in(furnished_room + flame("fire", "[3, 1.95, 0.8]"));
  check_found(through, Severity::warning, "the flame \"fire\" burns outside the building with ");
  CHECK(that_say(through, "rooms are not closed").empty());
  check_found(found_in(furnished_room + flame("fire", "[6, 0, 0.8]", "[200, 200, 500]")),
              Severity::warning, "the flame \"fire\" burns outside the building with 100 %");
  const auto yard = found_in(furnished_room + flame("fire", "[3, 4, 0.8]"));
  check_no_alarm(yard);
  check_found(yard, Severity::note, "the flame \"fire\" burns outside the building");
  check_found(found_in(furnished_room + flame("fire", "[3, 0, 0.8]") + flame("f2", "[3, 0, 0.8]")),
              Severity::warning, "the flame \"f2\" burns where the flame \"fire\" (line ");
  check_no_alarm(
      found_in(furnished_room + flame("fire", "[3, 0, 0.8]") + flame("f2", "[3.2, 0, 0.8]")));
}

TEST_CASE("furniture on a route is not a wall, and hides no floor", "[inspect]") {
  check_no_alarm(found_in(furnished_room + long_way + rack("tags = [\"furniture\"]\n")));
  check_found(found_in(furnished_room + long_way + rack("")), Severity::error,
              "route \"way\" leads through the wall or body \"rack\"");
}

TEST_CASE("a room of single faces that look outwards is reported, and treated as a room",
          "[inspect]") {
  const auto turned = found_in(six_faces(false) + lamp + exit_sign + long_way);
  check_found(turned, Severity::warning, "is drawn with its faces to the outside (\"");
  CHECK(that_say(turned, "inside").empty());
  CHECK(that_say(turned, "leads through").empty());
  CHECK(found_in(six_faces(true) + lamp + exit_sign + long_way).empty());
}

TEST_CASE("signs outside are no hole in the rooms, and backs on walls are not judged",
          "[inspect]") {
  const std::string outside = replaced(
      replaced(replaced(exit_sign, "\"exit\"", "\"outer\""), "[11.95, 0, 2.2]", "[12.1, 0, 2.4]"),
      "[-1, 0, 0]", "[1, 0, 0]");
  const auto over_door = found_in(furnished_room + outside);
  check_no_alarm(over_door);
  check_found(over_door, Severity::note, "sign \"outer\" hangs outside the building");
  const auto twice = found_in(
      with_sign("position = [11.95, 0, 2.2]", "position = [11.97, 0, 2.2]\ndouble_sided = true"));
  check_found(twice, Severity::warning, "sign \"exit\" is double-sided and its back face looks at");
  CHECK(that_say(twice, "rooms are not closed").empty());
  check_no_alarm(found_in(
      with_sign("position = [11.95, 0, 2.2]", "position = [6, 1, 2.2]\ndouble_sided = true")));
}

TEST_CASE("planes that face what they lie on, or extend outside, are reported", "[inspect]") {
  check_found(found_in(furnished_room + plane("[0, -2, 0.02]", "[0, 4, 0]", "[12, 0, 0]")),
              Severity::warning, "plane \"desk\" looks at \"room.floor\"");
  check_found(found_in(furnished_room + plane("[0, -6, 0.02]", "[12, 0, 0]", "[0, 12, 0]")),
              Severity::warning, "of its cells lie outside the building");
  const auto above = found_in(furnished_room + plane("[0, -2, 7.5]", "[12, 0, 0]", "[0, 4, 0]"));
  check_found(above, Severity::note, "plane \"desk\" lies outside the building");
  CHECK(found_in(furnished_room + plane("[0, -2, 0.02]", "[12, 0, 0]", "[0, 4, 0]")).empty());
  CHECK(found_in(furnished_room + plane("[0, -2, 0]", "[12, 0, 0]", "[0, 4, 0]")).empty());
}

TEST_CASE("eyes that only see backs and blocked probes are reported", "[inspect]") {
  const auto camera = [](const std::string& eye) {
    return "[[camera]]\nname = \"view\"\neye = " + eye + "\ntarget = [9, 0, 1.5]\n";
  };
  check_found(found_in(furnished_room + camera("[1, 0, -0.6]")), Severity::warning,
              "camera \"view\" sees the backs of surfaces alone");
  CHECK(found_in(furnished_room + camera("[1, 0, 0.6]")).empty());
  const auto probe = [](const std::string& normal) {
    return "[[probe]]\nname = \"p\"\nposition = [3, 0, 0.02]\nnormal = " + normal + "\n";
  };
  check_found(found_in(furnished_room + probe("[0, 0, -1]")), Severity::warning,
              "probe \"p\" looks at \"room.floor\"");
  CHECK(found_in(furnished_room + probe("[0, 0, 1]")).empty());
}

TEST_CASE("judged places far away or outside are reported", "[inspect]") {
  const auto emphasis = [](const std::string& position) {
    return "[[emphasis]]\nname = \"door\"\nkind = \"final_exit\"\nposition = " + position + "\n";
  };
  check_found(found_in(furnished_room + emphasis("[11900, 0, 0]")), Severity::error,
              "point of emphasis \"door\" is 11.9 km from everything solid");
  check_found(found_in(furnished_room + rack("") + emphasis("[4.5, 0, 1]")), Severity::warning,
              "point of emphasis \"door\" lies inside a wall or body");
  CHECK(found_in(furnished_room + emphasis("[12, 0, 0]")).empty());
  const auto task = [](const std::string& z) {
    return "[[task_area]]\nname = \"bench\"\noutline = [[2, -1], [4, -1], [4, 1], [2, 1]]\nz = " +
           z + "\nmains_lx = 500\n";
  };
  check_found(found_in(furnished_room + task("85")), Severity::warning,
              "task area \"bench\" lies outside the building, 82 m above what is below it");
  CHECK(found_in(furnished_room + task("0.85")).empty());
}

TEST_CASE("a percentage taken for a share of the flux is reported", "[inspect]") {
  const auto lit = [](const std::string& factor) {
    const test::TemporaryFolder folder;
    std::filesystem::copy_file(
        std::filesystem::path(LUX_SOURCE_DIR) / "scenes/library/luminaires/emergency_downlight.ldt",
        folder / "lamp.ldt");
    return inspected(described(
        folder.write("scene.toml", furnished_room +
                                       "[[luminaire]]\nname = \"light\"\nfile = \"lamp.ldt\"\n"
                                       "position = [3, 0, 2.97]\nemergency = \"non-maintained\"\n"
                                       "emergency_factor = " +
                                       factor +
                                       "\nmaintenance_factor = 0.8\nemergency_flux_is = "
                                       "\"initial\"\nend_of_duration_factor = 0.7\n")));
  };
  check_found(lit("15"), Severity::warning, "luminaire \"light\" gives 15 times the 200 lm");
  const auto twice = lit("2");
  check_found(twice, Severity::warning, "'emergency_factor' is 2: on emergency supply");
  check_found(twice, Severity::note, "gives 400 lm in emergency operation, and its file 200 lm");
  CHECK(lit("0.15").empty());
}
