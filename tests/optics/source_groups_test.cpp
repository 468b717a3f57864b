// Light adds: the light of a source group is that of the group alone, and the groups together are
// the whole, at probes and signs as on planes.
#include "actors/results/run/local_run.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// Two lamps in a smoky room, with a sign seen by an observer, and a probe.
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

TEST_CASE("a source group's light is the light it gives alone") {
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

namespace {

/// A run that scores mixtures of its source groups instead of the groups.
struct MixedRun {
  MixedRun(const std::string& text, std::vector<GroupMixture> mixtures, uint64_t seed) {
    CompileOptions options;
    options.mixtures = std::move(mixtures);
    auto scene = std::make_shared<SceneDescription>(scene_from_toml(text));
    scene->run.batch_particles = 1024;
    auto made = compile_scene(std::move(scene), plain(), options);
    REQUIRE(made.ok());
    compiled = std::move(made).value();
    run = std::make_unique<LocalRun>(compiled, seed, 2);
    StopRule stop;
    stop.particles = 256 * 1024;
    run->run(stop, std::atomic<bool>{false}, [](const Progress&) {});
  }

  static Scenario plain() {
    Scenario out;
    out.name = "as written";
    return out;
  }
  Estimate whole(uint32_t part, EyeQuantity quantity) const {
    return Readout(*compiled, run->totals())
        .value(compiled->blocks.views, part, static_cast<uint32_t>(quantity));
  }
  Estimate mixed(uint32_t part, size_t mixture, MixtureEyeQuantity quantity) const {
    const size_t bin = part * compiled->mixtures.size() + mixture;
    return Readout(*compiled, run->totals())
        .value(compiled->blocks.views_by_mixture, static_cast<uint32_t>(bin),
               static_cast<uint32_t>(quantity));
  }

  std::shared_ptr<const CompiledScene> compiled;
  std::unique_ptr<LocalRun> run;
};

}  // namespace

TEST_CASE("a mixture of source groups equals the scene with that light, with its error") {
  // Each lamp alone, both, and both with the second at a quarter.
  const std::vector<GroupMixture> mixtures{
      {{{"right", 0}}}, {{{"left", 0}}}, {}, {{{"right", 0.25}}}};
  const MixedRun all(two_lamps(1000, 2000), mixtures, 1);
  CHECK(all.compiled->blocks.views_by_group == none_index);
  const MixedRun left(two_lamps(1000, 0), {{}}, 2), right(two_lamps(0, 2000), {{}}, 3),
      quarter(two_lamps(1000, 500), {{}}, 4);
  for (const uint32_t part : {white, green, surround}) {
    const auto by_itself = [&](size_t mixture, const MixedRun& alone) {
      const Estimate a = all.mixed(part, mixture, MixtureEyeQuantity::at_eye),
                     b = alone.whole(part, EyeQuantity::at_eye);
      INFO("part " << part << ", mixture " << mixture << ": " << a.value << " +- "
                   << a.standard_error << ", alone " << b.value << " +- " << b.standard_error);
      CHECK(a.standard_error > 0);
      CHECK(std::abs(a.value - b.value) < 4 * std::hypot(a.standard_error, b.standard_error));
    };
    by_itself(0, left);
    by_itself(1, right);
    by_itself(3, quarter);
    // With all factors 1 it is the whole, and so is its error, since groups are correlated.
    const Estimate sum = all.mixed(part, 2, MixtureEyeQuantity::at_eye),
                   whole = all.whole(part, EyeQuantity::at_eye);
    CHECK(sum.value == Approx(whole.value).epsilon(1e-9));
    CHECK(sum.standard_error == Approx(whole.standard_error).epsilon(1e-5));
  }
}

TEST_CASE("paths choose emitters of many mixtures more often than those of few") {
  const std::vector<GroupMixture> mixtures{
      {{{"right", 0}}}, {{{"right", 0}}}, {{{"right", 0}}}, {}};
  const MixedRun all(two_lamps(1000, 1000), mixtures, 1);
  for (const CompiledEmitter& emitter : all.compiled->emitters)
    CHECK(emitter.wanted == Approx(emitter.name == "right" ? 0.5 : 1.0));
}

TEST_CASE("a scene with one source group keeps no second copy of its values") {
  SceneDescription scene = scene_from_toml(two_lamps(1000, 2000));
  scene.run.groups = GroupRule::one;
  const auto compiled = compile(std::move(scene));
  CHECK(compiled->blocks.probes_by_group == none_index);
  CHECK(compiled->blocks.views_by_group == none_index);
}

}  // namespace luxodus::light
