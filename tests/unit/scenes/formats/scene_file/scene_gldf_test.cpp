// Luminaires of GLDF containers in scenes.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/kit/zip_kit.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

/// One variant; its emitter "e" is rated at 1000 lm, and at 200 lm or not at all for emergencies.
std::string container(bool says_emergency, const std::string& more = "",
                      const std::string& behaviour = "Combined") {
  const std::string emergency =
      more + (says_emergency ? "<EmergencyRatedLuminousFlux>200</EmergencyRatedLuminousFlux>" : "");
  const std::string small_lamp =
      "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 -0.2 -0.2 0\n1 1 10\n0 45 90\n0\n"
      "300 200 0\n";
  const std::string xml =
      R"(<Root><Header><FormatVersion major="1" minor="0"/></Header><GeneralDefinitions><Files>)"
      R"(<File id="f" contentType="ldc/ies" type="localFileName">lamp.ies</File></Files>)"
      R"(<Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/></Photometry>)"
      R"(</Photometries><Emitters><Emitter id="e"><FixedLightEmitter emergencyBehaviour=")" +
      behaviour +
      R"("><PhotometryReference )"
      R"(photometryId="p"/><RatedLuminousFlux>1000</RatedLuminousFlux>)" +
      emergency +
      R"(</FixedLightEmitter></Emitter></Emitters></GeneralDefinitions><ProductDefinitions>)"
      R"(<ProductMetaData><Name><Locale language="en">Lamp</Locale></Name></ProductMetaData>)"
      R"(<Variants><Variant id="v"><Geometry><EmitterReference emitterId="e"/></Geometry>)"
      R"(</Variant></Variants></ProductDefinitions></Root>)";
  return test::zip_of({{"product.xml", xml}, {"ldc/lamp.ies", small_lamp}});
}

const std::string contained =
    "[[luminaire]]\nname = \"a\"\nposition = [0, 0, 2]\nfile = \"a.gldf\"\n";
const std::string lit_in_emergencies =
    "emergency = \"maintained\"\nmaintenance_factor = 0.5\nend_of_duration_factor = 0.9\n";

}  // namespace

TEST_CASE("a luminaire takes both fluxes from its container", "[format][gldf]") {
  SceneFolder folder;
  folder.put("a.gldf", container(true));
  const SceneDescription scene = good(folder, contained + lit_in_emergencies);
  REQUIRE(scene.emitters.size() == 1);
  CHECK(scene.emitters[0].mains_flux == near(500));
  CHECK(scene.emitters[0].emergency_flux == near(200 * 0.5 * 0.9));
  CHECK(scene.emitters[0].product == "Lamp");
  const auto stated =
      good(folder, contained + lit_in_emergencies + "emergency_flux = 80\nvariant = \"v\"\n");
  CHECK(stated.emitters[0].emergency_flux == near(80 * 0.5 * 0.9));
}

TEST_CASE("an emergency flux that a container does not state must be stated in the scene",
          "[format][gldf]") {
  SceneFolder folder;
  folder.put("a.gldf", container(false));
  const std::string problems = all_problems(folder.read(contained + lit_in_emergencies));
  CHECK(problems.find("say 'emergency_flux' or 'emergency_factor'") != std::string::npos);
  const auto stated = good(folder, contained + lit_in_emergencies + "emergency_factor = 0.2\n");
  CHECK(stated.emitters[0].emergency_flux == near(200 * 0.5 * 0.9));
  CHECK(good(folder, contained).emitters[0].mains_flux == near(1000));
}

TEST_CASE("an emitter for normal lighting is lit in an emergency by the scene's own flux alone",
          "[format][gldf]") {
  SceneFolder folder;
  folder.put("a.gldf", container(true, "", "None"));
  CHECK(
      all_problems(folder.read(contained + lit_in_emergencies)).find("for normal lighting only") !=
      std::string::npos);
  const auto stated = good(folder, contained + lit_in_emergencies + "emergency_flux = 80\n");
  CHECK(stated.emitters[0].emergency_flux == near(80 * 0.5 * 0.9));
  CHECK(std::any_of(stated.warnings.begin(), stated.warnings.end(), [](const Problem& w) {
    return w.what.find("for normal lighting only") != std::string::npos;
  }));
}

TEST_CASE("the turn of a container's emitter turns the luminaire", "[format][gldf]") {
  SceneFolder folder;
  folder.put("a.gldf", container(true, "<Rotation><X>90</X></Rotation>"));
  const Emitter level = good(folder, contained).emitters.at(0);
  CHECK(same(level.frame.axes * glm::dvec3(0, 0, -1), {0, 1, 0}));
  CHECK(same(level.frame.origin, {0, 0, 2}));
  const Emitter turned = good(folder, contained + "rotation_deg = 90\n").emitters.at(0);
  CHECK(same(turned.frame.axes * glm::dvec3(0, 0, -1), {-1, 0, 0}));
  const std::string design =
      "[design]\n[[design.type]]\nname = \"t\"\nfile = \"a.gldf\"\n" + lit_in_emergencies;
  CHECK(all_problems(folder.read(contained + design)).find("turns this emitter") !=
        std::string::npos);
}

TEST_CASE("keys for containers are rejected for other files", "[format][gldf]") {
  SceneFolder folder;
  const std::string problems = all_problems(folder.read(
      "[[luminaire]]\nname = \"a\"\nposition = [0, 0, 2]\nfile = \"lamp.ies\"\nvariant = \"v\"\n"));
  CHECK(problems.find("'variant' belongs to a GLDF container") != std::string::npos);
  folder.put("a.gldf", container(true));
  const std::string set = all_problems(folder.read(contained + "lamp_set = 2\n"));
  CHECK(set.find("scene.toml:5: 'lamp_set' belongs to an EULUMDAT file (.ldt); this is a container "
                 "with IES") != std::string::npos);
  folder.put("a.gldf", "no container");
  const std::string broken = all_problems(folder.read(contained + lit_in_emergencies));
  CHECK(broken.find("a.gldf: this is no GLDF container") != std::string::npos);
  CHECK(broken.find("is needed") == std::string::npos);
}

}  // namespace luxodus
