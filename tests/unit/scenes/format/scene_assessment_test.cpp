// Routes, areas, people and variants: read field by field, mistakes with their lines.
#include <catch2/catch.hpp>

#include "scenes/geometry/polygon.hpp"
#include "tests/unit/scenes/format/scene_fixture.hpp"

namespace luxodus {

TEST_CASE("routes, areas, points of emphasis and people are read", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, R"(
[assessment]
age_years = 70
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
  CHECK(s.assessment.eye_heights_m == std::vector<double>{1.5});
  CHECK(s.assessment.irritant_smoke);
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

TEST_CASE("what is not said of people has its default", "[format][scene]") {
  SceneFolder f;
  const auto s = good(f, "title = \"nothing\"\n");
  CHECK(s.assessment.age_years == 65);
  CHECK(s.assessment.eye_heights_m == std::vector<double>{1.65, 1.2, 0.6});
}

TEST_CASE("mistakes in routes and areas are told with their lines", "[format][scene]") {
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
  CHECK(told("[assessment]\nage_years = 90\n").find("age_years") != std::string::npos);
  CHECK(told("[assessment]\neye_heights_m = []\n").find("names no height") != std::string::npos);
  CHECK(told("[[emphasis]]\nname = \"a\"\nkind = \"sofa\"\nposition = [0, 0, 0]\n").find("kind") !=
        std::string::npos);
}

TEST_CASE("a change wants something that is there", "[format][scene]") {
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

}  // namespace luxodus
