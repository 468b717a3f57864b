// Tests types whose batteries last as long as the rules require, and the battery class in
// schedules.
#include <catch2/catch.hpp>
#include <set>

#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

std::string type_that_lasts(const char* name, const char* hours, double cost) {
  return fmt::format(
      "[[design.type]]\nname = \"{}\"\nlike = \"{} as built\"\ncost = {}\n"
      "battery = \"self-contained\"\n",
      name, hours, cost);
}

std::string as_built(const char* hours) {
  return fmt::format(R"(
[[emitter]]
name = "{0} as built"
shape = "disc"
diameter = 0.1
position = [1, 1.5, 2.97]
flux_lm = 200
emergency = "non-maintained"
emergency_flux = 200
maintenance_factor = 0.8
end_of_duration_factor = 0.7
duration_h = {0}
)",
                     hours);
}

std::string scene_by(const std::string& assessment) {
  return test::box_room(8, 3, 3) + "[assessment]\n" + assessment +
         "\n[[scenario]]\nname = \"failed\"\noperation = \"emergency\"\n" +
         test::way_along(1, 7, 1.5) + as_built("1") + as_built("1.5") + as_built("3") +
         "[design]\nplace_signs = false\nexisting = \"removed\"\nobjective = \"cost\"\n" +
         type_that_lasts("short", "1", 1) + type_that_lasts("medium", "1.5", 2) +
         type_that_lasts("long", "3", 3);
}

/// The types that a layout contains.
std::set<std::string> used(const SceneDescription& scene, const DesignResult& result) {
  std::set<std::string> out;
  for (const PlacedLuminaire& one : result.luminaires)
    out.insert(scene.design->types[one.candidate.type].name);
  return out;
}

}  // namespace

TEST_CASE("types with a shorter duration than the rules require are not placed, with a reason",
          "[design][battery]") {
  const TemporaryFolder folder;
  struct Case {
    const char *assessment, *used;
    size_t unused;
    double asked_h;
  };
  for (const Case& one :
       {Case{"rules = [\"en1838-2013\"]", "short", 0, 1},
        Case{"rules = [\"nfpa101\"]", "medium", 1, 1.5},
        Case{"rules = [\"en1838-2013\"]\ndeviations = [\"duration-3h\"]", "long", 2, 3},
        Case{"rules = [\"en1838-2013\", \"nfpa101\"]", "medium", 1, 1.5}}) {
    INFO(one.assessment);
    const auto file = folder.write("scene.toml", scene_by(one.assessment));
    const DesignResult result = test::designed(file);
    CHECK(used(*test::described(file), result) == std::set<std::string>{one.used});
    REQUIRE(result.unused.size() == one.unused);
    for (const UnusedType& type : result.unused) {
      CHECK(type.asked_h == Approx(one.asked_h));
      CHECK(unused_words(type).find("lasts") != std::string::npos);
    }
    for (const Check& check : result.assessment.checks)
      if (name_of(check.rule.id).starts_with("E11") || check.rule.id == RuleId::N10)
        CHECK(check.verdict != CheckVerdict::fail);
  }
}

TEST_CASE("a scene in which no type lasts long enough is refused with a message",
          "[design][battery]") {
  std::string text = scene_by("rules = [\"en1838-2013\"]\ndeviations = [\"uk-bs5266-1\"]");
  text.erase(text.find("[[design.type]]\nname = \"long\""));
  const TemporaryFolder folder;
  const auto refused = test::tried(folder.write("scene.toml", text));
  REQUIRE_FALSE(refused);
  CHECK(refused.problem().text().find("no type of luminaire lasts") != std::string::npos);
  CHECK(refused.problem().text().find("3 h") != std::string::npos);
}

TEST_CASE("schedules print battery classes in the notation of luminaire labels",
          "[design][battery]") {
  DesignType type;
  CHECK(battery_class(type).empty());
  type.battery = Battery::self_contained;
  type.emitter.duration_s = 5400;
  CHECK(battery_class(type) == "X 0 90");
  type.battery = Battery::central;
  type.emitter.maintained = true;
  type.emitter.duration_s.reset();
  CHECK(battery_class(type) == "Z 1");
  const TemporaryFolder folder;
  const DesignResult result =
      test::designed(folder.write("scene.toml", scene_by("rules = [\"en1838-2013\"]")));
  CHECK(schedule_csv(result).text().find(",X 0 60,") != std::string::npos);
}

}  // namespace luxodus
