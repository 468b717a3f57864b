// Buildings of fire simulations as scenes: closed except for openings, each obstruction once.
#include <catch2/catch.hpp>

#include "scenes/formats/fields/fds_building.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {

namespace {

/// Its objects and materials, in the two files of an import, and a clock.
std::string whole_text(const FireBuilding& building, const std::string& at = "60") {
  std::string out = "[time]\nfrom = " + at + "\nto = 100\nstep = 10\n";
  for (const FireMaterial& material : building.tables.materials())
    out += material_table(material) + "\n";
  return out + building.tables.text();
}

}  // namespace

TEST_CASE("the building of a simulation is read as a scene, closed except for its openings",
          "[format][scene][fds]") {
  using namespace test;
  SceneFolder folder;
  // 2 x 1 x 1 m in two meshes; a block of 0.5 m, a plate, a wall that vanishes, a door in the west.
  SmallMesh a = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  const SmallMesh b = even_mesh({1, 0, 0}, {0.25, 0.25, 0.25}, {4, 4, 4});
  a.obstructions = {{1, 2, 0, 1, 0, 1}, {0, 1, 1, 1, 0, 1}, {0, 1, 0, 1, 1, 2}};
  a.openings = {{0, 0, 0.5, 1, 0, 1}};
  folder.put("fire.smv", index_of_meshes({a, b}) + "HIDE_OBST 1\n 3 30.0\n");
  const auto building = read_fire_building(folder.path() / "fire.smv", 60);
  REQUIRE(building.ok());
  CHECK(building->solids == 2);
  CHECK(building->plates == 1);
  CHECK(building->absent.size() == 1);
  CHECK(building->open_sides == std::vector<std::string>{"west"});
  REQUIRE(building->exits.size() == 1);
  CHECK(building->exits[0] == glm::dvec3(0, 0.75, 0));
  const auto scene = good(folder, whole_text(building.value()));
  const auto area = [](const Mesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
      sum += glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                    mesh.positions[t.z] - mesh.positions[t.x])) /
             2;
    return sum;
  };
  double walls = 0, block = 0, plate = 0;
  for (const Object& o : scene.objects) {
    const bool is_wall = o.name.find("wall") != std::string::npos && o.name != "wall" &&
                         o.name.rfind("wall", 0) != 0;
    if (is_wall || o.name.rfind("floor", 0) == 0 || o.name.rfind("ceiling", 0) == 0) {
      walls += area(o.mesh);
      // The front looks into the building.
      const auto& t = o.mesh.triangles.front();
      const glm::dvec3 at = o.mesh.positions[t.x];
      const glm::dvec3 normal = glm::cross(o.mesh.positions[t.y] - at, o.mesh.positions[t.z] - at);
      CHECK(glm::dot(normal, glm::dvec3(1, 0.5, 0.5) - at) > 0);
    } else if (o.mesh.triangles.size() > 2) {
      block += area(o.mesh);
    } else {
      plate += area(o.mesh);
    }
  }
  // 10 m2 of a closed box, minus the door (0.5 m2) and what the block covers (floor and south).
  CHECK(walls == Approx(10 - 0.5 - 2 * 0.25));
  CHECK(block == Approx(6 * 0.25));
  CHECK(plate == Approx(0.25));
  // Before it vanishes the wall is present, and nothing else differs.
  CHECK(read_fire_building(folder.path() / "fire.smv", 0)->absent.empty());
  const auto before = good(folder, whole_text(building.value(), "29"));
  CHECK(before.objects.size() == scene.objects.size() + 1);
  CHECK(good(folder, whole_text(building.value(), "30")).objects.size() == scene.objects.size());
}

TEST_CASE("plates at one place are merged, unless their times differ", "[format][scene][fds]") {
  using namespace test;
  SceneFolder folder;
  SmallMesh mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  const std::array<int, 6> plate{0, 1, 1, 1, 0, 1};
  mesh.obstructions = {plate, plate, plate, plate};
  folder.put("fire.smv", index_of_meshes({mesh}) + "HIDE_OBST 1\n 1 30.0\nHIDE_OBST 1\n 4 30.0\n" +
                             "SHOW_OBST 1\n 2 50.0\nSHOW_OBST 1\n 3 50.0\n");
  const auto building = read_fire_building(folder.path() / "fire.smv", 0);
  REQUIRE(building.ok());
  CHECK(building->plates == 2);
  const auto objects_at = [&](const std::string& at) {
    return good(folder, whole_text(building.value(), at)).objects.size();
  };
  CHECK(objects_at("20") == objects_at("40") + 1);
  CHECK(objects_at("60") == objects_at("40") + 1);
}

TEST_CASE("contradictory changes of a simulation are read by their effect",
          "[format][scene][fds]") {
  using namespace test;
  SceneFolder folder;
  SmallMesh mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  mesh.obstructions = {
      {0, 1, 0, 1, 0, 1}, {1, 2, 0, 1, 0, 1}, {0, 1, 1, 2, 0, 1}, {1, 2, 1, 2, 0, 1}};
  folder.put("fire.smv", index_of_meshes({mesh}) +
                             "SHOW_OBST 1\n 3 30\nHIDE_OBST 1\n 3 30\n"  // never appears
                             "HIDE_OBST 1\n 4 30\nSHOW_OBST 1\n 4 30\n"  // never vanishes
                             "HIDE_OBST 1\n 4 50\n"                      // but at 50 s
                             "HIDE_OBST 1\n 1 1e10\n"                    // never vanishes
                             "SHOW_OBST 1\n 2 1e10\n");                  // never appears
  const auto building = read_fire_building(folder.path() / "fire.smv", 0);
  REQUIRE(building.ok());
  CHECK(building->solids == 4);
  const auto solids_at = [&](const std::string& at) {
    const auto scene = good(folder, whole_text(building.value(), at));
    return std::count_if(scene.objects.begin(), scene.objects.end(),
                         [](const Object& o) { return o.mesh.triangles.size() == 12; });
  };
  CHECK(solids_at("0") == 2);
  CHECK(solids_at("40") == 2);
  CHECK(solids_at("60") == 1);
}

TEST_CASE("names of a simulation are quoted safely in a scene", "[format][scene][fds]") {
  using namespace test;
  SceneFolder folder;
  SmallMesh mesh = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  mesh.obstructions = {{0, 1, 0, 1, 0, 1}, {1, 2, 1, 2, 1, 2}};
  folder.put("fire.smv", replaced(replaced(index_of_meshes({mesh}), "! wall", "! a\"]/\\b\x01 "),
                                  " INERT", " \"IN\nERT"));
  const auto odd = read_fire_building(folder.path() / "fire.smv", 0);
  REQUIRE(odd.ok());
  good(folder, whole_text(odd.value()));
}

TEST_CASE("the building of a real case is a scene", "[format][scene][fds]") {
  const std::filesystem::path index =
      std::filesystem::path(LUX_SHARED_DATA) / "fds_results/corridor/corridor.smv";
  if (!std::filesystem::exists(index)) {
    WARN("skipped: the results of FDS are not there (" << index.string() << ")");
    return;
  }
  const auto at_0 = read_fire_building(index, 0), at_60 = read_fire_building(index, 60);
  REQUIRE(at_0.ok());
  REQUIRE(at_60.ok());
  CHECK(at_0->tables.text() == at_60->tables.text());
  CHECK(at_0->absent.empty());
  CHECK(at_60->absent == std::vector<std::string>{"curtain"});
  CHECK(at_60->open_sides.size() == 2);  // west and east
  SceneFolder folder;
  const auto scene = good(folder, whole_text(at_60.value()));
  // Faces of meshes have the case's default surface.
  const auto material = static_cast<size_t>(named(scene.objects, "ceiling").material);
  CHECK(scene.materials[material].name == "WALL");
  // An obstruction has its own colour where FDS gave it one.
  const auto of_beam = static_cast<size_t>(named(scene.objects, "beam").material);
  CHECK(scene.materials[of_beam].name == "WALL #999999");
  CHECK(named(scene.objects, "table").mesh.triangles.size() == 12);
  CHECK(named(scene.objects, "beam").mesh.triangles.size() == 12);
  // The curtain falls at 40.06 s.
  const auto has_curtain = [&](const std::string& at) {
    const auto then = good(folder, whole_text(at_0.value(), at));
    return std::any_of(then.objects.begin(), then.objects.end(),
                       [](const Object& o) { return o.name == "curtain"; });
  };
  CHECK(has_curtain("40"));
  CHECK_FALSE(has_curtain("41"));
}

}  // namespace luxodus
