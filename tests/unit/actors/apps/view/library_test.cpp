// What a viewer may add: kinds of the scene, and types of its design that are not placed.
#include "actors/apps/view/library.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "actors/apps/view/live_scene.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/apps/view/hub_kit.hpp"

using namespace luxodus;

namespace {

const std::string types = R"(
[[emitter]]
name = "panel"
shape = "disc"
diameter = 0.2
distribution = "lambertian"
position = [5, 1, 2.9]
flux_lm = 100
[[design.type]]
name = "new downlight"
file = ")" + std::string(LUX_SOURCE_DIR) +
                          R"(/scenes/library/luminaires/emergency_downlight.ldt"
emergency = "non-maintained"
emergency_flux = 250
maintenance_factor = 0.8
end_of_duration_factor = 0.7
[[design.sign]]
name = "new sign"
width = 0.3
height = 0.15
text = "EXIT"
letter_height = 0.1
mains_white = 500
mains_green = 50
emergency_white = 100
emergency_green = 10
)";

std::shared_ptr<const SceneDescription> scene_with_types(const test::TemporaryFolder& folder) {
  return test::described(folder.write("room.toml", test::live_room + types));
}

}  // namespace

TEST_CASE("the library has types of the design first, then each kind of the scene once", "[view]") {
  const test::TemporaryFolder folder;
  const Json library = library_json(*scene_with_types(folder));
  const Json& luminaires = library["luminaires"];
  REQUIRE(luminaires.size() == 3);  // "left" and "right" are of one kind
  CHECK(luminaires[0]["of"] == "new downlight");
  CHECK(luminaires[0]["of_type"] == true);
  CHECK(luminaires[0]["emergency"] == Approx(250 * 0.8 * 0.7));
  CHECK(luminaires[1]["of"] == "left");
  CHECK(luminaires[1]["of_type"] == false);
  CHECK(luminaires[2]["of"] == "panel");
  REQUIRE(library["signs"].size() == 2);
  CHECK(library["signs"][0]["of"] == "new sign");
  CHECK(library["signs"][1]["of"] == "exit");
  const Json& face = library["signs"][1]["face"];
  CHECK(face["columns"].get<int>() <= 96);
  CHECK(face["rows"].get<int>() <= 96);
}

TEST_CASE("the library has intensities by angle from straight down", "[view]") {
  const test::TemporaryFolder folder;
  const Json library = library_json(*scene_with_types(folder));
  CHECK(library["step"] == 5);
  const Json& curves = library["luminaires"][2]["curves"];
  REQUIRE(curves.size() == 2);
  for (const Json& curve : curves) {
    REQUIRE(curve.size() == 73);
    CHECK(curve[36].get<double>() == Approx(1000 / std::numbers::pi).epsilon(1e-3));
    CHECK(curve[24].get<double>() == Approx(500 / std::numbers::pi).epsilon(1e-3));  // 60 degrees
    CHECK(curve[48] == curve[24]);
    CHECK(curve[0] == 0);
  }
}

TEST_CASE("types of the design are added, copied, saved and undone", "[view]") {
  const test::TemporaryFolder folder;
  test::Edited edited(scene_with_types(folder));
  edited.says(R"({"type":"add","kind":"luminaire","of":"new downlight","of_type":true,)"
              R"("position":[3,2,2.9]})");
  CHECK((*edited.viewer.last("added"))["name"] == "new downlight");
  edited.until_done();
  const Json& lamp = test::Edited::named(edited.scene()["luminaires"], "new downlight");
  CHECK(lamp["added"] == true);
  CHECK(lamp["position"][2] == 2.9);
  edited.says(R"({"type":"add","kind":"luminaire","of":"new downlight","position":[1,1,2.9]})");
  CHECK((*edited.viewer.last("added"))["name"] == "new downlight copy");
  edited.says(R"({"type":"add","kind":"sign","of":"new sign","of_type":true,)"
              R"("position":[0.1,2,2.2],"facing":[1,0,0]})");
  edited.until_done();
  CHECK(edited.scene()["luminaires"].size() == 5);
  CHECK(edited.scene()["signs"].size() == 2);
  edited.says(R"({"type":"add","kind":"sign","of":"new sign","of_type":true,"position":[3,3,2]})");
  CHECK(edited.why().find("needs \"facing\"") != std::string::npos);
  edited.says(R"({"type":"save","name":"with types"})");
  INFO(edited.answers());
  REQUIRE(edited.viewer.last("saved") != nullptr);
  const auto saved = read_scene((*edited.viewer.last("saved"))["file"].get<std::string>());
  REQUIRE(saved.scene.has_value());
  CHECK(saved.scene->emitters.size() == 5);
  CHECK(saved.scene->emitters.back().emergency_flux == Approx(250 * 0.8 * 0.7));
  CHECK(saved.scene->signs.back().name == "new sign");
  CHECK(saved.scene->signs.back().frame.origin.x == Approx(0.1));
  edited.says(R"({"type":"history","done":0})");
  edited.until_done();
  CHECK(edited.scene()["luminaires"].size() == 3);
  edited.says(R"({"type":"add","kind":"luminaire","of":"left","of_type":true,)"
              R"("position":[3,2,2.9]})");
  CHECK(edited.why() == "there is no \"left\" to copy");
}
