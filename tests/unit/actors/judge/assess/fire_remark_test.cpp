// Tests the remarks on smoke that a fire simulation has computed.
#include <algorithm>
#include <catch2/catch.hpp>

#include "actors/judge/assess/judged_state.hpp"
#include "actors/judge/assess/state_words.hpp"

namespace luxodus {
namespace {

SceneDescription scene_of_fire(bool glows) {
  Medium smoke;
  smoke.name = "fire";
  smoke.kind = MediumKind::data_set;
  smoke.optics.extinction.sigma_t = 1;
  smoke.data.nx = smoke.data.ny = smoke.data.nz = 1;
  smoke.data.extent = glm::dvec3(1);
  smoke.data.extinction = {0.5F};
  smoke.simulation = FireSimulation{"fire.smv", 60.0264, "Smoke3D", glows, Frame{}, {}};
  SceneDescription scene;
  scene.media = {smoke};
  return scene;
}

bool warns_of_glare(const AssessedState& state) {
  const Remark missing = remark(RemarkId::flame_glare_missing, "fire");
  return std::count(state.warnings.begin(), state.warnings.end(), missing) > 0;
}

}  // namespace

TEST_CASE("verdicts in simulated smoke say if the flames are missing from the scene",
          "[assess][fds]") {
  Scenario smoky, cleared;
  cleared.media = {{"fire", 0}};
  CHECK(warns_of_glare(state_of(scene_of_fire(false), smoky, {})));
  CHECK_FALSE(warns_of_glare(state_of(scene_of_fire(true), smoky, {})));
  CHECK_FALSE(warns_of_glare(state_of(scene_of_fire(false), cleared, {})));
  const AssessedState state = state_of(scene_of_fire(true), smoky, {});
  REQUIRE(state.media.size() == 1);
  CHECK(state.media[0].notes.back() == remark(RemarkId::fire_simulation, 60.0264, "Smoke3D"));
}

TEST_CASE("verdicts in smoke say if a state leaves out the light of flames", "[assess]") {
  SceneDescription scene;
  Medium smoke, flame;
  smoke.name = "smoke";
  smoke.optics.extinction.sigma_t = 0.5;
  flame.name = "fl";
  flame.kind = MediumKind::bounded;
  flame.emission.emplace();
  flame.emission->circuit = "gas";
  scene.media = {smoke, flame};
  const auto dimmed = [&](const Scenario& state) {
    const AssessedState judged = state_of(scene, state, {});
    for (const Remark& one : judged.warnings)
      if (one.id == RemarkId::flame_dimmed) return true;
    return false;
  };
  Scenario burning;
  CHECK_FALSE(dimmed(burning));
  Scenario off = burning;
  off.emission_factor = 0;
  CHECK(dimmed(off));
  const Remark all_of_it = remark(RemarkId::flame_dimmed, 0.0, "fl");
  const AssessedState judged = state_of(scene, off, {});
  CHECK(std::count(judged.warnings.begin(), judged.warnings.end(), all_of_it) == 1);
  off.emission_factor = 0.001;
  CHECK(dimmed(off));
  Scenario by_circuit = burning;
  by_circuit.circuits = {{"gas", 0}};
  CHECK(dimmed(by_circuit));
  Scenario without_flame = burning;
  without_flame.media = {{"fl", 0}};
  CHECK(dimmed(without_flame));
  // There is no fire in clear air.
  off.media = {{"smoke", 0}};
  CHECK_FALSE(dimmed(off));
}

TEST_CASE("smoke above everything that people look at is no clear air, and flames still count",
          "[assess]") {
  // A room of 3 m; an eye at 1.65 m and no sign above it. Smoke in the upper half alone.
  SceneDescription scene;
  Object room;
  room.mesh.positions = {{0, 0, 0}, {2, 2, 3}};
  scene.objects = {room};
  EscapeRoute way;
  way.path = {{0.5, 1, 0}, {1.5, 1, 0}};
  scene.routes = {way};
  scene.assessment.eye_heights_m = {1.65};
  Medium smoke, flame;
  smoke.name = "smoke";
  smoke.kind = MediumKind::data_set;
  smoke.optics.extinction.sigma_t = 1;
  smoke.data.nx = smoke.data.ny = 1;
  smoke.data.nz = 3;
  smoke.data.extent = {2, 2, 3};
  smoke.data.extinction = {0, 0, 5};
  flame.name = "fl";
  flame.kind = MediumKind::bounded;
  flame.emission.emplace();
  scene.media = {smoke, flame};
  Scenario off;
  off.emission_factor = 0;
  const AssessedState judged = state_of(scene, off, {});
  CHECK(judged.smoke);
  CHECK(judged.media.at(0).extinction_max == 0);
  const auto warned = [&](const Remark& one) {
    return std::count(judged.warnings.begin(), judged.warnings.end(), one) > 0;
  };
  CHECK(warned(remark(RemarkId::flame_dimmed, 0.0, "fl")));
  CHECK_FALSE(warned(remark(RemarkId::clear_air)));
  AssessmentRecord record;
  record.state.smoke = StateSmokeRecord{{0, 0, stated_nm}, {}, judged.media};
  CHECK(first_sentence(record, "").find("clear air") == std::string::npos);
  CHECK(first_sentence(record, "").find("with smoke, but none in the building between") !=
        std::string::npos);
}

TEST_CASE("the first sentence says what of the smoke lies on lines of sight", "[assess]") {
  AssessmentRecord record;
  record.state.smoke = StateSmokeRecord{{0.2, 3, stated_nm}, {}, {}};
  CHECK(first_sentence(record, "").find("in smoke of 0.2/m to 3/m, by") != std::string::npos);
  record.state.smoke->on_lines = SmokeOnLinesRecord{0.25, 0.5, 7};
  CHECK(first_sentence(record, "").find(
            "in smoke of 0.2/m to 3/m (0.25/m to 0.5/m on lines of sight), by") !=
        std::string::npos);
  record.state.smoke->on_lines = SmokeOnLinesRecord{0.2, 3, 7};
  CHECK(first_sentence(record, "").find("in smoke of 0.2/m to 3/m, by") != std::string::npos);
  record.state.smoke->on_lines = SmokeOnLinesRecord{0, 0, 7};
  CHECK(first_sentence(record, "").find("to 3/m, but none on any line of sight, by") !=
        std::string::npos);
}

TEST_CASE("the smoke of a state is that in the building where people look", "[assess]") {
  // A room of 2 x 2 x 3 m; eyes at 1.2 and 1.65 m, a sign at 2.3 m. Cells of half a metre in z, the
  // first column in the room, the second outside.
  SceneDescription scene;
  Object room;
  room.mesh.positions = {{0, 0, 0}, {2, 2, 3}};
  scene.objects = {room};
  Medium smoke;
  smoke.name = "smoke";
  smoke.kind = MediumKind::data_set;
  smoke.optics.extinction.sigma_t = 1;
  smoke.data.nx = 2;
  smoke.data.ny = 1;
  smoke.data.nz = 6;
  smoke.data.extent = {4, 2, 3};
  for (int k = 0; k < 6; ++k) {
    smoke.data.extinction.push_back(0.1F * static_cast<float>(k + 1));
    smoke.data.extinction.push_back(50);
  }
  scene.media = {smoke};
  const auto range = [&] {
    const AssessedState state = state_of(scene, {}, {});
    return std::pair(state.media.at(0).extinction_min, state.media.at(0).extinction_max);
  };
  // Nobody looks: all of the room.
  CHECK(range().first == Approx(0.1));
  CHECK(range().second == Approx(0.6));
  EscapeRoute way;
  way.path = {{0.5, 1, 0}, {1.5, 1, 0}};
  scene.routes = {way};
  scene.assessment.eye_heights_m = {1.2, 1.65};
  Sign exit;
  exit.frame.origin = {1.9, 1, 2.3};
  scene.signs = {exit};
  CHECK(range().first == Approx(0.3));
  CHECK(range().second == Approx(0.5));
  // Cells of a kilometre: the one in which the room lies.
  scene.media[0].data.extent *= 1000.0;
  CHECK(range().first == Approx(0.1));
  CHECK(range().second == Approx(0.1));
}

}  // namespace luxodus
