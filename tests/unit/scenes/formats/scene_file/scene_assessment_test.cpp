// Routes, areas, people and variants: read field by field, mistakes with their lines.
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes/light/geometry/polygon.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

TEST_CASE("routes, areas, points of emphasis and people are read", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[assessment]
age_years = 70
other_eyes = ["23", "protan", "protan 75"]
eye_heights_m = [1.5]
spacing_m = 0.5
smoke_expected = false
irritant_smoke = true
[[route]]
name = "way"
path = [[0, 0, 0], [4, 0, 0], [4, 3, 1]]
width = 1.8
[[open_area]]
name = "hall"
outline = [[0, 0], [0, 4], [4, 4], [4, 0]]
z = 2
[[task_area]]
name = "bench"
outline = [[0, 0], [1, 0], [1, 1]]
z = 0.9
mains_lx = 500
[[emphasis]]
name = "hose"
kind = "fire_equipment"
position = [1, 2, 1]
facing = [0, -2, 0]
)");
  CHECK(s.assessment.age_years == 70);
  REQUIRE(s.assessment.other_eyes.size() == 3);
  CHECK(s.assessment.other_eyes[0].age_years == 23);
  CHECK_FALSE(s.assessment.other_eyes[0].protan);
  CHECK(s.assessment.other_eyes[1].protan);
  CHECK_FALSE(s.assessment.other_eyes[1].age_years);
  CHECK(s.assessment.other_eyes[2].age_years == 75);
  CHECK(s.assessment.eye_heights_m == std::vector<double>{1.5});
  CHECK(s.assessment.irritant_smoke == true);
  CHECK_FALSE(s.assessment.smoke_expected);
  REQUIRE(s.routes.size() == 1);
  CHECK(s.routes[0].path.back() == glm::dvec3(4, 3, 1));
  CHECK(s.routes[0].width_m == 1.8);
  REQUIRE(s.open_areas.size() == 1);
  CHECK(signed_area(s.open_areas[0].outline) == 16);  // counter-clockwise now
  CHECK(s.open_areas[0].z_m == 2);
  REQUIRE(s.task_areas.size() == 1);
  CHECK(s.task_areas[0].mains_lx == 500);
  REQUIRE(s.emphasis.size() == 1);
  CHECK(s.emphasis[0].kind == EmphasisKind::fire_equipment);
  CHECK(*s.emphasis[0].facing == glm::dvec3(0, -1, 0));
}

TEST_CASE("rooms are read, and two that overlap on one storey are reported by name",
          "[format][scene]") {
  SceneFolder f;
  const std::string hall =
      "[[room]]\nname = \"hall\"\noutline = [[0, 0], [4, 0], [4, 4], [0, 4]]\n";
  const auto room = [](const std::string& at, const std::string& z) {
    return "[[room]]\nname = \"store\"\nz = " + z + "\noutline = [[" + at +
           ", 0], [9, 0], [9, 4], [" + at + ", 4]]\n";
  };
  // Rooms share a wall; a room of the next storey stands above.
  CHECK(good(f, hall + room("4", "0")).rooms.size() == 2);
  CHECK(good(f, hall + room("3", "3")).rooms[1].z_m == 3);
  const auto read = f.read(hall + room("3", "0"));
  REQUIRE(read.problems.list().size() == 1);
  const Problem problem = read.problems.list().front();
  CHECK(problem.where.line == 4);
  CHECK(problem.what ==
        "room 'store' overlaps room 'hall' by 4 m2: a place belongs to one room, mend an outline");
}

TEST_CASE("a project without a name is warned of", "[format][scene]") {
  SceneFolder f;
  const auto warned = [&](const std::string& text) {
    const auto s = good(f, text);
    return std::any_of(s.warnings.begin(), s.warnings.end(), [](const Problem& one) {
      return one.what.starts_with("[project] has no 'name'");
    });
  };
  CHECK(warned("[project]\nclient = \"A\"\n"));
  CHECK_FALSE(warned("[project]\nclient = \"A\"\nname = \"B\"\n"));
  CHECK_FALSE(warned("title = \"nothing\"\n"));
}

TEST_CASE("unstated assumptions about people have their defaults", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, "title = \"nothing\"\n");
  CHECK(s.assessment.age_years == 65);
  CHECK(s.assessment.eye_heights_m == std::vector<double>{1.65, 1.2, 0.6});
}

TEST_CASE("rule sets and deviations are read, and unknown ones are reported with a list",
          "[format][scene]") {
  SceneFolder f;
  const auto s = good(f,
                      "[assessment]\nrules = [\"en1838-2024\", \"nfpa101\"]\n"
                      "deviations = [\"de-asr-a3.4-3\"]\n");
  CHECK(s.assessment.rules == std::vector<std::string>{"en1838-2024", "nfpa101"});
  CHECK(s.assessment.deviations == std::vector<std::string>{"de-asr-a3.4-3"});
  CHECK(s.assessment.place.line == 1);
  CHECK_FALSE(s.assessment.irritant_smoke.has_value());
  for (const char* wrong : {"\nrules = [\"en1838\"]\n", "\ndeviations = [\"en1838\"]\n"}) {
    const auto read = f.read(std::string("[assessment]") + wrong);
    REQUIRE_FALSE(read.problems.empty());
    CHECK(read.problems.list().front().where.line == 2);
    CHECK(read.problems.list().front().what.find("there is no \"en1838\"") == 0);
  }
}

TEST_CASE("each file of a scene may state a part of its assessment", "[format][scene]") {
  SceneFolder f;
  f.put("people.toml", "[assessment]\nage_years = 70\nspacing_m = 3\nirritant_smoke = true\n");
  const auto s = good(f, "include = [\"people.toml\"]\n[assessment]\nspacing_m = 1\n");
  CHECK(s.assessment.age_years == 70);
  CHECK(s.assessment.spacing_m == 1);
  CHECK(s.assessment.irritant_smoke == true);
}

TEST_CASE("a luminaire keeps the factors that its fluxes contain", "[format][scene]") {
  SceneFolder f;
  const std::string lamp =
      "[[emitter]]\nname = \"a\"\nshape = \"point\"\nposition = [0, 0, 1]\nflux_lm = 100\n"
      "maintenance_factor = 0.8\n";
  const auto mains = good(f, lamp).emitters[0];
  CHECK(mains.maintenance_factor == 0.8);
  CHECK(mains.end_of_duration_factor == 1);
  CHECK_FALSE(mains.maintained);
  for (const std::string kind : {"maintained", "non-maintained"}) {
    const auto e = good(f, lamp + "emergency = \"" + kind +
                               "\"\nemergency_factor = 0.5\nend_of_duration_factor = 0.7\n")
                       .emitters[0];
    CHECK(e.end_of_duration_factor == 0.7);
    CHECK(e.emergency_flux == Approx(100 * 0.5 * e.maintenance_factor * e.end_of_duration_factor));
    CHECK(e.maintained == (kind == "maintained"));
  }
}

TEST_CASE("mistakes in routes and areas are reported with their lines", "[format][scene]") {
  SceneFolder f;
  const auto told = [&](const std::string& text) {
    const auto read = f.read(text);
    REQUIRE_FALSE(read.problems.empty());
    CHECK(read.problems.list().front().where.line > 0);
    return read.problems.list().front().what;
  };
  CHECK(told("[[route]]\nname = \"a\"\npath = [[0, 0, 0]]\nwidth = 2\n").find("two points") !=
        std::string::npos);
  CHECK(told("[[route]]\nname = \"a\"\npath = [[0, 0], [1, 1]]\nwidth = 2\n")
            .find("points [x, y, z]") != std::string::npos);
  CHECK(told("[[route]]\nname = \"a\"\npath = [[0, 0, 0], [0, 0, 3]]\nwidth = 2\n")
            .find("less than 1 cm apart") != std::string::npos);
  CHECK(told("[[open_area]]\nname = \"a\"\noutline = [[0, 0], [1, 1], [1, 0], [0, 1]]\n")
            .find("outline") != std::string::npos);
  for (const char* wrong : {"90", "deutan", "protan 90", "65 years"})
    CHECK(told("[assessment]\nother_eyes = [\"" + std::string(wrong) + "\"]\n")
              .find("'other_eyes' has") != std::string::npos);
  CHECK(told("[assessment]\nage_years = 90\n").find("age_years") != std::string::npos);
  CHECK(told("[assessment]\neye_heights_m = []\n").find("names no height") != std::string::npos);
  CHECK(told("[[emphasis]]\nname = \"a\"\nkind = \"sofa\"\nposition = [0, 0, 0]\n").find("kind") !=
        std::string::npos);
}

TEST_CASE("a change must name an existing thing", "[format][scene]") {
  SceneFolder f;
  const auto read = f.read("[[change]]\nkind = \"sign\"\nof = \"exit\"\nfactor = 2\n");
  REQUIRE_FALSE(read.problems.empty());
  CHECK(read.problems.list().front().what.find("no sign \"exit\" to change") != std::string::npos);
  const std::string lamp =
      "[[emitter]]\nname = \"lamp\"\nshape = \"point\"\nposition = [0, 0, 1]\nflux_lm = 10\n";
  const auto dimmed = good(f, lamp +
                                  "[[change]]\nkind = \"luminaire\"\nof = \"lamp\"\nfactor = 0.5\n"
                                  "position = [1, 2, 3]\nfacing = [0, 0, 1]\n");
  CHECK(dimmed.emitters[0].mains_flux == 5);
  CHECK(dimmed.emitters[0].frame.origin == glm::dvec3(1, 2, 3));
  CHECK(dimmed.emitters[0].frame.axes[2].z == Approx(-1));
  const auto turned = f.read(lamp +
                             "[[change]]\nkind = \"luminaire\"\nof = \"lamp\"\n"
                             "facing = [0, 0, 1]\n");
  REQUIRE_FALSE(turned.problems.empty());
  CHECK(turned.problems.list().front().what.find("needs 'position'") != std::string::npos);
}

namespace {

const std::string lamp_and_sign = R"(
[[emitter]]
name = "lamp"
shape = "point"
position = [0, 0, 1]
flux_lm = 10
[[sign]]
name = "exit"
position = [0, 1, 2]
facing = [1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10
)";

std::string copy_of(const std::string& kind, const std::string& of, const std::string& rest) {
  return "[[change]]\nkind = \"" + kind + "\"\nof = \"" + of + "\"\n" + rest;
}

}  // namespace

TEST_CASE("a change adds a copy under another name, and leaves the original", "[format][scene]") {
  SceneFolder f;
  const auto s = good(
      f,
      lamp_and_sign +
          copy_of("sign", "exit",
                  "copy = \"way out\"\nposition = [3, 0, 2]\nfacing = [0, 1, 0]\n") +
          copy_of("luminaire", "lamp", "copy = \"spare\"\nposition = [2, 2, 2]\nfactor = 0.5\n") +
          copy_of("luminaire", "spare", "factor = 0.5\n") +
          copy_of("sign", "way out", "copy = \"third\"\nposition = [4, 0, 2]\n"));
  REQUIRE(s.signs.size() == 3);
  CHECK(s.signs[0].frame.origin == glm::dvec3(0, 1, 2));
  CHECK(s.signs[1].name == "way out");
  CHECK(s.signs[1].frame.origin == glm::dvec3(3, 0, 2));
  CHECK(s.signs[1].frame.axes[2].y == Approx(1));
  CHECK(s.signs[1].colours[0].mains_cd_m2 == 500);
  CHECK(s.signs[2].frame.axes == s.signs[1].frame.axes);  // as what it is a copy of stands by then
  REQUIRE(s.emitters.size() == 2);
  CHECK(s.emitters[0].mains_flux == 10);
  CHECK(s.emitters[1].name == "spare");
  CHECK(s.emitters[1].mains_flux == 2.5);
  CHECK(s.emitters[1].frame.origin == glm::dvec3(2, 2, 2));
}

TEST_CASE("an impossible copy is reported once, with its line", "[format][scene]") {
  SceneFolder f;
  const auto told = [&](const std::string& text, const std::string& what) {
    const auto read = f.read(lamp_and_sign + text);
    INFO(all_problems(read));
    REQUIRE(read.problems.list().size() == 1);
    CHECK(read.problems.list().front().where.line > 19);
    CHECK(read.problems.list().front().what.find(what) != std::string::npos);
  };
  const std::string here = "position = [1, 1, 1]\n";
  told(copy_of("sign", "exit", "copy = \"exit\"\n" + here), "defined twice");
  told(copy_of("luminaire", "lamp", "copy = \"lamp\"\n" + here), "defined twice");
  told(copy_of("sign", "none", "copy = \"new\"\n" + here), "no sign \"none\"");
  told(copy_of("sign", "exit", "copy = \"new\"\n"), "needs 'position'");
  told(copy_of("sign", "exit", "copy = \"a/b\"\n" + here), "without control characters");
  told("[[medium]]\nname = \"haze\"\nkind = \"homogeneous\"\nextinction = 0.2\nalbedo = 0.9\n" +
           copy_of("medium", "haze", "copy = \"fog\"\n" + here),
       "a medium is not copied");
  f.put("glow.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  told(
      "[[emitter]]\nname = \"glow\"\nshape = \"mesh\"\nfile = \"glow.obj\"\nunits = \"m\"\nup = "
      "\"z\"\nflux_lm = 10\n" +
          copy_of("luminaire", "glow", "copy = \"new\"\n" + here),
      "shape mesh is not copied");
}

}  // namespace luxodus
