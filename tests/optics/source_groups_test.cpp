// Light adds: what a source group gives is the light of that group alone, and the groups together
// are the whole, at probes and at signs as on planes.
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// Two lamps in a smoky room with a sign that an observer and a probe look at.
std::string two_lamps(double left_lm, double right_lm) {
  const auto lamp = [](const char* name, const char* x, double lumens) {
    return std::string("[[emitter]]\nshape = \"rectangle\"\nsize = [0.4, 0.4]\nname = \"") + name +
           "\"\nposition = [" + x +
           ", 2, 2.9]\ndirection = [0, 0, -1]\nspectrum = \"E\"\nflux_lm = " +
           std::to_string(lumens) + "\n";
  };
  std::string text = R"(
title = "Two lamps and a sign in smoke"
[run]
groups = "emitter"
max_bands = 1
voxels = false
eye_path_factor = 15
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"
[[medium]]
name = "smoke"
kind = "homogeneous"
extinction = 0.3
albedo = 0.8
[[sign]]
name = "exit"
text = "EXIT"
width = 0.4
height = 0.2
position = [5.9, 2, 2]
facing = [-1, 0, 0]
mains_white = 300
mains_green = 50
emergency_white = 30
emergency_green = 5
[[observer]]
name = "eye"
eye = [1, 2, 1.6]
target = [5.9, 2, 2]
[[probe]]
name = "floor"
position = [2, 1, 0]
)";
  if (left_lm > 0) text += lamp("left", "1.5", left_lm);
  if (right_lm > 0) text += lamp("right", "4.5", right_lm);
  return text;
}

uint32_t group_named(const CompiledScene& scene, const std::string& name) {
  for (uint32_t g = 0; g < scene.groups.size(); ++g) {
    if (scene.groups[g].name == name) return g;
  }
  FAIL("no group " << name);
  return 0;
}

Estimate of_group(const Run& run, uint32_t block, uint32_t bin, const std::string& group,
                  uint32_t quantity) {
  const auto groups = static_cast<uint32_t>(run.scene().groups.size());
  return run.value(block, bin * groups + group_named(run.scene(), group), quantity);
}

constexpr auto at_eye = static_cast<uint32_t>(EyeQuantity::at_eye);
constexpr auto group_at_eye = static_cast<uint32_t>(GroupEyeQuantity::at_eye);
constexpr auto group_veil = static_cast<uint32_t>(GroupEyeQuantity::path);
constexpr uint32_t white = 0, green = 1, surround = 2;

}  // namespace

TEST_CASE("the source groups' light at probes and signs adds up to the whole") {
  const Run run(scene_from_toml(two_lamps(1000, 2000)), {.particles = 1 << 16});
  const TallyBlocks& b = run.blocks();
  REQUIRE(run.scene().groups.size() == 4);  // two lamps, two colours of the sign
  const auto check_sum = [&](uint32_t whole, uint32_t parts, uint32_t bin, uint32_t quantity,
                             uint32_t part_quantity) {
    double sum = 0;
    for (uint32_t g = 0; g < 4; ++g) sum += run.value(parts, bin * 4 + g, part_quantity).value;
    CHECK(sum > 0);
    CHECK(sum == Approx(run.value(whole, bin, quantity).value).epsilon(1e-9));
  };
  for (const uint32_t quantity : {0u, 1u})
    check_sum(b.probes, b.probes_by_group, 0, quantity, quantity);
  for (const uint32_t part : {white, green, surround})
    check_sum(b.views, b.views_by_group, part, at_eye, group_at_eye);
}

TEST_CASE("a source group's light is what it gives alone") {
  const RunOptions options{.particles = 1 << 20};
  const Run both(scene_from_toml(two_lamps(1000, 2000)), options);
  const Run alone(scene_from_toml(two_lamps(1000, 0)), {.particles = 1 << 20, .seed = 2});
  const TallyBlocks& b = both.blocks();
  const TallyBlocks& a = alone.blocks();
  for (const uint32_t quantity : {0u, 1u}) {
    check_agree(of_group(both, b.probes_by_group, 0, "left", quantity),
                of_group(alone, a.probes_by_group, 0, "left", quantity), 0.015 * root_of_thrift);
  }
  for (const uint32_t part : {white, green, surround}) {
    check_agree(of_group(both, b.views_by_group, part, "left", group_at_eye),
                of_group(alone, a.views_by_group, part, "left", group_at_eye),
                0.02 * root_of_thrift);
  }
  check_agree(of_group(both, b.views_by_group, white, "left", group_veil),
              of_group(alone, a.views_by_group, white, "left", group_veil), 0.02 * root_of_thrift);
}

TEST_CASE("a scene of one source group pays for no second copy of its values") {
  SceneDescription scene = scene_from_toml(two_lamps(1000, 2000));
  scene.run.groups = GroupRule::one;
  const auto compiled = compile(std::move(scene));
  CHECK(compiled->blocks.probes_by_group == none_index);
  CHECK(compiled->blocks.views_by_group == none_index);
}

}  // namespace luxodus::light
