// The content of a model: units, placements, storeys, types, properties, volumes.
#include "scenes/formats/ifc/ifc_model.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "runtime/core/regular_file.hpp"
#include "tests/kit/small_ifc.hpp"
#include "tests/kit/step_text.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

IfcModel model_of(const std::string& text) {
  auto model = ifc_model_of(text, "small.ifc");
  if (!model) FAIL(model.problem().text());
  return std::move(model).value();
}

const IfcProduct& named(const IfcModel& model, const std::string& guid) {
  for (const IfcProduct& product : model.products)
    if (product.guid == guid) return product;
  FAIL("no product " << guid);
  return model.products.front();
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("placements are in metres, in any unit and however far from the origin", "[ifc]") {
  for (const bool feet : {false, true}) {
    SmallIfc small;
    small.feet = feet;
    small.site = {500'000, -4'200'000, 350};
    const IfcModel model = model_of(small.text());
    INFO("feet " << feet);
    CHECK(model.metres_per_unit == (feet ? 0.3048 : 0.001));
    const glm::dvec3 at = named(model, small.door_guid).placement.offset;
    CHECK(at.x == Approx(500'005.125).epsilon(1e-12));
    CHECK(at.y == Approx(-4'199'998.5).epsilon(1e-12));
    CHECK(at.z == Approx(351).epsilon(1e-12));
  }
}

TEST_CASE("products know their storey, type, materials and properties", "[ifc]") {
  SmallIfc small;
  small.wall_volume_m3 = 3.24;
  const IfcModel model = model_of(small.text());
  CHECK(model.schema == "IFC4");
  CHECK(model.project == "A small house");
  REQUIRE(model.storeys.size() == 1);
  CHECK(model.storeys[0].name == "Ground \xc3\xa4");
  CHECK(model.storeys[0].elevation_m == Approx(1));
  const IfcProduct& door = named(model, small.door_guid);
  CHECK(door.kind == "DOOR");
  CHECK(door.storey == "Ground \xc3\xa4");
  CHECK(door.operation == "SINGLE_SWING_LEFT");
  CHECK(door.property("Pset_DoorCommon.FireExit") == "T");
  CHECK(door.property("Pset_DoorCommon.IsExternal").empty());
  CHECK(door.fills != 0);
  const IfcProduct& lamp = named(model, small.lamp_guid);
  CHECK(lamp.type_name == "Lamp");
  CHECK(lamp.type_class == "IFCLIGHTFIXTURETYPE");
  CHECK(lamp.predefined == "POINTSOURCE");
  // Emergency properties are enumerated values, which some exporters drop.
  CHECK(named(model, small.sign_guid)
            .property("Pset_LightFixtureTypeSecurityLighting.SecurityLightingType") ==
        "EMERGENCYEXITLIGHT");
  const IfcProduct& space = named(model, small.space_guid);
  CHECK((space.name == "1" && space.long_name == "Hall"));
  CHECK(space.storey == "Ground \xc3\xa4");
  const IfcProduct& north = named(model, small.north_guid);
  CHECK(north.materials == std::vector<std::string>{"Brick"});
  CHECK(north.volume_m3 == std::optional<double>(3.24));
}

TEST_CASE("material lists that contain themselves many times are visited once", "[ifc]") {
  SmallIfc small;
  const std::string text = small.text(), material = "IFCMATERIAL('Brick',$,$)";
  const size_t at = text.find(material), line = text.rfind('#', at);
  REQUIRE(at != std::string::npos);
  const std::string own = text.substr(line, text.find('=', line) - line);
  std::string all = own;
  for (int i = 0; i < 999; ++i) all += "," + own;
  const IfcModel model = model_of(with(text, material, "IFCMATERIALLIST((" + all + "))"));
  for (const IfcProduct& product : model.products) CHECK(product.materials.empty());
}

TEST_CASE("a volume is converted from the model's unit of volume", "[ifc]") {
  SmallIfc small;
  small.wall_volume_m3 = 3.24;
  const std::string litres = with(small.text(), "IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)",
                                  "IFCSIUNIT(*,.VOLUMEUNIT.,.DECI.,.CUBIC_METRE.)");
  CHECK(*named(model_of(litres), small.north_guid).volume_m3 == Approx(0.00324));
}

TEST_CASE("a model without a unit of length is rejected", "[ifc]") {
  SmallIfc small;
  const auto model = ifc_model_of(with(small.text(), ".LENGTHUNIT.", ".MASSUNIT."), "small.ifc");
  REQUIRE_FALSE(model.ok());
  CHECK(model.problem().what.find("no unit of length") != std::string::npos);
}

TEST_CASE("circular placements, and those that refer to nothing, are reported by number", "[ifc]") {
  SmallIfc small;
  const std::string text = small.text();
  // The storey's placement becomes one within itself.
  const size_t storey = text.find("IFCBUILDINGSTOREY");
  const size_t reference = text.find(",$,$,#", storey) + 5;
  const std::string id = text.substr(reference, text.find(',', reference) - reference);
  const size_t at = text.find("\n" + id + "=IFCLOCALPLACEMENT(") + id.size() + 20;
  std::string circular = text;
  circular.replace(at, circular.find(',', at) - at, id);
  const IfcModel model = model_of(circular);
  CHECK(model.storeys.empty());
  REQUIRE_FALSE(model.faults.empty());
  CHECK(model.faults[0].what.find("has a placement that leads nowhere") != std::string::npos);
}

TEST_CASE("models of other programs have the content that their authors meant", "[ifc]") {
  const std::filesystem::path folder = std::filesystem::path(LUX_SHARED_DATA) / "ifc";
  if (!std::filesystem::is_directory(folder)) {
    WARN("skipped: the models are not there (" << folder.string() << ")");
    return;
  }
  const auto read = [&](const char* name) {
    auto bytes = read_regular_file(folder / name, limits::step_bytes);
    REQUIRE(bytes.ok());
    return model_of(std::move(bytes).value());
  };
  const IfcModel room = read("room_ifc4.ifc");
  const IfcProduct& safety = named(room, "1hLgrQjMhLgrwTEdpP0027");
  REQUIRE(safety.light);
  CHECK(safety.light->document == "safety.ldt");
  CHECK(safety.light->axis.z == Approx(-1));
  CHECK(safety.property("Pset_LightFixtureTypeSecurityLighting.BackupSupplySystem") ==
        "CENTRALBATTERY");
  const IfcModel duplex = read("duplex_electrical_excerpt.ifc");
  CHECK(duplex.schema == "IFC2X3");
  CHECK(duplex.metres_per_unit == Approx(0.3048));
  const auto fixtures =
      std::count_if(duplex.products.begin(), duplex.products.end(),
                    [](const IfcProduct& p) { return p.type_class == "IFCLIGHTFIXTURETYPE"; });
  CHECK(fixtures == 5);  // and one receptacle of another type class
  const IfcModel hostile = read("room_hostile_own.ifc");
  CHECK(hostile.faults.size() >= 2);
}

namespace {

const IfcProduct& product_called(const IfcModel& model, const std::string& name) {
  for (const IfcProduct& product : model.products)
    if (product.name == name) return product;
  FAIL("no product " << name);
  return model.products.front();
}

}  // namespace

TEST_CASE("property sets in a definition set are read", "[ifc]") {
  StepText text;
  const std::string door =
      text.product("IFCDOOR", "D", text.local(text.storey_place, {0, 0, 0}), "$", ",$,$,$,$,$");
  const std::string fire = text.add("IFCPROPERTYSINGLEVALUE('FireExit',$,IFCBOOLEAN(.T.),$)");
  const std::string out = text.add("IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$)");
  const std::string one =
      text.add("IFCPROPERTYSET(" + text.guid() + ",$,'Pset_DoorCommon',$,(" + fire + "))");
  const std::string two =
      text.add("IFCPROPERTYSET(" + text.guid() + ",$,'Pset_Own',$,(" + out + "))");
  text.add("IFCRELDEFINESBYPROPERTIES(" + text.guid() + ",$,$,$,(" + door +
           "),IFCPROPERTYSETDEFINITIONSET((" + one + "," + two + ")))");
  const IfcModel model = model_of(text.text());
  CHECK(product_called(model, "D").property("Pset_DoorCommon.FireExit") == "T");
  CHECK(product_called(model, "D").property("Pset_Own.IsExternal") == "T");
}

TEST_CASE("storeys of one name are two, and nested parts are in that of their whole", "[ifc]") {
  StepText text;
  const std::string above = text.local(text.site_place, {0, 0, 3200});
  const std::string upper = text.add_storey("Level 1", above);
  const std::string place = text.local(above, {0, 0, 0});
  const std::string whole =
      text.add("IFCFURNITURE(" + text.guid() + ",$,'whole',$,$," + place + ",$,$,$)");
  const std::string part =
      text.add("IFCFURNITURE(" + text.guid() + ",$,'part',$,$," + place + ",$,$,$)");
  text.add("IFCRELNESTS(" + text.guid() + ",$,$,$," + whole + ",(" + part + "))");
  text.add("IFCRELCONTAINEDINSPATIALSTRUCTURE(" + text.guid() + ",$,$,$,(" + whole + ")," + upper +
           ")");
  text.wall(text.box({0, 0, 0}, {4000, 200, 3000}));
  const IfcModel model = model_of(text.text());
  REQUIRE(model.storeys.size() == 2);
  CHECK(model.storeys[0].id != model.storeys[1].id);
  CHECK(product_called(model, "W").storey_id == model.storeys[0].id);
  CHECK(product_called(model, "whole").storey_id == model.storeys[1].id);
  CHECK(product_called(model, "part").storey_id == model.storeys[1].id);
  CHECK(product_called(model, "part").part_of == product_called(model, "whole").id);
}

TEST_CASE("a product at the intersection of grid axes has its place", "[ifc]") {
  StepText text;
  const auto axis = [&](const std::string& tag, const glm::dvec2& from, const glm::dvec2& to) {
    const std::string line =
        text.add("IFCPOLYLINE((" + text.point(from) + "," + text.point(to) + "))");
    return text.add("IFCGRIDAXIS('" + tag + "'," + line + ",.T.)");
  };
  const std::string a = axis("A", {0, 5000}, {9000, 5000}), b = axis("1", {3000, 0}, {3000, 9000});
  const std::string at = text.local(text.storey_place, {10000, 0, 2000});
  text.add("IFCGRID(" + text.guid() + ",$,'grid',$,$," + at + ",$,(" + a + "),(" + b + "),$,$)");
  const std::string where =
      text.add("IFCVIRTUALGRIDINTERSECTION((" + a + "," + b + "),(100.,200.,300.))");
  const std::string place = text.add("IFCGRIDPLACEMENT(" + where + ",$)");
  text.product("IFCCOLUMN", "C", place, "$");
  const std::string newer = text.add("IFCGRIDPLACEMENT($," + where + ",$)");  // as in IFC4x3
  text.product("IFCCOLUMN", "D", newer, "$");
  const std::string nowhere =
      text.add("IFCGRIDPLACEMENT(" +
               text.add("IFCVIRTUALGRIDINTERSECTION((" + a + "," + a + "),(0.,0.))") + ",$)");
  text.product("IFCCOLUMN", "E", nowhere, "$");
  const IfcModel model = model_of(text.text());
  // Offsets count to the left of an axis: up from A, to the west of 1.
  for (const char* name : {"C", "D"})
    CHECK(glm::length(product_called(model, name).placement.offset - glm::dvec3(12.8, 5.1, 2.3)) <
          1e-9);
  REQUIRE(model.faults.size() == 1);
  CHECK(model.faults[0].what.find("leads nowhere") != std::string::npos);
}

TEST_CASE("light sources within a model give place, direction and intensities", "[ifc]") {
  StepText text;
  const auto fixture = [&](const std::string& name, const std::string& source) {
    const std::string shape = text.shape(text.representation(text.body, "LightSource", source));
    text.product("IFCLIGHTFIXTURE", name, text.local(text.storey_place, {1000, 2000, 3000}), shape);
  };
  const auto gonio = [&](const std::string& data, const std::string& flux) {
    const std::string distribution =
        text.add("IFCLIGHTINTENSITYDISTRIBUTION(.TYPE_C.,(" + data + "))");
    const std::string place = text.axes({0, 0, -50}, {0, 0, -1});
    return text.add("IFCLIGHTSOURCEGONIOMETRIC('g',$,$,$," + place + ",$,3000.," + flux +
                    ",.LIGHTEMITTINGDIODE.," + distribution + ")");
  };
  // Lambert's law: 1000 lm / pi = 318.31 cd/klm on the axis.
  const std::string lambert =
      text.add("IFCLIGHTDISTRIBUTIONDATA(0.,(0.,30.,60.,90.),(318.31,275.66,159.155,0.))");
  const std::string loud = text.add("IFCLIGHTDISTRIBUTIONDATA(0.,(0.,45.,90.),(9000.,9000.,0.))");
  fixture("lambert", gonio(lambert, "1500."));
  fixture("no flux", gonio(lambert, "0."));
  fixture("loud", gonio(loud, "1500."));
  fixture("spot", text.add("IFCLIGHTSOURCESPOT('s',$,$,$," + text.point({0, 0, -50}) +
                           ",10.,0.,0.,0.," + text.direction({1, 0, 0}) + ",1.,30.,20.)"));
  const IfcModel model = model_of(text.text());
  const auto light = product_called(model, "lambert").light;
  REQUIRE(light);
  CHECK(glm::length(light->position - glm::dvec3(1, 2, 2.95)) < 1e-12);
  CHECK(glm::length(light->axis - glm::dvec3(0, 0, -1)) < 1e-12);
  const auto ies = ies_text_of(*light, "lambert");
  REQUIRE(ies.ok());
  CHECK(ies->find("\n477.465 413.49 238.7325 0\n") != std::string::npos);
  CHECK_FALSE(ies_text_of(*product_called(model, "no flux").light, "x").ok());
  const auto refused = ies_text_of(*product_called(model, "loud").light, "x");
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("neither can be") != std::string::npos);
  const auto spot = product_called(model, "spot").light;
  REQUIRE(spot);
  CHECK(spot->kind == "spot");
  CHECK(spot->axis == glm::dvec3(1, 0, 0));
}

namespace {

/// The luminous intensities of a light source of 1500 lm whose data are these, as an IES file.
Result<std::string> ies_of(StepText text, const std::vector<std::string>& data) {
  std::string all;
  for (const std::string& one : data)
    all += (all.empty() ? "" : ",") + text.add("IFCLIGHTDISTRIBUTIONDATA(" + one + ")");
  const std::string distribution =
      text.add("IFCLIGHTINTENSITYDISTRIBUTION(.TYPE_C.,(" + all + "))");
  const std::string source =
      text.add("IFCLIGHTSOURCEGONIOMETRIC('g',$,$,$," + text.axes({0, 0, 0}) +
               ",$,3000.,1500.,.NOTDEFINED.," + distribution + ")");
  text.product("IFCLIGHTFIXTURE", "lamp", text.local(text.storey_place, {0, 0, 0}),
               text.shape(text.representation(text.body, "LightSource", source)));
  const IfcModel model = model_of(text.text());
  REQUIRE(product_called(model, "lamp").light);
  return ies_text_of(*product_called(model, "lamp").light, "lamp");
}

/// Lambert's law in planes at these angles.
std::vector<std::string> planes_at(const std::vector<int>& angles) {
  std::vector<std::string> out;
  for (const int angle : angles)
    out.push_back(std::to_string(angle) + ".,(0.,30.,60.,90.),(318.31,275.66,159.155,0.)");
  return out;
}

}  // namespace

TEST_CASE("intensities that leave a part of the circle uncovered are rejected", "[ifc]") {
  for (const auto& whole : std::vector<std::vector<int>>{
           {0}, {0, 90}, {0, 90, 180}, {0, 90, 180, 270}, {0, 90, 180, 270, 360}})
    CHECK(ies_of(StepText(), planes_at(whole)).ok());
  const auto four = ies_of(StepText(), planes_at({0, 90, 180, 270}));
  CHECK(four->find("\n0 90 180 270 360\n") != std::string::npos);
  for (const auto& part : std::vector<std::vector<int>>{
           {0, 45, 90, 135, 180, 225, 270}, {0, 30, 60, 90, 120, 150, 180, 210}, {0, 60}}) {
    const auto refused = ies_of(StepText(), planes_at(part));
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.problem().what.find("its planes end at C") != std::string::npos);
  }
  // Nothing is known of the light between 120 and 180 degrees.
  const auto above = ies_of(StepText(), {"0.,(0.,60.,90.,120.),(318.31,159.155,0.,0.)"});
  REQUIRE_FALSE(above.ok());
  CHECK(above.problem().what.find("do not rise from 0 to 90 or 180") != std::string::npos);
}

TEST_CASE("angles of intensities are in the unit of plane angles of the model", "[ifc]") {
  using Angles = StepText::Angles;
  const std::string in_degrees = "0.,(0.,30.,60.,90.),(318.31,275.66,159.155,0.)";
  const std::string in_radians = "0.,(0.,0.5236,1.0472,1.5708),(318.31,275.66,159.155,0.)";
  const auto degrees = ies_of(StepText("IFC4", Angles::degrees), {in_degrees});
  const auto radians = ies_of(StepText("IFC4", Angles::radians), {in_radians});
  REQUIRE(degrees.ok());
  REQUIRE(radians.ok());
  CHECK(radians.value() == degrees.value());
  // No angle in radians exceeds a full circle.
  const auto mixed = ies_of(StepText("IFC4", Angles::radians), {in_degrees});
  REQUIRE(mixed.ok());
  CHECK(mixed.value() == degrees.value());
  const std::string neither = "0.,(0.,200.,400.,600.),(318.31,275.66,159.155,0.)";
  const auto beyond = ies_of(StepText("IFC4", Angles::radians), {neither});
  REQUIRE_FALSE(beyond.ok());
  CHECK(beyond.problem().what.find("they seem to be in another") != std::string::npos);
  CHECK_FALSE(ies_of(StepText("IFC4", Angles::degrees), {in_radians}).ok());
  const auto unstated = ies_of(StepText("IFC4", Angles::unstated), {in_degrees});
  REQUIRE_FALSE(unstated.ok());
  CHECK(unstated.problem().what.find("no unit of plane angles") != std::string::npos);
}
