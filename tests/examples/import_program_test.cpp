// Buildings and luminaires of other programs, in a user's steps: import, check, run, assess, import
// again.
#include <catch2/catch.hpp>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/small_ifc.hpp"
#include "tests/kit/small_l3d.hpp"
#include "tests/kit/zip_kit.hpp"

using namespace luxodus::program;
using Catch::Contains;
using luxodus::test::SmallIfc;

namespace {

const std::string small_lamp =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 -0.2 -0.2 0\n1 1 10\n0 45 90\n0\n"
    "300 200 0\n";

/// A container with the lamp, rated at 1000 lm, and at 200 lm in an emergency; with `model` as its
/// body if given.
std::string small_container(const std::string& name = "Small lamp", const std::string& model = "") {
  const std::string shape =
      R"(<GeometryReferences><ModelGeometryReference geometryId="m"><EmitterReference )"
      R"(emitterId="e"><EmitterObjectExternalName>leo</EmitterObjectExternalName>)"
      R"(</EmitterReference></ModelGeometryReference></GeometryReferences>)";
  const std::string xml =
      R"(<Root><Header><FormatVersion major="1" minor="0"/></Header><GeneralDefinitions><Files>)"
      R"(<File id="f" contentType="ldc/ies" type="localFileName">lamp.ies</File>)"
      R"(<File id="g" contentType="geo/l3d" type="localFileName">body.l3d</File></Files>)"
      R"(<Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/></Photometry>)"
      R"(</Photometries><Emitters><Emitter id="e"><FixedLightEmitter><PhotometryReference )"
      R"(photometryId="p"/><RatedLuminousFlux>1000</RatedLuminousFlux>)"
      R"(<EmergencyRatedLuminousFlux>200</EmergencyRatedLuminousFlux></FixedLightEmitter>)"
      R"(</Emitter></Emitters><Geometries><ModelGeometry id="m"><GeometryFileReference )"
      R"(fileId="g"/></ModelGeometry></Geometries></GeneralDefinitions><ProductDefinitions>)"
      R"(<ProductMetaData><Name><Locale language="en">)" +
      name +
      R"(</Locale></Name></ProductMetaData><Variants>)"
      R"(<Variant id="v"><Geometry>)" +
      (model.empty() ? R"(<EmitterReference emitterId="e"/>)" : shape) +
      R"(</Geometry></Variant></Variants></ProductDefinitions></Root>)";
  return luxodus::test::zip_of(
      {{"product.xml", xml}, {"ldc/lamp.ies", small_lamp}, {"geo/body.l3d", model}});
}

std::string within(const TemporaryFolder& folder, const std::string& name) {
  return (folder / name).string();
}

bool shapes_can_be_computed() {
  const fs::path package =
      fs::path(LUX_SOURCE_DIR) / "actors/import/shapes/node_modules/@ifc-lite/wasm";
  if (fs::is_directory(package) && std::system("node --version > /dev/null 2>&1") == 0) return true;
  WARN("skipped: Node.js or the package @ifc-lite/wasm is not there (./setup.sh)");
  return false;
}

}  // namespace

TEST_CASE("a container is listed, and its tables make a scene", "[program][import]") {
  const TemporaryFolder folder;
  folder.write("lamp.gldf", small_container());
  const Outcome listed = run_luxodus(folder, "import gldf " + within(folder, "lamp.gldf"));
  INFO(listed.err);
  REQUIRE(listed.code == 0);
  CHECK_THAT(listed.out, Contains("Small lamp") && Contains("rated 1000 lm, in an emergency 200"));
  const Outcome written = run_luxodus(
      folder, "import gldf " + within(folder, "lamp.gldf") + " --out " + within(folder, "lamps"));
  REQUIRE(written.code == 0);
  CHECK(slurp(folder / "lamps/lamp.ies") == small_lamp);
  const Outcome checked = run_luxodus(folder, "check " + within(folder, "lamps/luminaires.toml"));
  INFO(checked.err);
  CHECK_THAT(checked.out, Contains("1 emitters, 1000 lm"));
  folder.write("loud.gldf", small_container("Small \x1b[31mlamp\x07"));
  const Outcome quiet = run_luxodus(folder, "import gldf " + within(folder, "loud.gldf"));
  REQUIRE(quiet.code == 0);
  CHECK_THAT(quiet.out, Contains("Small \\x1B[31mlamp\\x07"));
  CHECK(quiet.out.find('\x1b') == std::string::npos);
  folder.write("bad.gldf", "no container");
  const Outcome refused = run_luxodus(folder, "import gldf " + within(folder, "bad.gldf"));
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains("bad.gldf: this is no GLDF container"));
}

TEST_CASE("a luminaire's model becomes its body, and blocks none of its light",
          "[program][import]") {
  const TemporaryFolder folder;
  folder.write("lamp.gldf", small_container("Lamp", luxodus::test::SmallL3d{}.bytes()));
  const std::string import = "import gldf " + within(folder, "lamp.gldf") + " --out ";
  const Outcome written = run_luxodus(folder, import + within(folder, "lamps"));
  INFO(written.err);
  REQUIRE(written.code == 0);
  CHECK_THAT(written.out, Contains("body: model \"body.l3d\" of 1 part"));
  CHECK_THAT(slurp(folder / "lamps/luminaires.toml"), Contains("file = \"body.obj\""));
  const Outcome run = run_luxodus(folder, "run " + within(folder, "lamps/luminaires.toml") +
                                              " --particles 20k --out " + within(folder, "out"));
  INFO(run.err);
  REQUIRE(run.code == 0);
  // All light shines down, past the body, which is a millimetre above the opening.
  CHECK_THAT(run.out, Contains("100 % escaped"));

  luxodus::test::SmallL3d coloured;
  coloured.obj = luxodus::test::coloured_box_obj("paint box.mtl");
  coloured.library = "newmtl red\nKd 1 0.1 0.05\nnewmtl white\nKd 1 1 1\n";
  folder.write("lamp.gldf", small_container("Lamp", coloured.bytes()));
  REQUIRE(run_luxodus(folder, import + within(folder, "red")).code == 0);
  CHECK_THAT(slurp(folder / "red/luminaires.toml"), Contains("file_colours = true"));
  CHECK_THAT(slurp(folder / "red/body.mtl"),
             Contains("Kd 0.9 0.1 0.05") && Contains("Kd 0.9 0.9 0.9"));
  const Outcome checked = run_luxodus(folder, "check " + within(folder, "red/luminaires.toml"));
  INFO(checked.err);
  CHECK(checked.code == 0);

  folder.write("lamp.gldf", small_container("Lamp", "no model"));
  const Outcome without = run_luxodus(folder, import + within(folder, "plain"));
  REQUIRE(without.code == 0);
  CHECK_THAT(without.out, Contains("\"body.l3d\" is not read: this is no L3D model"));
  CHECK_THAT(without.out, Contains("left out: the model \"body.l3d\""));
  CHECK_THAT(slurp(folder / "plain/luminaires.toml"), Contains("# Its model body.l3d is left out"));
}

TEST_CASE("light is traced in an imported model, and its results are by GlobalId",
          "[program][import]") {
  if (!shapes_can_be_computed()) return;
  const TemporaryFolder folder;
  SmallIfc small;
  folder.write("house.ifc", small.text());
  fs::create_directories(folder / "lights");
  folder.write("lights/lamp.gldf", small_container());
  const std::string import = "import ifc " + within(folder, "house.ifc") + " --out " +
                             within(folder, "house") + " --photometry " + within(folder, "lights");
  const Outcome imported = run_luxodus(folder, import);
  INFO(imported.err);
  REQUIRE(imported.code == 0);
  CHECK_THAT(imported.out, Contains("rooms 1, luminaires 1, signs 0") && Contains("Exit sign"));
  const Outcome checked = run_luxodus(folder, "check " + within(folder, "house/scene.toml"));
  INFO(checked.err);
  CHECK(checked.code == 0);
  CHECK_THAT(checked.out, Contains("no errors, no warnings"));

  // The user's additions: emergency light, and an exit.
  std::string fixtures = slurp(folder / "house/fixtures.toml");
  const size_t type = fixtures.find("name = \"Lamp\"\n");
  REQUIRE(type != std::string::npos);
  fixtures.insert(type,
                  "emergency = \"maintained\"\nmaintenance_factor = 0.8\n"
                  "emergency_flux_is = \"initial\"\nend_of_duration_factor = 0.9\n");
  folder.write("house/fixtures.toml", fixtures);
  folder.write("house/scene.toml",
               slurp(folder / "house/scene.toml") +
                   "\n[assessment]\nrules = [\"en1838-2024\"]\n[[scenario]]\nname = \"emergency\"\n"
                   "operation = \"emergency\"\n[[route]]\nname = \"out\"\n"
                   "path = [[1, 3, 1], [3, 2, 1], [4.5, 2, 1]]\nwidth = 1.2\n");
  REQUIRE(run_luxodus(folder, import).code == 0);
  const Outcome run = run_luxodus(folder, "run " + within(folder, "house/scene.toml") +
                                              " --particles 100k --out " + within(folder, "out"));
  INFO(run.err);
  CHECK(run.code == 0);
  CHECK_THAT(slurp(folder / "out/result.json"), Contains(small.north_guid));
  const Outcome assessed =
      run_luxodus(folder, "assess " + within(folder, "house/scene.toml") + " --codes-alone --out " +
                              within(folder, "assessed"));
  INFO(assessed.err);
  CHECK(assessed.code == 0);
  const std::string table = slurp(folder / "assessed/by_guid.csv");
  CHECK_THAT(table, Contains(small.lamp_guid + ",luminaire,Lamp 1,") &&
                        Contains("emergency flux,,144") &&
                        Contains(small.space_guid + ",space,1 Hall,en1838-2024,E6"));
  CHECK_THAT(slurp(folder / "assessed/property_sets.csv"),
             Contains(small.lamp_guid + ",Luxodus_EmergencyLighting,EmergencyFlux,144"));
  CHECK_THAT(table, Contains(",fail,"));  // a sign is missing, so that an issue is written
  CHECK_THAT(slurp(folder / "assessed/issues.bcf"),
             Contains("<Version VersionId=\"2.1\">") && Contains("<PerspectiveCamera>"));
}

TEST_CASE("an area that a person has renamed in building.toml keeps its name",
          "[program][import]") {
  if (!shapes_can_be_computed()) return;
  const TemporaryFolder folder;
  SmallIfc small;
  folder.write("house.ifc", small.text());
  const std::string import =
      "import ifc " + within(folder, "house.ifc") + " --out " + within(folder, "house");
  REQUIRE(run_luxodus(folder, import).code == 0);
  std::string building = slurp(folder / "house/building.toml");
  const size_t name = building.find("name = \"1 Hall\"");
  REQUIRE(name != std::string::npos);
  folder.write("house/building.toml", building.replace(name, 15, "name = \"Foyer\""));
  for (int again = 0; again < 2; ++again) {
    const Outcome second = run_luxodus(folder, import);
    INFO(second.err);
    REQUIRE(second.code == 0);
    CHECK_THAT(second.out, Contains("\"Foyer\" was kept"));
    CHECK_THAT(slurp(folder / "house/building.toml"), Contains("name = \"Foyer\""));
  }
}

TEST_CASE("a plan without a unit requires one, and its layers wait for the user",
          "[program][import]") {
  const TemporaryFolder folder;
  folder.write(
      "plan.dxf",
      "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nWALLS\n10\n0\n20\n0\n30\n0\n11\n5\n21\n0\n31\n0\n"
      "0\nLINE\n8\nWALLS\n10\n0\n20\n0\n30\n0\n11\n0\n21\n4\n31\n0\n0\nENDSEC\n0\nEOF\n");
  const std::string import =
      "import dxf " + within(folder, "plan.dxf") + " --out " + within(folder, "plan");
  const Outcome unasked = run_luxodus(folder, import);
  CHECK(unasked.code == 2);
  CHECK_THAT(unasked.err, Contains("say it by --units"));
  const Outcome first = run_luxodus(folder, import + " --units m");
  INFO(first.err);
  REQUIRE(first.code == 0);
  CHECK_THAT(first.out, Contains("walls 0") && Contains("plan.toml makes no layer a wall"));
  folder.write("plan/plan.toml", "[[layer]]\nname = \"WALLS\"\nas = \"sheet\"\n");
  const Outcome second = run_luxodus(folder, import + " --units m");
  CHECK_THAT(second.out, Contains("walls 2"));
  const Outcome checked = run_luxodus(folder, "check " + within(folder, "plan/scene.toml"));
  INFO(checked.err);
  CHECK(checked.code == 0);
}
