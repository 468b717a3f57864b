// People and lines of sight outside the meshes of a fire simulation.
#include "tests/kit/small_fire.hpp"
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

/// A simulation of uniform smoke whose mesh is a box, as the files of a scene.
std::vector<std::pair<std::string, std::string>> fire_of(const glm::dvec3& low,
                                                         const glm::ivec3& cells) {
  using namespace test;
  const SmallMesh mesh = even_mesh(low, {0.5, 0.5, 0.5}, cells);
  const auto even = cell_values(mesh, [](int, int, int) { return 0.3F; });
  return {{"a.sf", slice_file(mesh, "SOOT EXTINCTION COEFFICIENT", {{60, even}})},
          {"fire.smv", index_of_meshes({mesh}) +
                           slice_entry(1, true, mesh, "a.sf", "SOOT EXTINCTION COEFFICIENT")}};
}

const std::string burning =
    furnished_room + long_way +
    "[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = \"fire.smv\"\nat_s = 60\nalbedo = 0.2\n"
    "g = 0.6\nangstrom = 1\n";

}  // namespace

TEST_CASE("a simulation of the whole room leaves nobody outside", "[inspect][fds]") {
  const auto found = found_in(burning, fire_of({0, -2, 0}, {24, 8, 6}));
  CHECK(that_say(found, "outside of the meshes").empty());
  CHECK_FALSE(has_error(found));
  CHECK(that_say(found, "FLAME GLARE IS MISSING").size() == 1);
  CHECK(that_say(found, "the state at 60 s").size() == 1);
}

TEST_CASE("a route that leaves the meshes of a simulation is an error", "[inspect][fds]") {
  const auto found = found_in(burning, fire_of({0, -2, 0}, {16, 8, 6}));
  check_found(found, Severity::error, "an eye of the route \"way\"");
  CHECK(has_error(found));
}

TEST_CASE("a sign seen through air outside the simulation is an error", "[inspect][fds]") {
  // The route ends at x = 8, the mesh at x = 9, the sign hangs at x = 11.95.
  const std::string scene = test::replaced(burning, "[11, 0, 0]", "[8, 0, 0]");
  const auto found = found_in(scene, fire_of({0, -2, 0}, {18, 8, 6}));
  CHECK(that_say(found, "an eye of the route").empty());
  CHECK(that_say(found, "the line of sight to").size() == 1);
  CHECK(has_error(found));
  // Nobody looks through a wall.
  const std::string walled = scene + test::replaced(thick_wall,
                                                    "opening = [{ at = 1, width = 2, "
                                                    "height = 2.1 }]\n",
                                                    "");
  const auto behind =
      found_in(test::replaced(walled, "[8, 0, 0]", "[7, 0, 0]"), fire_of({0, -2, 0}, {16, 8, 6}));
  CHECK(that_say(behind, "the line of sight to").empty());
}

TEST_CASE("smoke that is in no scenario needs no meshes", "[inspect][fds]") {
  const std::string clear =
      burning + "[[scenario]]\nname = \"clear\"\noperation = \"mains\"\nmedia = { fire = 0 }\n";
  CHECK(that_say(found_in(clear, fire_of({0, -2, 0}, {4, 8, 6})), "outside of the meshes").empty());
}
