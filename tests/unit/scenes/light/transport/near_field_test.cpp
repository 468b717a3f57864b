// Places in the near field of photometric files: which are reported, and with what distances.
#include "scenes/light/transport/near_field.hpp"

#include <catch2/catch.hpp>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

using namespace luxodus;

namespace {

/// lamp.ies has a round opening of 0.2 m and shines down: five openings are 1 m.
const std::string near_room = R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [10, 10, 3]
material = "grey50"
[[luminaire]]
name = "low lamp"
file = "lamp.ies"
position = [5, 5, 0.9]
circuit = "a"
emergency = "maintained"
emergency_factor = 1
maintenance_factor = 0.8
end_of_duration_factor = 0.7
[[luminaire]]
name = "high lamp"
file = "lamp.ies"
position = [8, 8, 2.9]
)";

std::vector<NearPlace> near_in(const std::string& text, const SeesPlace& sees = {}) {
  SceneFolder folder;
  const SceneDescription scene = good(folder, near_room + text);
  return near_field_places(scene, find_scenario(scene, "").value(), sees);
}

}  // namespace

TEST_CASE("a plane nearer than five luminous openings is reported with luminaire and distance",
          "[transport][near_field]") {
  const std::string plane =
      "[[plane]]\nname = \"floor\"\ncorner = [0, 0, 0]\nedge_u = [10, 0, 0]\n"
      "edge_v = [0, 10, 0]\ncells = [4, 4]\n";
  const auto near = near_in(plane);
  REQUIRE(near.size() == 1);
  CHECK(near[0].problem.what.find("plane \"floor\" is 0.9 m from luminaire \"low lamp\"") == 0);
  CHECK(near[0].problem.what.find("(1 m)") != std::string::npos);
  CHECK(near[0].problem.where.line > 0);
  CHECK_FALSE(near[0].judged);
  CHECK(near_in(plane, [](const Emitter&, const glm::dvec3&) { return false; }).empty());
}

TEST_CASE(
    "probes, routes and signs are reported, but not far or dark luminaires or those behind them",
    "[transport][near_field]") {
  CHECK(near_in("[[probe]]\nname = \"p\"\nposition = [5, 5.2, 0.2]\n").size() == 1);
  CHECK(near_in("[[probe]]\nname = \"far\"\nposition = [8, 8, 1.8]\n").empty());
  CHECK(near_in("[[probe]]\nname = \"behind\"\nposition = [5, 5, 1.2]\n").empty());
  const std::string way =
      "[[route]]\nname = \"r\"\npath = [[0.5, 5.4, 0], [9.5, 5.4, 0]]\nwidth = 1\n";
  REQUIRE(near_in(way).size() == 1);
  CHECK_FALSE(near_in(way)[0].judged);
  const auto emergency = near_in(way + "[[scenario]]\nname = \"e\"\noperation = \"emergency\"\n");
  REQUIRE(emergency.size() == 1);
  CHECK(emergency[0].judged);
  // A sign lit from outside is judged from where people walk, even without an observer.
  const std::string sign =
      "[[sign]]\nname = \"outer\"\nposition = [5, 5.3, 0.4]\nfacing = [0, -1, 0]\nwidth = 0.3\n"
      "height = 0.15\nplain = \"green\"\nsmallest_detail = 0.01\nlighting = \"external\"\n";
  CHECK(near_in(sign).empty());
  const auto lit = near_in(way + sign + "[[scenario]]\nname = \"e\"\noperation = \"emergency\"\n");
  REQUIRE(lit.size() == 2);
  CHECK(lit[1].problem.what.starts_with("sign \"outer\" is "));
  CHECK(lit[1].judged);
  CHECK(near_in("[[probe]]\nname = \"p\"\nposition = [5, 5.2, 0.2]\n[[scenario]]\n"
                "name = \"off\"\ncircuits = { a = 0 }\n")
            .empty());
}

TEST_CASE("a plane at a luminaire's own height is not told to be near it",
          "[transport][near_field]") {
  const auto plane_at = [](const std::string& z) {
    return "[[plane]]\nname = \"ceiling\"\ncorner = [6, 6, " + z +
           "]\nedge_u = [4, 0, 0]\nedge_v = [0, 4, 0]\ncells = [4, 4]\n";
  };
  CHECK(near_in(plane_at("2.9")).empty());
  CHECK(near_in(plane_at("2.95")).empty());
  CHECK(near_in(plane_at("2.85")).size() == 1);
}

TEST_CASE("a luminaire knows its file, its product and its opening", "[format][scene]") {
  SceneFolder folder;
  const SceneDescription scene = good(folder, near_room);
  CHECK(scene.emitters[0].file == "lamp.ies");
  CHECK(scene.emitters[0].opening_m.x == Approx(0.2));
}
