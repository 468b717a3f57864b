// Buildings of models: pieces of doors, floors of rooms, openings, and the folder of a scene, which
// a second import updates without changing the user's files. Tests that compute shapes need Node.js
// and the npm package, and warn if these are absent.
#include "actors/import/building.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "actors/import/hand_changes.hpp"
#include "actors/import/ifc_shapes.hpp"
#include "actors/import/import_files.hpp"
#include "actors/import/write_building.hpp"
#include "runtime/core/random.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "tests/kit/small_ifc.hpp"
#include "tests/kit/step_text.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/import/building_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

IfcBuilding building_from(const TemporaryFolder& folder, SmallIfc& small) {
  const std::string text = small.text();
  const fs::path file = folder.write("small.ifc", text);
  return building_of_text(text, file);
}

const std::string lamp =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 -0.2 -0.2 0\n1 1 10\n0 45 90\n0\n"
    "300 200 0\n";

SceneDescription read(const fs::path& file) {
  ReadScene scene = read_scene(file);
  for (const Problem& p : scene.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(scene.scene.has_value());
  return *scene.scene;
}

}  // namespace

TEST_CASE("a mesh is split into its connected pieces", "[import]") {
  Mesh both = block({0, 0, 0}, {1, 1, 1});
  append(both, block({2, 0, 0}, {3, 1, 1}));
  const auto pieces = connected_pieces(both);
  REQUIRE(pieces.size() == 2);
  CHECK(signed_volume_of(pieces[0]) == Approx(1));
  CHECK(bounds_of(pieces[1]).low.x == 2);
}

TEST_CASE("a ray finds the first of many parts, also far from the origin", "[import]") {
  Random random(1, RandomStream::test);
  random.start(1);
  const auto number = [&](double low, double high) {
    return low + (high - low) * random.uniform_double();
  };
  const glm::dvec3 site(500'000, -4'200'000, 350);
  const auto place = [&] { return site + glm::dvec3(number(0, 40), number(0, 30), number(0, 9)); };
  // All in one storey, and each in a storey of its own.
  std::vector<BuildingStorey> all(1), each;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 low = place();
    BuildingPart part;
    part.mesh = block(low, low + glm::dvec3(number(0.1, 3), number(0.1, 3), number(0.1, 3)));
    all[0].parts.push_back(part);
    each.emplace_back().parts.push_back(part);
  }
  const PartRays rays(all);
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 from = place();
    glm::dvec3 way(number(-1, 1), number(-1, 1), number(-1, 1));
    if (i % 4 == 0) way = {0, 0, i % 8 == 0 ? 1 : -1};
    std::optional<double> nearest;
    for (const BuildingStorey& one : each)
      if (const auto d = PartRays({one}).first(from, way); d && (!nearest || *d < *nearest))
        nearest = d;
    CHECK(rays.first(from, way) == nearest);
    met += nearest ? 1 : 0;
  }
  CHECK(met > 50);
  CHECK(met < 200);
  CHECK_FALSE(PartRays({}).first(site, {0, 0, 1}));
}

TEST_CASE("a leaf turns about its edge with its handle, and the frame stays", "[import]") {
  const std::vector<DoorPiece> parts{{block({0.05, 0, 0}, {0.95, 0.05, 2}), "wood"},
                                     {block({0.85, -0.05, 1}, {0.9, 0.1, 1.05}), "steel"},
                                     {block({0, 0, 0}, {0.05, 0.1, 2.05}), "steel"},
                                     {block({0.95, 0, 0}, {1, 0.1, 2.05}), "steel"}};
  const DoorPieces left = door_pieces(parts, Transform{}, "SINGLE_SWING_LEFT");
  REQUIRE(left.leaves.size() == 1);
  CHECK(left.leaves[0].pieces.size() == 2);
  CHECK(left.frame.size() == 2);
  CHECK(left.leaves[0].hinge.point.x == Approx(0.05));
  CHECK(left.leaves[0].hinge.open_angle_deg == 90);
  const DoorPieces right = door_pieces(parts, Transform{}, "SINGLE_SWING_RIGHT");
  CHECK(right.leaves.at(0).hinge.point.x == Approx(0.95));
  CHECK(right.leaves[0].hinge.open_angle_deg == -90);
}

TEST_CASE("leaves of a double door turn about their outer edges", "[import]") {
  const std::vector<DoorPiece> parts{{block({0, 0, 0}, {0.9, 0.05, 2}), "wood"},
                                     {block({0.91, 0, 0}, {1.81, 0.05, 2}), "wood"}};
  const DoorPieces door = door_pieces(parts, Transform{}, "DOUBLE_DOOR_SINGLE_SWING");
  REQUIRE(door.leaves.size() == 2);
  CHECK(door.leaves[0].hinge.point.x == Approx(0));
  CHECK(door.leaves[0].hinge.open_angle_deg == 90);
  CHECK(door.leaves[1].hinge.point.x == Approx(1.81));
  CHECK(door.leaves[1].hinge.open_angle_deg == -90);
}

TEST_CASE("a product far from all others is left out and named", "[import]") {
  SmallIfc small;
  const auto model = ifc_model_of(small.text(), "small.ifc");
  REQUIRE(model.ok());
  IfcShapes shapes;
  const auto add = [&](const std::string& guid, const glm::dvec3& at) {
    ImportedPart part;
    part.name = guid + "#0";
    part.mesh = block(at, at + glm::dvec3(1, 0.2, 3));
    shapes.parts.push_back(part);
  };
  add(small.north_guid, {0, 0, 0});
  add(small.door_guid, {5, 0, 0});
  add(small.lamp_guid, {500'000, 5'000'000, 0});
  const IfcBuilding building = building_of(model.value(), shapes);
  size_t parts = 0;
  for (const BuildingStorey& storey : building.storeys) parts += storey.parts.size();
  CHECK(parts == 2);
  REQUIRE(building.unread.size() > 0);
  const bool named =
      std::any_of(building.unread.begin(), building.unread.end(), [&](const std::string& line) {
        return line.find(small.lamp_guid) != std::string::npos &&
               line.find("5025 km from the others") != std::string::npos;
      });
  CHECK(named);
}

TEST_CASE("an open solid is listed, and its part is marked in the scene", "[import]") {
  const TemporaryFolder folder;
  SmallIfc small;
  const auto model = ifc_model_of(small.text(), "small.ifc");
  REQUIRE(model.ok());
  IfcShapes shapes;
  ImportedPart part;
  part.name = small.north_guid + "#0";
  part.mesh = block({0, 0, 0}, {4, 0.2, 3});
  part.mesh.triangles.resize(10);
  shapes.parts.push_back(part);
  shapes.open[small.north_guid] = 2.5;
  const IfcBuilding building = building_of(model.value(), shapes);
  REQUIRE(building.open_solids.size() == 1);
  CHECK(building.open_solids[0].guid == small.north_guid);
  const auto written = write_building(building, (folder / "house").string(), "");
  REQUIRE(written.ok());
  REQUIRE(written->open_solids.size() == 1);
  CHECK(written->open_solids[0].find("2.5 m2") != std::string::npos);
  const SceneDescription scene = read(folder / "house/scene.toml");
  const bool marked =
      std::any_of(scene.objects.begin(), scene.objects.end(), [](const Object& object) {
        return std::find(object.tags.begin(), object.tags.end(), "open solid") != object.tags.end();
      });
  CHECK(marked);
}

TEST_CASE("luminaires without a shape, lamps and things called lights are offered", "[import]") {
  StepText text;
  const std::string item = text.box({0, 0, -50}, {600, 200, 50});
  const auto place = [&](double x) { return text.local(text.storey_place, {x, 1000, 3000}); };
  const auto shape = [&] { return text.shape(text.representation(text.body, "Body", item)); };
  text.product("IFCLIGHTFIXTURE", "bare", place(1000), "$");
  text.product("IFCLAMP", "lamp", place(2000), shape());
  text.product("IFCBUILDINGELEMENTPROXY", "Lighting Fixture 7", place(3000), shape());
  text.product("IFCBUILDINGELEMENTPROXY", "Skylight", place(4000), shape());
  const std::string whole = text.product("IFCLIGHTFIXTURE", "tubes", place(5000), "$");
  const std::string one = text.product("IFCLAMP", "tube 1", place(5000), shape());
  const std::string two = text.product("IFCLAMP", "tube 2", place(6000), shape());
  text.add("IFCRELAGGREGATES(" + text.guid() + ",$,$,$," + whole + ",(" + one + "," + two + "))");
  const auto model = ifc_model_of(text.text(), "t.ifc");
  REQUIRE(model.ok());
  IfcShapes shapes;
  for (const auto& [id, x] : {std::pair(one, 5.0), std::pair(two, 6.0)}) {
    ImportedPart part;
    part.name = StepText::guid_of(id) + "#" + std::to_string(shapes.parts.size());
    part.mesh = block({x, 1, 2.95}, {x + 0.6, 1.2, 3});
    shapes.parts.push_back(part);
  }
  const IfcBuilding building = building_of(model.value(), shapes);
  std::vector<std::string> names;
  for (const BuildingFixture& fixture : building.fixtures) names.push_back(fixture.name);
  CHECK(names == std::vector<std::string>{"bare", "lamp", "Lighting Fixture 7", "tubes"});
  CHECK(glm::length(building.fixtures[0].position - glm::dvec3(1, 1, 3)) < 1e-9);
  // The assembly is where its lamps are, and they are its body.
  CHECK(building.fixtures[3].position.x == Approx(5.8));
  CHECK(building.fixtures[3].body.size() == 1);
}

TEST_CASE("intensities within a model are the photometry of their type", "[import]") {
  const TemporaryFolder folder;
  StepText text;
  const std::string data =
      text.add("IFCLIGHTDISTRIBUTIONDATA(0.,(0.,30.,60.,90.),(318.31,275.66,159.155,0.))");
  const std::string distribution =
      text.add("IFCLIGHTINTENSITYDISTRIBUTION(.TYPE_C.,(" + data + "))");
  const std::string source =
      text.add("IFCLIGHTSOURCEGONIOMETRIC('g',$,$,$," + text.axes({0, 0, -50}, {0, 0, -1}) +
               ",$,3000.,1500.," + ".LIGHTEMITTINGDIODE.," + distribution + ")");
  const std::string shape = text.shape(text.representation(text.body, "LightSource", source));
  text.product("IFCLIGHTFIXTURE", "own", text.local(text.storey_place, {0, 0, 3000}), shape);
  const auto model = ifc_model_of(text.text(), "t.ifc");
  REQUIRE(model.ok());
  const auto written =
      write_building(building_of(model.value(), IfcShapes{}), (folder / "house").string(), "");
  REQUIRE(written.ok());
  CHECK(written->luminaires == 1);
  CHECK(written->asked.empty());
  const SceneDescription scene = read(folder / "house/scene.toml");
  REQUIRE(scene.emitters.size() == 1);
  // The trapezoidal rule over four angles of Lambert's law.
  CHECK(scene.emitters[0].mains_flux == Approx(1500).epsilon(0.03));
  CHECK(scene.emitters[0].frame.origin.z == Approx(2.95));
}

TEST_CASE("tables of the building that a person has changed or removed stay so", "[import]") {
  const std::string head = "include = []\n\n[[import]]\nname = \"a\"\n";
  const auto area = [](const std::string& name, const std::string& guid, int z) {
    return "\n[[open_area]]\nname = \"" + name + "\"\nz = " + std::to_string(z) +
           "\nifc_guid = \"" + guid + "\"\n";
  };
  const auto exit = [](const std::string& name) {
    return "\n[[emphasis]]\nname = \"" + name + "\"\nifc_guid = \"D\"\n";
  };
  const std::string first = head + area("Hall", "A", 0) + area("Hall", "A", 1) +
                            area("Office", "B", 0) + area("Store", "C", 0) + exit("Exit");
  const std::string by_hand = head + area("Hall", "A", 0) + area("Gallery", "A", 1) +
                              area("Store", "C", 0) + exit("Main exit");
  const std::string second = head + area("Hall", "A", 2) + area("Hall", "A", 3) +
                             area("Office", "B", 2) + area("Store", "C", 2) + area("New", "E", 2) +
                             exit("Exit");
  const HandChanges kept = with_hand_changes(second, by_hand, first);
  CHECK(kept.text.find(area("Hall", "A", 2)) != std::string::npos);
  CHECK(kept.text.find(area("Gallery", "A", 1)) != std::string::npos);
  CHECK(kept.text.find("Office") == std::string::npos);
  CHECK(kept.text.find(area("Store", "C", 2)) != std::string::npos);
  CHECK(kept.text.find(area("New", "E", 2)) != std::string::npos);
  CHECK(kept.text.find("name = \"Main exit\"") != std::string::npos);
  CHECK(kept.notes.size() == 3);
  // In the next import they still differ from the copy, which is that of the model.
  CHECK(with_hand_changes(second, kept.text, second).text == kept.text);
  CHECK(with_hand_changes(second, first, first).text == second);
}

TEST_CASE("changes by hand that an import does not keep are named", "[import]") {
  const std::string table =
      "\n[[import]]\nname = \"a\"\nunits = \"m\"\n[import.materials]\n\"x\" = ";
  const std::string gone = "\n[[open_area]]\nname = \"Hall\"\nifc_guid = \"A\"\nz = ";
  const auto head = [](const char* model) {
    return std::string("# Of ") + model + "\ninclude = []\n";
  };
  const std::string first = head("old.ifc") + table + "\"x\"\n" + gone + "0\n";
  const std::string fresh = head("new.ifc") + table + "\"x\"\n";
  const auto notes = [&](const std::string& now) {
    return with_hand_changes(fresh, now, first).notes;
  };
  CHECK(notes(first).empty());
  const auto setting = notes(head("old.ifc") + table + "\"y\"\n" + gone + "0\n");
  REQUIRE(setting.size() == 1);
  CHECK(setting[0].find("not kept: [[import]] \"a\";") == 0);
  const auto lost = notes(head("old.ifc") + table + "\"x\"\n" + gone + "1\n");
  REQUIRE(lost.size() == 1);
  CHECK(lost[0].find("not kept: [[open_area]] \"Hall\";") == 0);
  const auto added = notes("title = 1\n" + first + "\n[[sign]]\nname = \"own\"\n");
  REQUIRE(added.size() == 2);
  CHECK(added[0].find("not kept: the lines before the first table;") == 0);
  CHECK(added[1].find("not kept: [[sign]] \"own\";") == 0);
}

TEST_CASE("a written binary glTF reads back with its names, materials and places", "[import]") {
  const TemporaryFolder folder;
  const glm::dvec3 origin(1000, 2000, 10);
  BuildingPart a, b;
  a.name = "wall \"A\" 1z_$$VltRjMBbI94YH0013";
  a.material = "Brick, red";
  a.mesh = block({1001, 2001, 10}, {1002, 2004, 13});
  b.name = "door B";
  b.material = "Wood";
  b.mesh = block({1005, 2001, 10}, {1006, 2001.05, 12});
  const auto file = folder.write("x.glb", glb_of({a, b}, origin).value());
  const auto parts = import_mesh(file.string(), 1, UpAxis::y);
  REQUIRE(parts.ok());
  REQUIRE(parts->size() == 2);
  CHECK(parts->at(0).name == a.name);
  CHECK(parts->at(0).material_name == a.material);
  CHECK(parts->at(1).material_name == b.material);
  const Bounds back = bounds_of(parts->at(0).mesh), there = bounds_of(a.mesh);
  CHECK(glm::length(back.low + origin - there.low) < 1e-6);
  CHECK(glm::length(back.high + origin - there.high) < 1e-6);
  CHECK(signed_volume_of(parts->at(0).mesh) == Approx(9));
}

TEST_CASE("names and texts of models are made valid in a scene file", "[import]") {
  CHECK(as_name("a/b\"c\n", "x") == "a-b-c-");
  CHECK(as_name("..hidden ", "x") == "hidden");
  CHECK(as_name("", "x") == "x");
  CHECK(toml_text("a\"b\\c\n\xff") == "\"a\\\"b\\\\c\\u000a?\"");
}

TEST_CASE("types with one name in two families stay two", "[import]") {
  const auto type_of = [](const std::string& name) {
    SmallIfc small;
    small.lamp_name = name;
    const auto model = ifc_model_of(small.text(), "small.ifc");
    REQUIRE(model.ok());
    const IfcBuilding building = building_of(model.value(), IfcShapes{});
    REQUIRE(building.fixtures.size() == 2);
    return building.fixtures[0].type;
  };
  CHECK(type_of("Lamp 1") == "Lamp");
  CHECK(type_of("Sconce:Lamp:575376") == "Sconce:Lamp");
  CHECK(type_of("Pendant:Lamp:575377") == "Pendant:Lamp");
}

TEST_CASE("a type whose file cannot be used is left to the user, with the reason", "[import]") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "lights");
  std::ofstream(folder / "lights/lamp.ies") << "TILT=NONE\nno numbers\n";
  SmallIfc small;
  const auto model = ifc_model_of(small.text(), "small.ifc");
  REQUIRE(model.ok());
  const IfcBuilding building = building_of(model.value(), IfcShapes{});
  const auto written =
      write_building(building, (folder / "house").string(), (folder / "lights").string());
  REQUIRE(written.ok());
  CHECK(written->luminaires == 0);
  REQUIRE(written->asked.size() == 2);
  CHECK(written->asked[0].find("lamp.ies:") != std::string::npos);
}

TEST_CASE("a sign and a luminaire may have types of the same name", "[import]") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "lights");
  std::ofstream(folder / "lights/lamp.ies") << lamp;
  SmallIfc small;
  const auto model = ifc_model_of(small.text(), "small.ifc");
  REQUIRE(model.ok());
  IfcBuilding building = building_of(model.value(), IfcShapes{});
  REQUIRE(building.fixtures.size() == 2);
  REQUIRE(building.fixtures[1].is_sign);
  building.fixtures[1].type = building.fixtures[0].type;
  const std::string out = (folder / "house").string();
  const auto written = write_building(building, out, (folder / "lights").string());
  REQUIRE(written.ok());
  CHECK(written->luminaires == 1);
  CHECK(written->signs == 0);  // its type must be completed
  CHECK(written->asked.size() == 1);
  const std::string fixtures = text_of(folder / "house/fixtures.toml");
  CHECK(fixtures.find("\n[[luminaire_type]]\nname = \"Lamp\"\n") != std::string::npos);
  CHECK(fixtures.find("\n# [[sign_type]]\n# name = \"Lamp\"\n") != std::string::npos);
  // A second import finds both, and adds neither.
  const auto again = write_building(building, out, (folder / "lights").string());
  REQUIRE(again.ok());
  CHECK(text_of(folder / "house/fixtures.toml") == fixtures);
}

TEST_CASE("control characters of a model do not reach the terminal", "[import]") {
  const TemporaryFolder folder;
  SmallIfc small;
  const auto model = ifc_model_of(small.text(), "small.ifc");
  REQUIRE(model.ok());
  IfcBuilding building = building_of(model.value(), IfcShapes{});
  building.unread.push_back("#7 has the GlobalId \x1b[2Jabc");
  building.differences.push_back({"\x1b]0;", "wall\x07", 7, 1, 2});
  building.schema = "IFC4\x1b[31m";
  REQUIRE(write_building(building, (folder / "house").string(), "").ok());
  const std::string report = text_of(folder / "house/import.txt");
  CHECK(report.find('\x1b') == std::string::npos);
  CHECK(report.find('\x07') == std::string::npos);
  CHECK(report.find("#7 has the GlobalId \\x1B[2Jabc") != std::string::npos);
}

TEST_CASE("faults that are not listed are counted", "[import]") {
  SmallIfc small;
  std::string text = small.text();
  std::string broken;
  for (int i = 0; i < 130; ++i) broken += "#x" + std::to_string(i) + "=IFCX(1);\n";
  text.insert(text.find("DATA;\n") + 6, broken);
  const auto model = ifc_model_of(text, "small.ifc");
  REQUIRE(model.ok());
  CHECK(model->more_faults == 130 - model->faults.size());
  CHECK(model->faults.size() == limits::step_faults);
  const IfcBuilding building = building_of(model.value(), IfcShapes{});
  CHECK(std::count(building.unread.begin(), building.unread.end(),
                   "30 more faults of the model, which are not listed") == 1);
}

TEST_CASE("photometric files are found by the letters of their names", "[import]") {
  const TemporaryFolder folder;
  folder.write("LED-Panel_600.ldt", "");
  folder.write("notes.txt", "");
  const auto files = photometry_by_name(folder.path().string());
  REQUIRE(files.ok());
  CHECK(files->size() == 1);
  CHECK(files->contains(letters_and_digits("led panel 600")));
  CHECK_FALSE(photometry_by_name((folder / "absent").string()).ok());
}

TEST_CASE("without the script or any time there are no shapes, and the reason is reported",
          "[import]") {
  const TemporaryFolder folder;
  SmallIfc small;
  const auto model = folder.write("small.ifc", small.text());
  const auto absent = ifc_shapes(model, folder / "absent.mjs", 10);
  REQUIRE_FALSE(absent.ok());
  CHECK(absent.problem().what.find("installed whole") != std::string::npos);
  if (!can_compute()) return;
  // A script in its own folder has no package beside it.
  fs::copy_file(script, folder / "ifc_shapes.mjs");
  const auto alone = ifc_shapes(model, folder / "ifc_shapes.mjs", 60);
  REQUIRE_FALSE(alone.ok());
  CHECK(alone.problem().what.find("npm package @ifc-lite/wasm") != std::string::npos);
  const auto endless = folder.write("endless.mjs", "for (;;) {}\n");
  const auto late = ifc_shapes(model, endless, 0.5);
  REQUIRE_FALSE(late.ok());
  CHECK(late.problem().what.find("longer than 0.5 s") != std::string::npos);
  const auto broken = ifc_shapes(model, folder.write("bad.mjs", "throw new Error('no');\n"), 60);
  REQUIRE_FALSE(broken.ok());
  CHECK(broken.problem().what.find("Error: no") != std::string::npos);
}

TEST_CASE("a model's parts are placed correctly, in millimetres, in feet and far away",
          "[import]") {
  if (!can_compute()) return;
  for (const bool far : {false, true}) {
    SmallIfc small;
    small.feet = far;
    if (far) small.site = {500'000, -4'200'000, 350};
    small.wall_volume_m3 = 5.4 * 0.2 * 3;
    const TemporaryFolder folder;
    const IfcBuilding building = building_from(folder, small);
    INFO("far " << far);
    const Bounds north = bounds_of(part_with(building, small.north_guid).mesh);
    CHECK(glm::length(north.low - small.site - glm::dvec3(-0.2, 4, 1)) < 1e-3);
    CHECK(glm::length(north.high - small.site - glm::dvec3(5.2, 4.2, 4)) < 1e-3);
    CHECK(building.volumes_compared == 1);
    CHECK(building.differences.empty());
    const BuildingPart& door = part_with(building, small.door_guid);
    REQUIRE(door.hinge);
    CHECK(glm::length(door.hinge->point - small.site - glm::dvec3(5.1, 1.5, 1)) < 1e-3);
    // It opens to the west, along the y axis of its placement.
    CHECK(door.hinge->open_angle_deg == 90);
    REQUIRE(building.rooms.size() == 1);
    CHECK(building.rooms[0].open_share == 0);
    CHECK(building.rooms[0].name == "1 Hall");
    REQUIRE(building.exits.size() == 1);
    CHECK(building.exits[0].position.x - small.site.x < 5);
    REQUIRE(building.fixtures.size() == 2);
    const BuildingFixture& sign = building.fixtures[1];
    CHECK(sign.is_sign);
    CHECK(sign.direction.x == Approx(-1));  // away from the wall behind it
    CHECK(sign.width_m == Approx(0.3).epsilon(1e-3));
    CHECK_FALSE(sign.double_sided);
  }
}

TEST_CASE("the shape of a type is not added to those of its products", "[import]") {
  if (!can_compute()) return;
  const TemporaryFolder folder;
  std::string text = SmallIfc{}.text();
  const auto id_of = [&](const std::string& kind) {
    const size_t end = text.rfind("=" + kind + "(");
    REQUIRE(end != std::string::npos);
    const size_t begin = text.rfind('#', end);
    return text.substr(begin, end - begin);
  };
  const auto names_in = [&](const std::string& model) {
    const auto shapes = ifc_shapes(folder.write("small.ifc", model), script, 120);
    if (!shapes) FAIL(shapes.problem().text());
    std::vector<std::string> names;
    for (const ImportedPart& part : shapes->parts) names.push_back(part.name);
    return names;
  };
  const std::vector<std::string> before = names_in(text);
  CHECK(before.size() > 5);
  const std::string type = "1_VlNhLA52XG8421000911";
  const std::string typed = "#9000=IFCREPRESENTATIONMAP(" + id_of("IFCAXIS2PLACEMENT3D") + "," +
                            id_of("IFCSHAPEREPRESENTATION") + ");\n#9001=IFCFURNITURETYPE('" +
                            type + "',$,'Table',$,$,$,(#9000),$,$,.NOTDEFINED.,$);\n" +
                            "#9002=IFCRELDEFINESBYTYPE('1_VlNhLA52XG8421000918',$,$,$,(" +
                            id_of("IFCFURNITURE") + "),#9001);\n";
  const size_t end = text.rfind("ENDSEC;");
  CHECK(names_in(text.substr(0, end) + typed + text.substr(end)) == before);
}

TEST_CASE("a wrong volume and a missing ceiling are reported", "[import]") {
  if (!can_compute()) return;
  SmallIfc small;
  small.wall_volume_m3 = 3;
  small.with_ceiling = false;
  const TemporaryFolder folder;
  const IfcBuilding building = building_from(folder, small);
  REQUIRE(building.differences.size() == 1);
  CHECK(building.differences[0].guid == small.north_guid);
  CHECK(building.differences[0].mesh_m3 == Approx(5.4 * 0.2 * 3).epsilon(1e-4));
  REQUIRE(building.rooms.size() == 1);
  CHECK(building.rooms[0].open_share > 0.2);
  CHECK(building.rooms[0].open_towards == "up");
}

TEST_CASE("a second import updates the building and leaves the user's files unchanged",
          "[import]") {
  if (!can_compute()) return;
  const TemporaryFolder folder;
  SmallIfc small;
  const fs::path out = folder / "house", lights = folder / "lights";
  fs::create_directories(lights);
  std::ofstream(lights / "lamp.ies") << lamp;
  IfcBuilding building = building_from(folder, small);
  const auto first = write_building(building, out.string(), lights.string());
  REQUIRE(first.ok());
  CHECK(first->luminaires == 1);
  CHECK(first->signs == 0);
  CHECK(first->asked.size() == 1);
  CHECK_FALSE(first->kept_scene);
  const SceneDescription scene = read(out / "scene.toml");
  REQUIRE(scene.emitters.size() == 1);
  CHECK(scene.emitters[0].ifc_guid == small.lamp_guid);
  CHECK(scene.open_areas.at(0).ifc_guid == small.space_guid);
  // Bodies of fixtures whose light comes from a file would block it.
  for (const Object& object : scene.objects)
    CHECK(object.name.find(small.lamp_guid) == std::string::npos);

  // The doors that the new scene lists as a comment are those of the building.
  const std::string leaf = "Ground \xc3\xa4.door Exit " + small.door_guid;
  const std::string fresh = text_of(out / "scene.toml");
  CHECK(fresh.find(leaf) != std::string::npos);
  const std::string edited =
      fresh + "\n[[scenario]]\nname = \"open\"\ndoors_open = [\"" + leaf + "\"]\n";
  std::ofstream(out / "scene.toml") << edited;
  std::string materials = text_of(out / "materials.toml");
  materials.replace(materials.find("reflectance = "), 18, "reflectance = 0.33");
  std::ofstream(out / "materials.toml") << materials;
  std::ofstream(out / "fixtures.toml", std::ios::app)
      << "\n[[sign_type]]\nname = \"Exit sign\"\nplain = \"green\"\nsmallest_detail = 0.02\n"
         "mains_white = 500\nmains_green = 100\nemergency_white = 50\nemergency_green = 10\n";
  small.floor_m = 2;
  building = building_from(folder, small);
  const auto second = write_building(building, out.string(), "");
  REQUIRE(second.ok());
  CHECK(second->kept_scene);
  CHECK(second->signs == 1);
  CHECK(second->luminaires == 1);
  CHECK(second->asked.empty());
  CHECK(text_of(out / "scene.toml") == edited);
  CHECK(text_of(out / "materials.toml") == materials);
  const SceneDescription again = read(out / "scene.toml");
  CHECK(again.open_areas.at(0).z_m == Approx(2));
  REQUIRE(again.signs.size() == 1);
  CHECK(again.signs[0].ifc_guid == small.sign_guid);
}
