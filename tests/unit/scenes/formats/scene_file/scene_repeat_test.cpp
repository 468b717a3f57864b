// Rows of copies.
#include <catch2/catch.hpp>

#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

const std::string repeated_lamp = R"(
[[emitter]]
name = "lamp"
shape = "point"
position = [0, 0, 5]
flux_lm = 100
)";

std::string box(const std::string& more) {
  return "[[object]]\nname = \"box\"\nshape = \"box\"\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\n"
         "material = \"grey50\"\n" +
         more;
}

/// The one problem of a scene.
std::string only_problem(const std::string& text) {
  SceneFolder folder;
  const ReadScene read = folder.read(text);
  INFO(all_problems(read));
  REQUIRE(read.problems.list().size() == 1);
  CHECK(read.problems.list().front().where.line > 0);
  return read.problems.list().front().text();
}

}  // namespace

TEST_CASE("rows of copies multiply, and each copy is offset by its steps", "[format][scene]") {
  SceneFolder folder;
  const SceneDescription scene =
      good(folder,
           box("repeat = [{ count = 3, step = [2, 0, 0] }, { count = 4, step = [0, 0, 10] }]\n") +
               repeated_lamp);
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].mesh.triangles.size() == 12 * 12);
  Bounds bounds;
  for (const glm::dvec3& p : scene.objects[0].mesh.positions) bounds.extend(p);
  CHECK(bounds.low == glm::dvec3(0));
  CHECK(bounds.high == glm::dvec3(5, 1, 31));
}

TEST_CASE("copies of a luminaire are emitters of their own, with numbered names",
          "[format][scene]") {
  SceneFolder folder;
  const SceneDescription scene =
      good(folder, box("") + repeated_lamp + "repeat = [{ count = 3, step = [0, 2, 0] }]\n");
  REQUIRE(scene.emitters.size() == 3);
  CHECK(scene.emitters[0].name == "lamp");
  CHECK(scene.emitters[2].name == "lamp.3");
  CHECK(scene.emitters[2].frame.origin == glm::dvec3(0, 4, 5));
  CHECK(scene.emitters[2].mains_flux == scene.emitters[0].mains_flux);
}

TEST_CASE("impossible repeats are reported with their line", "[format][scene]") {
  CHECK(only_problem(box("repeat = [{ count = 0, step = [1, 0, 0] }]\n") + repeated_lamp)
            .find("count") != std::string::npos);
  CHECK(only_problem(box("repeat = [{ count = 1000, step = [1, 0, 0] }, { count = 1000, step = "
                         "[0, 1, 0] }]\n") +
                     repeated_lamp)
            .find("100000 copies") != std::string::npos);
  CHECK(only_problem(
            "[[object]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 1\nmesh_tolerance_m = "
            "0.0001\nmaterial = \"grey50\"\nrepeat = [{ count = 100000, step = [3, 0, 0] "
            "}]\n" +
            repeated_lamp)
            .find("more than a scene may have") != std::string::npos);
  CHECK(only_problem(box("door = { hinge = [0, 0, 0] }\nrepeat = [{ count = 2, step = [3, 0, 0] "
                         "}]\n") +
                     repeated_lamp)
            .find("hinge") != std::string::npos);
  CHECK(only_problem(box("one_patch = true\npatch_edge_m = 1\n") + repeated_lamp).find("exclude") !=
        std::string::npos);
}

}  // namespace luxodus
