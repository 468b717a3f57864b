// The content of a model: units, placements, storeys, types, properties, volumes.
#include "scenes/formats/ifc/ifc_model.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "runtime/core/regular_file.hpp"
#include "tests/kit/small_ifc.hpp"

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
