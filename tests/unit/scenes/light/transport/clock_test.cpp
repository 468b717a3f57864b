// Light over time: the mains until they fail, then emergency light until its supply ends.
#include <catch2/catch.hpp>

#include "scenes/light/transport/compile_light.hpp"
#include "tests/unit/scenes/formats/scene_file/scene_fixture.hpp"

namespace luxodus {
namespace {

const std::string lamp =
    "[[luminaire]]\nname = \"lamp\"\nfile = \"lamp.ies\"\nposition = [0, 0, 2]\n"
    "emergency = \"maintained\"\nemergency_factor = 0.1\nmaintenance_factor = 0.8\n"
    "end_of_duration_factor = 0.7\nonset = [[0, 0], [10, 1]]\nduration_h = 0.01\n";
const std::string exit_sign =
    "[[sign]]\nname = \"exit\"\nposition = [9, 1, 2]\nfacing = [-1, 0, 0]\nwidth = 0.4\n"
    "height = 0.2\nplain = \"green\"\nsmallest_detail = 0.02\nmains_white = 500\n"
    "mains_green = 50\nemergency_white = 60\nemergency_green = 6\nduration_h = 0.02\n";
const std::string emergency = "[[scenario]]\nname = \"fire\"\noperation = \"emergency\"\n";

SceneDescription good_at(SceneFolder& folder, const std::string& text, double at_s) {
  ReadScene read = read_scene(folder.put("scene.toml", text), at_s);
  INFO(all_problems(read));
  REQUIRE(read.scene.has_value());
  return *read.scene;
}

/// Light of lit luminaires in the first scenario [lm].
double lamp_lm(const SceneDescription& scene) {
  double sum = 0;
  for (const ActiveSource& source : active_sources(scene, scene.scenarios.front()))
    if (source.emitter != nullptr) sum += source.lumens;
  return sum;
}

}  // namespace

TEST_CASE("lights run on the mains until they fail, then run up, and end with their supply",
          "[format][scene][time]") {
  SceneFolder f;
  const std::string text =
      "[time]\nto = 100\nstep = 10\nmains_fail_at = 40\n" + lamp + exit_sign + emergency;
  const double rated = lamp_lm(good_at(f, text, 0));
  REQUIRE(rated > 0);
  CHECK(lamp_lm(good_at(f, text, 39.9)) == near(rated));
  CHECK(lamp_lm(good_at(f, text, 40)) == 0);  // onset
  const double full = rated * 0.1 * 0.7;      // the emergency factor, at the end of the duration
  CHECK(lamp_lm(good_at(f, text, 45)) == Approx(full / 2).epsilon(1e-9));
  CHECK(lamp_lm(good_at(f, text, 50)) == Approx(full).epsilon(1e-9));
  CHECK(lamp_lm(good_at(f, text, 75.9)) == Approx(full).epsilon(1e-9));
  CHECK(lamp_lm(good_at(f, text, 76)) == 0);  // 0.01 h after the failure
  const auto green = [&](double at_s) {
    const SceneDescription scene = good_at(f, text, at_s);
    return scenario_luminance(scene.signs.at(0), 1, scene.scenarios.at(0));
  };
  CHECK(green(0) == 50);
  CHECK(green(40) == 6);
  CHECK(green(111.9) == 6);
  CHECK(green(112) == 0);  // 0.02 h after the failure
  const Scenario before = good_at(f, text, 0).scenarios.at(0);
  CHECK(before.operation == Operation::mains);
  CHECK(before.written_operation == Operation::emergency);
  CHECK_FALSE(before.says_seconds);
  const Scenario after = good_at(f, text, 55).scenarios.at(0);
  CHECK(after.operation == Operation::emergency);
  CHECK(after.seconds_after_failure == 15);
}

}  // namespace luxodus
