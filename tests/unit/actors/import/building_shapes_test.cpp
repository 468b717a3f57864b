// Floors of rooms, and shapes of models whose solids the library of shapes loses or does not know.
// Tests that compute shapes need Node.js and the npm package, and warn if these are absent.
#include <catch2/catch.hpp>

#include "scenes/light/geometry/closed_mesh.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"
#include "tests/kit/step_text.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/import/building_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

TEST_CASE("a body has the outlines of its level floors", "[import]") {
  const auto floors = floor_outlines(block({1, 2, 0.5}, {4, 3, 3}));
  REQUIRE(floors.size() == 1);
  CHECK(floors[0].z_m == Approx(0.5));
  REQUIRE(floors[0].outline.size() == 4);
  Bounds bounds;
  for (const glm::dvec2& p : floors[0].outline) bounds.extend(glm::dvec3(p, 0));
  CHECK((bounds.low.x == Approx(1) && bounds.high.x == Approx(4)));
  CHECK((bounds.low.y == Approx(2) && bounds.high.y == Approx(3)));
  CHECK(floor_outlines(Mesh{}).empty());
  // A step of 150 mm makes two; one turned inside out has the same.
  Mesh step = block({0, 0, 0}, {2, 4, 3});
  append(step, block({2, 0, 0.15}, {5, 4, 3}));
  for (const bool flipped : {false, true}) {
    if (flipped) flip(step);
    const auto both = floor_outlines(step);
    REQUIRE(both.size() == 2);
    CHECK(signed_area(both[0].outline) == Approx(8));
    CHECK(both[1].z_m == Approx(0.15));
    CHECK(signed_area(both[1].outline) == Approx(12));
  }
}

TEST_CASE("a room is set on the floor that most rays find, whatever stands on it", "[import]") {
  const auto room_over = [](const std::vector<BuildingPart>& parts) {
    BuildingStorey storey;
    storey.parts = parts;
    BuildingRoom room;
    room.outline = {{0, 0}, {5, 0}, {5, 4}, {0, 4}};
    room.height_m = 3;
    const std::vector<BuildingStorey> storeys{storey};
    set_on_floor(PartRays(storeys, PartRays::Hit::no_furniture), room);
    return room;
  };
  const auto part = [](const glm::dvec3& low, const glm::dvec3& high, bool furniture = false) {
    BuildingPart out;
    out.mesh = block(low, high);
    out.furniture = furniture;
    return out;
  };
  const BuildingPart slab = part({-1, -1, -0.2}, {6, 5, 0});
  const BuildingPart screed = part({0, 0, 0}, {5, 4, 0.05});
  const BuildingPart table = part({0, 0, 0.05}, {5, 4, 0.75}, true);
  const BuildingRoom finished = room_over({slab, screed, table});
  CHECK(finished.z_m == Approx(0.05));
  CHECK(finished.height_m == Approx(2.95));
  CHECK(finished.floor_share == 1);
  CHECK(finished.level_share == 1);
  const BuildingRoom half = room_over({slab, part({0, 0, 0}, {1.4, 4, 0.05})});
  CHECK(half.z_m == Approx(0));
  CHECK(half.level_share == Approx(0.72).margin(0.05));
  const BuildingRoom lower = room_over({part({-1, -1, -0.4}, {6, 5, -0.2})});
  CHECK(lower.z_m == Approx(-0.2));
  // Parts of one floor a hair apart, on both sides of the middle of a centimetre.
  const BuildingRoom uneven =
      room_over({part({-1, -1, -0.2}, {2, 5, 0.0049}), part({2, -1, -0.2}, {6, 5, 0.0051})});
  CHECK(uneven.level_share == 1);
  CHECK(uneven.z_m == Approx(0.0051));
  CHECK(room_over({part({0, 0, 3}, {5, 4, 3.2})}).floor_share == 0);
}

TEST_CASE("walls that half spaces cut along an edge come closed, with their windows", "[import]") {
  if (!can_compute()) return;
  const TemporaryFolder folder;
  StepText text;
  const auto sloped = [&] {
    return text.without(text.box({0, 0, 0}, {4000, 200, 3000}),
                        text.above({0, 0, 3000}, {3, 0, 4}));
  };
  const std::string plain = text.wall(sloped());
  const std::string with_window = text.wall(sloped(), {0, 2000, 0});
  const std::string hole = text.product(
      "IFCOPENINGELEMENT", "O", text.local(text.storey_place, {500, 1900, 900}),
      text.shape(text.representation(text.body, "Body", text.box({0, 0, 0}, {1000, 400, 1000}))),
      ",.OPENING.");
  text.add("IFCRELVOIDSELEMENT(" + text.guid() + ",$,$,$," + with_window + "," + hole + ")");
  const std::string mitred = text.wall(
      text.without(text.box({0, 0, 0}, {4000, 200, 3000}), text.above({4000, 0, 0}, {1, 1, 0})),
      {0, 4000, 0});
  const std::string crossing =
      text.add("IFCBOOLEANRESULT(.INTERSECTION.," + text.box({0, 0, 0}, {4000, 200, 3000}) + "," +
               text.above({0, 0, 3000}, {3, 0, 4}) + ")");
  const std::string lost = text.wall(crossing, {0, 6000, 0});
  const IfcBuilding building = building_of_text(text.text(), folder / "t.ifc");
  CHECK(building.open_solids.empty());
  const auto volume = [&](const std::string& id) {
    const BuildingPart& part = part_with(building, StepText::guid_of(id));
    CHECK(open_edges(part.mesh).closed());
    return signed_volume_of(part.mesh);
  };
  CHECK(volume(plain) == Approx(1.2).epsilon(1e-4));
  CHECK(volume(with_window) == Approx(1.2 - 0.2).epsilon(1e-4));
  CHECK(volume(mitred) == Approx((4 * 0.2 - 0.02) * 3).epsilon(1e-4));
  CHECK(volume(lost) == Approx(1.2).epsilon(1e-4));
}

TEST_CASE("a wall that is cut in parts has all of them, and one cut away entirely none",
          "[import]") {
  if (!can_compute()) return;
  const TemporaryFolder folder;
  StepText text;
  // The bounded half space takes the upper triangle of the left half alone.
  const auto lower_left = [&] {
    const std::string plane = text.add("IFCPLANE(" + text.axes({0, 0, 3000}, {-1, 0, 1}) + ")");
    const std::string outline = text.polyline({{-10, -10}, {2000, -10}, {2000, 210}, {-10, 210}});
    return text.add("IFCPOLYGONALBOUNDEDHALFSPACE(" + plane + ",.T.," + text.axes({0, 0, 0}) + "," +
                    outline + ")");
  };
  const std::string tall = text.box({0, 0, 0}, {4000, 200, 5000});
  const std::string stepped = text.wall(text.without(tall, lower_left()));
  const std::string gone = text.wall(
      text.without(text.box({0, 0, 0}, {4000, 200, 3000}), text.above({0, 0, 3000}, {1, 0, 0})),
      {0, 3000, 0});
  const IfcBuilding building = building_of_text(text.text(), folder / "t.ifc");
  CHECK(building.open_solids.empty());
  // Of the left half, 2 m long, the part above a line from 3 m to 5 m remains.
  CHECK(std::abs(signed_volume_of(part_with(building, StepText::guid_of(stepped)).mesh)) ==
        Approx(0.2 * (4 * 5 - 2 * 4)).epsilon(1e-3));
  REQUIRE(building.storeys.size() == 1);
  CHECK(building.storeys[0].parts.size() == 1);
  REQUIRE(building.unread.size() == 1);
  CHECK(building.unread[0].find(StepText::guid_of(gone)) != std::string::npos);
  CHECK(building.unread[0].find("cut away entirely") != std::string::npos);
}

TEST_CASE("walls far from the origin in their points keep their thickness", "[import]") {
  if (!can_compute()) return;
  const TemporaryFolder folder;
  StepText text;
  const std::string wall =
      text.wall(text.extruded(text.rectangle({500'000'250, 5'000'000'500}, {4000, 200}), 3000));
  const std::string sheet =
      text.wall(text.extruded(text.rectangle({500'000'250, 5'000'001'500}, {4000, 1}), 3000));
  const IfcBuilding building = building_of_text(text.text(), folder / "t.ifc");
  const Bounds a = bounds_of(part_with(building, StepText::guid_of(wall)).mesh);
  CHECK(glm::length(a.low - glm::dvec3(500'000.25, 5'000'000.5, 0)) < 1e-3);
  CHECK(a.high.y - a.low.y == Approx(0.2).epsilon(1e-3));
  const Bounds b = bounds_of(part_with(building, StepText::guid_of(sheet)).mesh);
  CHECK(b.high.y - b.low.y == Approx(0.001).epsilon(0.05));
}

TEST_CASE("solids that the library does not know have their volume", "[import]") {
  if (!can_compute()) return;
  const TemporaryFolder folder;
  StepText text;
  const auto at = [&] { return text.axes({0, 0, 0}); };
  const std::string flat = text.add("IFCAXIS2PLACEMENT2D(" + text.point(glm::dvec2(0, 0)) + ",$)");
  const auto profile = [&](const std::string& words) {
    return text.wall(text.extruded(text.add(words), 1000));
  };
  const auto csg = [&](const std::string& words) {
    return text.wall(text.add("IFCCSGSOLID(" + text.add(words) + ")"));
  };
  const std::string block = text.add("IFCBLOCK(" + at() + ",1000.,1000.,1000.)");
  const std::string drill =
      text.add("IFCRIGHTCIRCULARCYLINDER(" + text.axes({500, 500, -500}) + ",3000.,200.)");
  const std::vector<std::pair<std::string, double>> solids{
      {profile("IFCTRAPEZIUMPROFILEDEF(.AREA.,$," + flat + ",2000.,1000.,1000.,500.)"), 1.5},
      {profile("IFCELLIPSEPROFILEDEF(.AREA.,$," + flat + ",1000.,500.)"), 1.5708},
      {csg("IFCRIGHTCIRCULARCYLINDER(" + at() + ",3000.,500.)"), 2.3562},
      {csg("IFCRIGHTCIRCULARCONE(" + at() + ",3000.,500.)"), 0.7854},
      {csg("IFCRECTANGULARPYRAMID(" + at() + ",1000.,500.,750.)"), 0.125},
      {csg("IFCBOOLEANRESULT(.DIFFERENCE.," + block + "," + drill + ")"), 1 - 0.12566}};
  const IfcBuilding building = building_of_text(text.text(), folder / "t.ifc");
  CHECK(building.unread.empty());
  CHECK(building.open_solids.empty());
  for (const auto& [id, volume_m3] : solids) {
    INFO(id);
    CHECK(signed_volume_of(part_with(building, StepText::guid_of(id)).mesh) ==
          Approx(volume_m3).epsilon(0.015));
  }
}
