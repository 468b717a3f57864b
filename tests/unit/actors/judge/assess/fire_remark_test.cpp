// Tests the remarks on smoke that a fire simulation has computed.
#include <algorithm>
#include <catch2/catch.hpp>

#include "actors/judge/assess/judged_state.hpp"

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

}  // namespace luxodus
