// Values between supports, with their errors; lines to faces.
#include "actors/judge/visibility_map/support_field.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "actors/judge/visibility_map/sight_line.hpp"
#include "actors/judge/visibility_map/traced_views.hpp"
#include "tests/unit/actors/judge/visibility_map/small_smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Supports at 0, 1, 2, ... m along a line, and those next to a place.
std::vector<NearSupport> near_place(double at_m, uint32_t count, int without = -1) {
  std::vector<NearSupport> out;
  for (uint32_t s = 0; s < count; ++s)
    if (static_cast<int>(s) != without && std::abs(s - at_m) < 2.1)
      out.push_back({s, std::abs(s - at_m)});
  return out;
}

SupportField field_of(const std::vector<Uncertain>& values) {
  SupportField out;
  const auto count = static_cast<uint32_t>(values.size());
  for (uint32_t s = 0; s < count; ++s) out.set(s, values[s]);
  for (uint32_t s = 0; s < count; ++s) out.test(s, near_place(s, count, static_cast<int>(s)));
  return out;
}

}  // namespace

TEST_CASE("a value at a support is the support's own", "[judge][visibility_map]") {
  const SupportField field = field_of({{1, 0.1}, {3, 0.1}, {5, 0.1}});
  CHECK(field.at(near_place(1, 3)).value == Approx(3).margin(0.01));
  CHECK(field.at(near_place(1, 3)).noise == Approx(0.1).margin(0.01));
}

TEST_CASE("the bound of a value holds what lies between its supports", "[judge][visibility_map]") {
  const auto curve = [](double x) { return 10 + 3 * x + 2 * std::sin(x); };
  std::vector<Uncertain> values;
  for (int s = 0; s < 7; ++s) values.push_back({curve(s), 0});
  const SupportField field = field_of(values);
  for (double at = 0.1; at < 6; at += 0.2) {
    const Interpolated between = field.at(near_place(at, 7));
    CHECK(std::abs(between.value - curve(at)) <= between.bound);
    CHECK(between.bound < 10);
  }
}

TEST_CASE("noise of supports is no error of interpolation", "[judge][visibility_map]") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.5);
  std::vector<Uncertain> values;
  for (int s = 0; s < 40; ++s) values.push_back({10 + noise(random), 0.5});
  const SupportField field = field_of(values);
  double bounds = 0, noises = 0;
  for (double at = 5.5; at < 35; at += 1) {
    const Interpolated between = field.at(near_place(at, 40));
    bounds += between.bound / 30;
    noises += between.noise / 30;
  }
  CHECK(noises < 0.45);
  CHECK(bounds < 3 * 0.5);
}

TEST_CASE("with one support or none nothing bounds a value", "[judge][visibility_map]") {
  SupportField field;
  CHECK(field.at({}).bound == any_luminance);
  field.set(0, {2, 0});
  const NearSupport one{0, 1};
  CHECK(field.at({&one, 1}).bound == any_luminance);
  CHECK(field.at({&one, 1}).at_worst(4, {}).error == Approx(any_luminance / 4));
}

TEST_CASE("beside a support of which nothing is known nothing bounds a value",
          "[judge][visibility_map]") {
  SupportField field = field_of({{2, 0}, {2, 0}, {2, 0}});
  CHECK(field.at(near_place(0.5, 3)).bound < 1);
  field.lose(2);
  CHECK(field.at(near_place(0.5, 3)).bound == any_luminance);
  CHECK(field.at(near_place(0.5, 2)).bound < 1);
}

TEST_CASE("a line to a face has the light that paths find", "[judge][visibility_map]") {
  const auto scene = described_text(smoky_room("0.5"));
  const auto judged = judged_scene(*scene, judged_scenario(*scene, "").value());
  REQUIRE(judged);
  const auto building = Building::make(judged->scene, judged->scenario, 1);
  REQUIRE(building);
  const CompiledScene& compiled = building.value()->scene();
  const std::vector<FaceOfSign> faces = faces_of(compiled);
  const glm::dvec3 eye(8, 1, 1.65);
  AssessOptions options;
  TracedViews traced(judged.value(), options);
  const size_t view = traced.add(eye, 0, false);
  REQUIRE(traced.trace({view}, 32, nobody_interrupts, say_nothing));
  building.value()->each(1, [&](const GeometryAccess& access, size_t) {
    const SightLine line = sight_line(compiled, access, faces.front(), luminous_shares(compiled),
                                      building.value()->local(eye));
    for (size_t p = 0; p < 2; ++p) {
      const PartLight& part = traced.light(view, 0)[p];
      CHECK(line.own[p] == Approx(part.own.value).epsilon(1e-3));
      CHECK(std::abs(line.passed[p] - part.transmission.value) <
            4 * part.transmission.error + line.passed_error * line.passed[p]);
    }
  });
}
