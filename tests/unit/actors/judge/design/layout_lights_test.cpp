// Tests layouts as sums of the light of their luminaires: a view in the sum agrees with a view in a
// trace of the layout alone.
#include "actors/judge/design/layout_lights.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <set>

#include "actors/judge/design/layout_groups.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"
#include "tests/unit/actors/judge/design/smoke_corridor.hpp"

namespace luxodus {
namespace {

using test::corridor_layout;
using test::nobody;

const auto unheard = [](const std::string&, double) {};

std::shared_ptr<const SceneDescription> smoky_corridor() {
  return test::described_text(test::corridor_with(test::even_smoke));
}

std::vector<LayoutLight> lights_of(const std::vector<JudgedLayout>& layouts) {
  std::vector<LayoutLight> out;
  for (const JudgedLayout& one : layouts) out.push_back({&one.layout, one.sign_factor});
  return out;
}

/// A layout, one that shares a luminaire with it, and the first with brighter signs.
std::vector<JudgedLayout> three_layouts(const std::shared_ptr<const SceneDescription>& scene) {
  std::vector<JudgedLayout> out{corridor_layout(scene, "A", {3, 8, 13}),
                                corridor_layout(scene, "B", {3, 10.5}),
                                corridor_layout(scene, "A+", {3, 8, 13})};
  out.back().sign_factor = brighter_signs;
  auto bright = std::make_shared<SceneDescription>(*out.back().layout.variant);
  scale_luminances(bright->signs.front(), brighter_signs);
  out.back().layout.variant = bright;
  return out;
}

/// Adds the existing luminaire "old" to a layout, moved or at its place.
void take_old(JudgedLayout& layout, std::optional<double> to_x, const std::string& body = "") {
  auto variant = std::make_shared<SceneDescription>(*layout.layout.variant);
  Emitter old = test::corridor_luminaire("old", to_x.value_or(5.5));
  old.body_material = body;
  variant->emitters.push_back(old);
  layout.layout.variant = variant;
  PlacedLuminaire one;
  one.name = one.candidate.name = "old";
  one.candidate.position = old.frame.origin;
  one.candidate.moved = to_x.has_value();
  if (to_x) one.moved_from = test::corridor_luminaire("old", 5.5).frame.origin;
  layout.layout.luminaires.push_back(one);
}

/// Three layouts with a new luminaire at 3 m, and an existing luminaire that two of them move.
std::vector<JudgedLayout> moving_layouts(const std::shared_ptr<const SceneDescription>& scene,
                                         const std::string& body = "") {
  std::vector<JudgedLayout> out{corridor_layout(scene, "A", {3}), corridor_layout(scene, "B", {3}),
                                corridor_layout(scene, "C", {3})};
  take_old(out[0], 13, body);
  take_old(out[1], 9, body);
  take_old(out[2], {}, body);
  return out;
}

/// All views of a heat's layouts after one round with 128 paths per part and batch.
std::unique_ptr<LayoutGroupState> traced(const LayoutGroup& group, uint64_t seed) {
  AssessOptions asked;
  asked.threads = 2;
  asked.seed = seed;
  auto state = LayoutGroupState::make(*group.lights, *group.base,
                                      find_scenario(*group.base, "fire").value(), asked, unheard);
  REQUIRE(state.ok());
  const std::vector<bool> all(group.members.size(), true);
  REQUIRE(state.value()->sights().trace(2, all, nobody, unheard).ok());
  return std::move(state).value();
}

}  // namespace

TEST_CASE("luminaires of several layouts are in the scene once, and each layout uses its own",
          "[design]") {
  const auto scene = smoky_corridor();
  const auto layouts = three_layouts(scene);
  const LayoutLights lights(lights_of(layouts));
  CHECK(lights.emitters() == 4);  // at 3, 8, 13 and 10.5 m
  CHECK(lights.can_add());
  const auto judged = lights.judged(*scene, find_scenario(*scene, "fire").value(), {});
  REQUIRE(judged.ok());
  REQUIRE(judged->lights.size() == 3);
  // Luminaires at 8 and 13 m belong to the same layouts: one group.
  const auto& emitters = judged->scene.emitters;
  REQUIRE(emitters.size() == 4);
  CHECK(emitters[1].group == emitters[2].group);
  CHECK(emitters[0].group != emitters[1].group);
  CHECK(emitters[3].group != emitters[0].group);
  const auto factor = [&](size_t light, size_t emitter) {
    return judged->lights[light].aged.factor_of(emitters[emitter].group);
  };
  for (size_t emitter = 0; emitter < 4; ++emitter) {
    CHECK(factor(0, emitter) == (emitter < 3 ? 1 : 0));
    CHECK(factor(1, emitter) == (emitter == 0 || emitter == 3 ? 1 : 0));
    CHECK(factor(2, emitter) == factor(0, emitter));
    const double as_new = judged->lights[0].as_new.factor_of(emitters[emitter].group);
    CHECK(as_new == Approx(factor(0, emitter) / (0.8 * 0.7)));
  }
  const std::string& signs = judged->scene.signs.front().group;
  CHECK(judged->lights[0].aged.factor_of(signs) == 1);
  CHECK(judged->lights[2].aged.factor_of(signs) == brighter_signs);
}

TEST_CASE("light is not added if bodies of luminaires block light of other layouts", "[design]") {
  const auto scene = smoky_corridor();
  auto layouts = three_layouts(scene);
  const auto with_body = [](JudgedLayout& one, size_t emitter) {
    auto variant = std::make_shared<SceneDescription>(*one.layout.variant);
    variant->emitters[emitter].body_material = "grey50";
    one.layout.variant = variant;
  };
  for (JudgedLayout& one : layouts) with_body(one, 0);  // at 3 m, in all layouts
  CHECK(LayoutLights(lights_of(layouts)).can_add());
  CHECK(layout_groups_of(layouts, 1, true).size() == 1);
  with_body(layouts[1], 1);  // at 10.5 m, in one layout
  CHECK_FALSE(LayoutLights(lights_of(layouts)).can_add());
  const auto groups = layout_groups_of(layouts, 1, true);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].members == std::vector<size_t>{0, 2});
  CHECK(groups[1].members == std::vector<size_t>{1});
}

TEST_CASE("a luminaire that layouts move is a separate luminaire at each of its places",
          "[design]") {
  const auto scene = smoky_corridor();
  const auto layouts = moving_layouts(scene);
  const LayoutLights lights(lights_of(layouts));
  CHECK(lights.emitters() == 4);  // at 3 m, and "old" at 13, 9 and 5.5 m
  CHECK(lights.varying() == 3);
  CHECK(lights.can_add());
  const auto judged = lights.judged(*scene, find_scenario(*scene, "fire").value(), {});
  REQUIRE(judged.ok());
  std::set<std::string> names, groups;
  for (const Emitter& one : judged->scene.emitters) {
    names.insert(one.name);
    groups.insert(one.group);
  }
  CHECK(names.size() == 4);
  CHECK(names.contains("old"));
  CHECK(groups.size() == 4);
  // A body that moves no longer blocks light where it was.
  const auto bodies = moving_layouts(scene, "grey50");
  CHECK_FALSE(LayoutLights(lights_of(bodies)).can_add());
  CHECK(layout_groups_of(bodies, 1, true).size() == 3);
}

TEST_CASE("layouts share paths up to a number of luminaires that only some of them have",
          "[design]") {
  const auto scene = smoky_corridor();
  std::vector<JudgedLayout> layouts;
  for (size_t i = 0; i < 5; ++i) {
    std::vector<double> places;
    for (size_t k = 0; k < 60; ++k)
      places.push_back(0.5 + 0.25 * static_cast<double>(k) + 0.01 * static_cast<double>(i));
    layouts.push_back(corridor_layout(scene, std::string(1, static_cast<char>('A' + i)), places));
  }
  const auto groups = layout_groups_of(layouts, 1, true);  // 60 in each, 180 in three, 240 in four
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].members == std::vector<size_t>{0, 1, 2});
  CHECK(groups[1].members == std::vector<size_t>{3, 4});
  CHECK(groups[0].lights->varying() == 180);
}

TEST_CASE("layouts share paths up to a number of views over all scenarios", "[design]") {
  const auto layouts = three_layouts(smoky_corridor());
  CHECK(layout_groups_of(layouts, 2, true).size() == 1);
  CHECK(layout_groups_of(layouts, limits::layout_group_views, true).size() == 3);
}

TEST_CASE("layouts with other signs are traced separately", "[design]") {
  const auto scene = smoky_corridor();
  auto layouts = three_layouts(scene);
  layouts.push_back(layouts.front());
  layouts.back().low_signs = {{"exit", {}}};
  const auto groups = layout_groups_of(layouts, 1, true);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].members == std::vector<size_t>{0, 1, 2});
  CHECK(groups[1].members == std::vector<size_t>{3});
  CHECK(layout_groups_of(layouts, 1, false).size() == 4);
}

TEST_CASE("a view of a layout in the sum agrees with the trace of the layout alone", "[design]") {
  const bool moving = GENERATE(false, true);
  const auto layouts = moving ? moving_layouts(smoky_corridor()) : three_layouts(smoky_corridor());
  const auto together = layout_groups_of(layouts, 1, true),
             alone = layout_groups_of(layouts, 1, false);
  REQUIRE(together.size() == 1);
  REQUIRE(alone.size() == 3);
  const auto sums = traced(together.front(), 1);
  size_t compared = 0, far = 0;
  for (size_t i = 0; i < layouts.size(); ++i) {
    const auto own = traced(alone[i], 100 + i);
    const auto &a = sums->sights().rows(i), &b = own->sights().rows(0);
    REQUIRE(a.size() == b.size());
    for (size_t k = 0; k < a.size(); ++k) {
      CHECK(a[k].look.veil_cd_m2 == Approx(b[k].look.veil_cd_m2).epsilon(1e-4));
      CHECK(a[k].look.transmission == Approx(b[k].look.transmission).epsilon(1e-3));
      CHECK(a[k].look.difference.value == Approx(b[k].look.difference.value).epsilon(0.05));
      for (const auto quantity : {&SignLook::legend, &SignLook::ground, &SignLook::surround}) {
        const Uncertain &x = a[k].look.*quantity, &y = b[k].look.*quantity;
        const double error = std::hypot(x.error, y.error);
        INFO(layouts[i].name << " from " << a[k].along_m << " m: " << x.value << " +- " << x.error
                             << ", alone " << y.value << " +- " << y.error);
        CHECK(std::abs(x.value - y.value) < 4.5 * error);
        CHECK(error < 0.25 * y.value);
        far += std::abs(x.value - y.value) > 2 * error;
        ++compared;
      }
    }
  }
  // 5 % lie beyond two standard errors; parts of a sign share no paths.
  REQUIRE(compared >= 60);
  CHECK(far <= compared / 6);
}

}  // namespace luxodus
