// Light is linear: what an eye and a probe receive grows with the flux of a scene, over all fluxes
// that a scene may have, and so do its errors.
#include "actors/results/run/local_run.hpp"
#include "tests/kit/room_texts.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

const std::string one_band_room = "[run]\nmax_bands = 1\n" + test::white_room("[4, 4, 3]");

/// A room with a lamp, a sign that shows only what falls on it, an eye, and a probe.
std::string room_with(const std::string& flux_lm) {
  return one_band_room + R"(
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [2, 2, 2.5]
flux_lm = )" +
         flux_lm + R"(
[[probe]]
name = "floor"
position = [2, 2, 0.01]
normal = [0, 0, 1]
[[sign]]
name = "board"
text = "EXIT"
letter_height = 0.1
width = 0.4
height = 0.2
position = [3.95, 2, 2]
facing = [-1, 0, 0]
lighting = "external"
[[observer]]
name = "eye"
eye = [1, 2, 1.6]
target = [3.95, 2, 2]
)";
}

struct Seen {
  Estimate probe, sign, transmission;
};

Seen seen_with(const std::string& flux_lm) {
  RunOptions options;
  options.particles = thrift << 14;
  Run run(scene_from_toml(room_with(flux_lm)), options);
  const CompiledScene& scene = run.scene();
  const Readout readout(scene, run.local().totals());
  CHECK(readout.check_range().ok());
  const auto of = [&](EyeQuantity quantity) {
    return readout.value(scene.blocks.views, scene.eye_targets.at(0).first_bin,
                         static_cast<uint32_t>(quantity));
  };
  return {readout.value(scene.blocks.probes, 0, 0), of(EyeQuantity::at_eye),
          of(EyeQuantity::transmission)};
}

void check_times(const Estimate& one, double factor, const Estimate& other) {
  CHECK(other.value == Approx(factor * one.value).epsilon(1e-6));
  CHECK(other.standard_error == Approx(factor * one.standard_error).epsilon(1e-3));
}

}  // namespace

TEST_CASE("light at eyes and probes is linear in the flux, from nanolumens to teralumens",
          "[light]") {
  const Seen usual = seen_with("1000");
  CHECK(usual.probe.standard_error > 0);
  CHECK(usual.transmission.value == 1);
  for (const auto& [flux, factor] :
       {std::pair{"1e-9", 1e-12}, {"1e-3", 1e-6}, {"1e9", 1e6}, {"1e12", 1e9}}) {
    INFO(flux << " lm");
    const Seen other = seen_with(flux);
    check_times(usual.probe, factor, other.probe);
    check_times(usual.sign, factor, other.sign);
    CHECK(other.transmission.value == 1);
  }
}

TEST_CASE("a luminance beyond the range of a scene's flux is an error, not a smaller one",
          "[light]") {
  // A disc of 1 mm beside a sign of 1 cm, so bright that its flux tells little of its luminance.
  const std::string text = one_band_room + R"(
[[emitter]]
name = "disc"
shape = "disc"
position = [3.94, 2, 2.0075]
direction = [-1, 0, 0]
diameter = 0.001
luminance_cd_m2 = 1e12
[[sign]]
name = "spot"
plain = "white"
smallest_detail = 0.001
width = 0.01
height = 0.01
position = [3.95, 2, 2]
facing = [-1, 0, 0]
lighting = "external"
[[observer]]
name = "eye"
eye = [2.95, 2, 2]
target = [3.95, 2, 2]
)";
  RunOptions options;
  options.particles = thrift << 14;
  Run run(scene_from_toml(text), options);
  const Readout readout(run.scene(), run.local().totals());
  const auto checked = readout.check_range();
  REQUIRE_FALSE(checked.ok());
  CHECK(checked.problem().what.find("sign \"spot\" from \"eye\"") != std::string::npos);
  constexpr uint32_t surround = 2;
  const Estimate beyond =
      readout.value(run.scene().blocks.views, run.scene().eye_targets.at(0).first_bin + surround,
                    static_cast<uint32_t>(EyeQuantity::at_eye));
  CHECK(std::isinf(beyond.value));
  CHECK(std::isinf(beyond.standard_error));
}

}  // namespace luxodus::light
