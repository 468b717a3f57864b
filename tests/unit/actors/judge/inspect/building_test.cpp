// The building as a whole: units, rooms drawn inside out, rooms that are not closed, routes, planes
// and media; each mistake, and a similar scene that is correct.
#include "actors/judge/inspect/building.hpp"

#include <algorithm>
#include <fstream>
#include <numbers>

#include "actors/results/files/plane_cells.hpp"
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

/// A room of 4 x 3 x 2.8 units as a modelling program writes it, with its faces inwards or
/// outwards; the floor always faces up.
std::string room_obj(bool inward) {
  std::string out =
      "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.8\nv 4 0 2.8\nv 4 3 2.8\nv 0 3 2.8\n"
      "o floor\nusemtl A\nf 1 2 3 4\no ceiling\nusemtl A\n";
  out += inward ? "f 8 7 6 5\n" : "f 5 6 7 8\n";
  out += "o walls\nusemtl A\n";
  for (const auto& [a, b] : {std::pair(1, 2), {2, 3}, {3, 4}, {4, 1}}) {
    const int c = b + 4, d = a + 4;
    const int face[] = {a, b, c, d};
    out += "f";
    for (int i = 0; i < 4; ++i) out += " " + std::to_string(face[inward ? 3 - i : i]);
    out += "\n";
  }
  return out;
}

std::string imported(const std::string& units) {
  return "[[import]]\nname = \"room\"\nfile = \"room.obj\"\nunits = \"" + units +
         "\"\nup = \"z\"\nmaterials = { A = \"grey50\" }\n"
         "[[emitter]]\nname = \"lamp\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
         "position = [2, 1.5, 2.7]\nflux_lm = 100\n";
}

const std::string way =
    "[[route]]\nname = \"way\"\npath = [[0.5, 1.5, 0], [3.5, 1.5, 0]]\nwidth = 1\n";

std::string route(const std::string& path, double width) {
  return "[[route]]\nname = \"way\"\npath = " + path + "\nwidth = " + std::to_string(width) + "\n";
}

std::string room_without(const std::string& sides) {
  return replaced(furnished_room, "material = \"grey50\"",
                  "material = \"grey50\"\nomit = [" + sides + "]");
}

std::string smoke(const std::string& name, double extinction, const std::string& more = "") {
  return "[[medium]]\nname = \"" + name +
         "\"\nkind = \"homogeneous\"\nextinction = " + std::to_string(extinction) +
         "\nalbedo = 0.3\n" + more;
}

}  // namespace

TEST_CASE("an import with a size in another unit is reported", "[inspect]") {
  const auto millimetres = found_in(imported("mm"), {{"room.obj", room_obj(true)}});
  check_found(millimetres, Severity::warning, "\"room\" is 4 mm x 3 mm x 2.8 mm large");
  check_found(millimetres, Severity::error, "emitter \"lamp\" is ");
  std::string big = room_obj(true);
  for (const char* length : {" 4", " 3", " 2.8"})
    for (size_t at = 0; (at = big.find("v", at)) != std::string::npos && big[at + 1] == ' '; ++at)
      for (size_t n = big.find(length, at), end = big.find('\n', at); n < end;
           n = big.find(length, n + 1))
        big.replace(n, std::string(length).size(),
                    std::string(length) == " 2.8" ? " 2800" : std::string(length) + "000");
  check_found(found_in(imported("m"), {{"room.obj", big}}), Severity::warning,
              "\"room\" is 4 km x 3 km x 2.8 km large");
  CHECK(found_in(imported("m"), {{"room.obj", room_obj(true)}}).empty());
}

TEST_CASE("a room drawn with its faces outwards is reported, and treated as a room", "[inspect]") {
  const auto turned = found_in(imported("m") + way, {{"room.obj", room_obj(false)}});
  check_found(turned, Severity::warning,
              "the room \"room\" is drawn with its faces to the outside (\"room.");
  CHECK(that_say(turned, "leads through").empty());
  CHECK_FALSE(has_error(turned));
  CHECK(found_in(imported("m") + way, {{"room.obj", room_obj(true)}}).empty());
  // A body as large as a room, with nothing inside, is a body.
  const std::string block =
      "[[object]]\nname = \"block\"\nshape = \"box\"\nlow = [1, -1.5, 0]\n"
      "high = [4, 1.5, 2.5]\nmaterial = \"grey50\"\n";
  CHECK(that_say(found_in(furnished_room + block), "faces to the outside").empty());
}

TEST_CASE("rooms that are not closed are reported with the share of escaping light, by side",
          "[inspect]") {
  const auto top = found_in(room_without("\"ceiling\""));
  check_found(top, Severity::warning, "the rooms are not closed");
  CHECK(that_say(top, "top ").size() == 1);
  CHECK(that_say(top, "west ").empty());
  check_found(found_in(room_without("\"x0\"")), Severity::warning, "(west ");
  // Declared open; and with another side that is not.
  CHECK(that_say(found_in("open_sides = [\"top\"]\n" + room_without("\"ceiling\"")), "closed")
            .empty());
  check_found(found_in("open_sides = [\"top\"]\n" + room_without("\"ceiling\", \"x0\"")),
              Severity::warning, "declare open_sides = [\"top\", \"west\"]");
  // A pane of glass is intended; a hole of 2 cm loses less than 1 %.
  const std::string window =
      "[[material]]\nname = \"pane\"\nkind = \"glass\"\ntransmittance = 0.9\n" +
      room_without("\"x0\"") +
      "[[object]]\nname = \"window\"\nshape = \"quad\"\ncorner = [0, -2, 0]\n"
      "edge_u = [0, 4, 0]\nedge_v = [0, 0, 3]\nmaterial = \"pane\"\n";
  CHECK(that_say(found_in(window), "closed").empty());
  const std::string hole = room_without("\"x0\"") +
                           "[[object]]\nname = \"west\"\nshape = \"quad\"\ncorner = [0, -2, 0.02]\n"
                           "edge_u = [0, 4, 0]\nedge_v = [0, 0, 2.98]\nmaterial = \"grey50\"\n";
  CHECK(that_say(found_in(hole), "closed").empty());
}

TEST_CASE("the escaping share equals the closed form, counting only lamps inside", "[inspect]") {
  // A black room without a ceiling: of an isotropic point 0.5 m below its rim, the light between
  // the walls' upper edges. Solid angle of a rectangle a x b at distance d, Khadjavi 1968.
  const std::string black =
      replaced(closed_room, "material = \"grey50\"",
               "material = \"black0\"\nomit = [\"ceiling\"]") +
      "[[emitter]]\nname = \"lamp\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
      "position = [6, 0, 2.5]\nflux_lm = 1000\n";
  const auto scene = [&] {
    const test::TemporaryFolder folder;
    return described(folder.write("scene.toml", black));
  }();
  const double a = 12, b = 4, d = 0.5;
  const double angle = 4 * std::asin(a * b / std::sqrt((a * a + 4 * d * d) * (b * b + 4 * d * d)));
  const double expected = angle / (4 * std::numbers::pi);
  const auto found = inspected(scene);
  const auto open = that_say(found, "not closed");
  REQUIRE(open.size() == 1);
  const std::string& what = open.front().problem.what;
  const double said = std::stod(what.substr(what.find("air ") + 4)) / 100;
  CHECK(said == Approx(expected).margin(0.02));
  // A lamp beside the room loses all of its light, and does not count for the room.
  const auto beside = found_in(furnished_room +
                               "[[emitter]]\nname = \"street\"\nshape = \"point\"\n"
                               "distribution = \"isotropic\"\nposition = [20, 0, 2]\n"
                               "flux_lm = 100000\n");
  CHECK(that_say(beside, "not closed").empty());
}

TEST_CASE("routes outside, above their floor, through walls and too wide are reported",
          "[inspect]") {
  const auto with = [&](const std::string& more) { return found_in(furnished_room + more); };
  check_no_alarm(with(route("[[1, 0, 0], [11, 0, 0]]", 4)));
  check_found(with(route("[[1, 0, 0], [11, 0, 0]]", 0.4)), Severity::warning,
              "route \"way\" is 0.4 m wide, narrower than a person");
  check_found(with(route("[[1, 0, 0], [14, 0, 0]]", 1)), Severity::error,
              "route \"way\" has no floor under it: is it outside");
  check_found(with(route("[[1, 0, 1.5], [11, 0, 1.5]]", 1)), Severity::error,
              "route \"way\" has no floor under it: the floor lies 1.5 m below it");
  check_found(with(route("[[1, 0, 0.2], [11, 0, 0.2]]", 1)), Severity::warning,
              "route \"way\" lies 0.2 m above its floor");
  check_no_alarm(with(route("[[1, 0, 0.04], [11, 0, 0.04]]", 1)));
  // 4.4 m in 4 m: edges in walls. 8 m: strips. Off-centre: one edge.
  check_found(with(route("[[1, 0, 0], [11, 0, 0]]", 4.4)), Severity::warning,
              "its edges are judged inside walls; give it the width of what it leads through");
  check_found(with(route("[[1, 0, 0], [11, 0, 0]]", 8)), Severity::error,
              "strips of it are judged inside walls");
  check_found(with(route("[[1, 1, 0], [11, 1, 0]]", 3)), Severity::warning,
              "its edges are judged inside walls; move its line to the middle");
  // Through a doorway of 2 m in a wall of 0.2 m, which is not a corridor.
  check_no_alarm(with(thick_wall + route("[[1, 0, 0], [11, 0, 0]]", 3)));
  check_found(with(thick_wall + route("[[1, 1.5, 0], [11, 1.5, 0]]", 0.8)), Severity::error,
              "route \"way\" leads through the wall or body \"partition\"");
}

TEST_CASE("closed doors count by scenario, and are reported with it", "[inspect]") {
  const std::string door = R"(
[[object]]
name = "leaf"
shape = "quad"
corner = [4, -2, 0]
edge_u = [0, 4, 0]
edge_v = [0, 0, 3]
material = "grey50"
door = { hinge = [4, -2, 0] }
[[scenario]]
name = "shut"
[[scenario]]
name = "wide"
doors_open = ["leaf"]
)";
  const auto found = found_in(furnished_room + route("[[1, 0, 0], [11, 0, 0]]", 1) + door);
  check_found(found, Severity::warning, "leads through the closed door \"leaf\"");
  CHECK(that_say(that_say(found, "closed door"), "(in scenario \"shut\")").size() == 1);
  check_found(found, Severity::warning, "no direct light of an emergency luminaire on ");
}

TEST_CASE("areas without a floor or at another height are reported", "[inspect]") {
  const auto area = [&](const std::string& outline, const std::string& more = "") {
    return found_in(furnished_room + "[[open_area]]\nname = \"hall\"\noutline = " + outline + "\n" +
                    more);
  };
  check_no_alarm(area("[[0, -2], [12, -2], [12, 2], [0, 2]]"));
  check_found(area("[[20, -2], [32, -2], [32, 2], [20, 2]]"), Severity::error,
              "open area \"hall\" has no floor under most of it");
  check_found(area("[[0, -2], [18, -2], [18, 2], [0, 2]]"), Severity::warning,
              "open area \"hall\" has no floor under a part of it");
  check_found(area("[[0, -2], [12, -2], [12, 2], [0, 2]]", "z = 0.2\n"), Severity::warning,
              "open area \"hall\" lies 0.2 m above its floor");
}

TEST_CASE("cells of a plane in bodies are counted", "[inspect]") {
  const std::string plane =
      "[[plane]]\nname = \"floor\"\ncorner = [0, -2, 0.02]\n"
      "edge_u = [12, 0, 0]\nedge_v = [0, 4, 0]\ncells = [12, 4]\n";
  const auto block = [](const char* high) {
    return std::string(
               "[[object]]\nname = \"block\"\nshape = \"box\"\nlow = [2, -1, -0.1]\nhigh = ") +
           high + "\nmaterial = \"grey50\"\n";
  };
  const auto some = found_in(furnished_room + plane + block("[5, 1, 1]"));
  check_found(some, Severity::note, "plane \"floor\": 6 of 48 cells lie inside bodies");
  CHECK(found_in(furnished_room + plane).empty());
  // On the floor, with its bottom in the floor's plane.
  const std::string standing = replaced(block("[5, 1, 1]"), "[2, -1, -0.1]", "[2, -1, 0]");
  check_found(found_in(furnished_room + plane + standing), Severity::note,
              "plane \"floor\": 6 of 48 cells lie inside bodies");
  // The box of 3 m x 2 m is below the plane, which faces the box's top.
  CHECK(found_in(furnished_room + plane + block("[5, 1, 0.015]")).empty());
  check_found(found_in(furnished_room + plane + block("[14, 3, 1]") + ""), Severity::warning,
              "cells lie inside bodies");
}

TEST_CASE("cells in a body are identified by number, for any number of threads", "[inspect]") {
  const test::TemporaryFolder folder;
  const auto scene = described(folder.write(
      "scene.toml", furnished_room +
                        "[[plane]]\nname = \"floor\"\ncorner = [0, -2, 0.02]\n"
                        "edge_u = [12, 0, 0]\nedge_v = [0, 4, 0]\ncells = [12, 4]\n"
                        "[[object]]\nname = \"block\"\nshape = \"box\"\nlow = [2, -1, -0.1]\n"
                        "high = [5, 1, 1]\nmaterial = \"grey50\"\n"));
  for (const int threads : {1, 4}) {
    const auto building = Building::make(*scene, find_scenario(*scene, "").value(), threads);
    REQUIRE(building.ok());
    const auto inside = cells_in_bodies(building.value()->scene(), building.value()->rows(), 0);
    for (size_t i = 0; i < inside.size(); ++i) {
      const size_t u = i % 12, v = i / 12;
      CHECK((inside[i] != 0) == (u >= 2 && u < 5 && v >= 1 && v < 3));
    }
  }
}

TEST_CASE("overlapping media are reported, except flames and hazes", "[inspect]") {
  const std::string west = "box = [[0, -2], [6, 2]]\n", east = "box = [[6, -2], [12, 2]]\n";
  const std::string middle = "box = [[4, -2], [8, 2]]\n";
  const auto twice = found_in(furnished_room + smoke("one", 0.5, west) + smoke("two", 0.4, middle));
  check_found(twice, Severity::warning, "the medium \"two\" overlaps \"one\" (line ");
  CHECK(found_in(furnished_room + smoke("one", 0.5, west) + smoke("two", 0.4, east)).empty());
  check_found(found_in(furnished_room + smoke("one", 0.5, west) + smoke("haze", 0.02)),
              Severity::note, "is a haze in the other");
  const std::string flame =
      "[[medium]]\nname = \"flame\"\nkind = \"bounded\"\nbody = \"ellipsoid\"\n"
      "position = [3, 0, 0.6]\nradii = [0.3, 0.3, 0.5]\nextinction = 0.5\n"
      "albedo = 0\nemission = { power_w = 1000, temperature_k = 1400 }\n";
  CHECK(found_in(furnished_room + smoke("one", 0.5) + flame).empty());
  // Only where both exist.
  const std::string scenarios = "[[scenario]]\nname = \"one\"\nmedia = { two = 0 }\n";
  CHECK(found_in(furnished_room + smoke("one", 0.5) + smoke("two", 0.4) + scenarios).empty());
}

TEST_CASE("an eye in opaque smoke is noted", "[inspect]") {
  const std::string camera =
      "[[camera]]\nname = \"view\"\neye = [6, 0, 1.5]\ntarget = [11, 0, 1.5]\n";
  // 1.5 m to the floor's and the walls' nearest points in its picture, and more: e^-9.2 is 1e-4.
  check_found(found_in(furnished_room + camera + smoke("thick", 8)), Severity::note,
              "camera \"view\" stands in smoke that passes less than 1e-4");
  CHECK(found_in(furnished_room + camera + smoke("thin", 1)).empty());
}

TEST_CASE(
    "a finding common to several scenarios is reported once, and after ten of a kind the rest is "
    "counted",
    "[inspect]") {
  std::string lamps;
  for (int i = 0; i < 14; ++i)
    lamps += "[[emitter]]\nname = \"lost " + std::to_string(i) +
             "\"\nshape = \"point\"\ndistribution = \"isotropic\"\nposition = [8.1, -1.5, " +
             std::to_string(0.2 + 0.1 * i) + "]\nflux_lm = 100\n";
  const auto found = found_in(furnished_room + thick_wall + lamps +
                              "[[scenario]]\nname = \"a\"\n[[scenario]]\nname = \"b\"\n"
                              "operation = \"emergency\"\n");
  CHECK(found.size() == 10);
  CHECK(that_say(found, "(and 4 more like this)").size() == 1);
  CHECK(that_say(found, "scenario").empty());
}

TEST_CASE("the scenes that ship raise no false alarm", "[inspect]") {
  const std::filesystem::path library = std::filesystem::path(LUX_SOURCE_DIR) / "scenes/library";
  size_t scenes = 0;
  for (const auto& folder : {library, library / "pictures"})
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(".toml") || name.ends_with(".expected.toml")) continue;
      INFO(name);
      check_no_alarm(inspected(described(entry.path())));
      ++scenes;
    }
  CHECK(scenes >= 8);
}

// Seven million triangles: half a minute and 5 GB.
TEST_CASE("the tower that ships raises no false alarm", "[.long][inspect]") {
  const auto tower =
      described(std::filesystem::path(LUX_SOURCE_DIR) / "scenes/library/large/tower.toml");
  REQUIRE(tower->signs.size() > 0);
  check_no_alarm(inspected(tower));
}

TEST_CASE("a part that its import has found open is reported", "[inspect]") {
  // A tetrahedron, with and without its lowest face of half a square metre.
  const std::string shape =
      "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\no wall\nusemtl m\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const std::string import =
      furnished_room +
      "[[import]]\nname = \"house\"\nfile = \"wall.obj\"\nunits = \"m\"\nup = \"z\"\n"
      "material = \"grey50\"\n[[import.part]]\nmatch = \"wall\"\ntags = [\"open solid\"]\n";
  const auto open = found_in(import, {{"wall.obj", shape}});
  check_found(open, Severity::warning, "\"house.wall\" is a solid in its model");
  CHECK(that_say(open, "0.5 m2 are missing").size() == 1);
  std::string unmarked = import;
  unmarked.replace(unmarked.find("open solid"), 10, "wall");
  CHECK(that_say(found_in(unmarked, {{"wall.obj", shape}}), "is a solid").empty());
}
