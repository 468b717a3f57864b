// Signs of several colours: each colour gives its own light, and legend and ground are seen with
// their own luminances.
#include <numbers>

#include "actors/results/run/local_run.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// A sign of 0.4 x 0.2 m in a black room, a quarter of it red, a half white, a quarter blue.
SceneDescription three_colours() {
  SceneDescription scene = scene_from_toml(R"(
title = "A sign of three colours in a black room"
[run]
max_bands = 6
voxels = false
eye_path_factor = 15
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "black0"
[[sign]]
name = "exit"
text = "EXIT"
legend = "red"
ground = "white"
width = 0.4
height = 0.2
position = [5.9, 2, 2]
facing = [-1, 0, 0]
[[sign.colours]]
name = "white"
mains = 40
emergency = 4
[[sign.colours]]
name = "blue"
mains = 20
emergency = 2
spectrum = "led blue"
[[sign.colours]]
name = "red"
mains = 100
emergency = 10
spectrum = "led red"
[[observer]]
name = "eye"
eye = [1, 2, 1.6]
target = [5.9, 2, 2]
)");
  SignFace& face = scene.signs.at(0).face;
  face.width = 4;
  face.height = 1;
  face.colour = {2, 0, 0, 1};
  return scene;
}

double luminance_of_part(const Run& run, uint32_t part) {
  const uint32_t bin = run.scene().eye_targets.at(0).first_bin + part;
  return run.value(run.scene().blocks.views, bin, static_cast<uint32_t>(EyeQuantity::at_eye)).value;
}

}  // namespace

TEST_CASE("each colour of a sign is an emitter with the flux of its luminance and area",
          "[optics][signs]") {
  const Run run(three_colours(), {.particles = 1 << 14});
  const auto& emitters = run.scene().emitters;
  REQUIRE(emitters.size() == 3);
  const double texel_m2 = 0.4 * 0.2 / 4;
  CHECK(emitters[0].name == "exit white");
  CHECK(emitters[0].luminous_flux_lm == Approx(std::numbers::pi * 40 * 2 * texel_m2));
  CHECK(emitters[1].name == "exit blue");
  CHECK(emitters[1].luminous_flux_lm == Approx(std::numbers::pi * 20 * texel_m2));
  CHECK(emitters[2].name == "exit red");
  CHECK(emitters[2].luminous_flux_lm == Approx(std::numbers::pi * 100 * texel_m2));
}

TEST_CASE("an eye sees legend and ground with the luminances of their colours", "[optics][signs]") {
  const Run run(three_colours(), {.particles = 1 << 14});
  // The parts stand in the order of the sign's colours: white, then red.
  CHECK(luminance_of_part(run, 0) == Approx(40).epsilon(1e-4));
  CHECK(luminance_of_part(run, 1) == Approx(100).epsilon(1e-4));
  CHECK(luminance_of_part(run, 2) == Approx(0).margin(1e-3));
}

}  // namespace luxodus::light
