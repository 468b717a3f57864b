// Tests layouts whose luminaires are mounted off their places: the minima of the rules hold in an
// assessment of the displaced scene.
#include "actors/judge/design/place_tolerance.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <set>

#include "runtime/core/random.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

DesignResult corridor(const TemporaryFolder& folder, double length, double margin,
                      double tolerance_m) {
  return test::designed(folder.write(
      "scene.toml", test::box_room(length, 2.4, 2.8) + test::judged_2013 +
                        test::way_along(1, length - 1, 1.2, 1.4) +
                        fmt::format("[design]\nspacing_m = 0.7\nplace_signs = false\nfailure = "
                                    "\"none\"\nmargin = {}\nplace_tolerance_m = {}\n",
                                    margin, tolerance_m)));
}

/// Minima of the rules that fail if each luminaire is this far off, in a random direction.
std::set<std::string> failing_off_place(const DesignResult& result, double off_m, Random& random) {
  auto moved = std::make_shared<SceneDescription>(*result.variant);
  for (Emitter& e : moved->emitters) {
    const double azimuth = 2 * std::numbers::pi * random.uniform_double();
    e.frame.origin += off_m * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0);
  }
  AssessOptions options;
  options.threads = 2;
  options.reality = false;
  const auto assessed = assess(moved, options, test::nobody, [](const std::string&, double) {});
  REQUIRE(assessed);
  const std::set<std::string> minima{"E1", "E2", "E5", "E6", "E7", "N1m", "N2m"};
  std::set<std::string> out;
  for (const Check& check : assessed->checks)
    if (check.verdict == CheckVerdict::fail && minima.contains(std::string(name_of(check.rule.id))))
      out.emplace(name_of(check.rule.id));
  return out;
}

}  // namespace

TEST_CASE("minima hold with every luminaire off its place in any direction",
          "[design][tolerance]") {
  Random random(22, RandomStream::test, 3);
  random.start(0);
  for (const double length : {9.0, 14.5, 21.0}) {
    INFO("length " << length);
    const TemporaryFolder folder;
    const DesignResult result = corridor(folder, length, 1, 0.25);
    REQUIRE(result.tolerance);
    REQUIRE(result.tolerance->holds());
    CHECK(result.tolerance->least() >= 1 - 1e-6);
    for (int i = 0; i < 5; ++i) CHECK(failing_off_place(result, 0.25, random).empty());
  }
}

TEST_CASE("a layout with a place tolerance needs at least as many luminaires as one without",
          "[design][tolerance]") {
  size_t more = 0;
  for (const double length : {8.0, 11.0, 14.0, 17.0, 20.0}) {
    const TemporaryFolder folder;
    const DesignResult exact = corridor(folder, length, 1, 0);
    const DesignResult robust = corridor(folder, length, 1, 0.25);
    CHECK(exact.tolerance->demands.empty());
    CHECK(robust.answer.objective >= exact.answer.objective);
    CHECK(robust.answer.bound <= robust.answer.objective + 1e-9);
    CHECK(robust.answer.bound >= exact.answer.bound - 1e-9);
    more += robust.answer.objective > exact.answer.objective;
  }
  CHECK(more < 5);
}

TEST_CASE("illuminance with luminaires off their places is not below the reported least share",
          "[design][tolerance]") {
  const TemporaryFolder folder;
  const DesignResult result = corridor(folder, 14, 1.25, 0.25);
  REQUIRE(result.tolerance);
  const double least = result.tolerance->least();
  Random random(5, RandomStream::test, 4);
  random.start(0);
  AssessOptions options;
  options.threads = 2;
  options.reality = false;
  for (int i = 0; i < 5; ++i) {
    auto moved = std::make_shared<SceneDescription>(*result.variant);
    for (Emitter& e : moved->emitters) {
      const double azimuth = std::numbers::pi / 4 * std::floor(8 * random.uniform_double());
      e.frame.origin += 0.25 * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0);
    }
    const auto assessed = assess(moved, options, test::nobody, [](const std::string&, double) {});
    REQUIRE(assessed);
    for (const Check& check : assessed->checks)
      if ((check.rule.id == RuleId::E1 || check.rule.id == RuleId::E2) && check.value)
        CHECK(*check.value >= least * *check.limit * (1 - 1e-4));
  }
}

}  // namespace luxodus
