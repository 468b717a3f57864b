// Tests suggestions for a building as it is: the contribution of one luminaire, computed by hand,
// and that all demands hold with the suggested ones.
#include "actors/judge/design/suggest.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/assess/assessment.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

const std::string one_lamp = test::box_room(16, 3, 3) + test::judged_2013 + R"(
[[emitter]]
name = "lamp"
shape = "disc"
diameter = 0.1
position = [3, 1.5, 2.97]
flux_lm = 200
emergency = "non-maintained"
emergency_flux = 200
maintenance_factor = 0.8
end_of_duration_factor = 0.7
)" + test::way_along(1, 15, 1.5) +
                             "[design]\nfailure = \"none\"\n";

LayoutOption at_place(uint32_t place, bool fixed) {
  LayoutOption out;
  out.place = place;
  out.fixed = fixed;
  return out;
}

Terms summands(std::vector<Term> list) {
  return std::make_shared<std::vector<Term>>(std::move(list));
}

}  // namespace

TEST_CASE("a place helps by what its best option adds to the missing light", "[design][suggest]") {
  // One option is fixed and gives half of the first row; the second row has nothing.
  LayoutProblem problem;
  problem.options = {at_place(0, true), at_place(1, false), at_place(1, false), at_place(2, false)};
  problem.groups.resize(1);
  problem.covers = {{0, summands({{0, 1}, {1, 5}, {3, 0.5F}}), 2, {}},
                    {0, summands({{2, 1}, {3, 2}}), 4, {}}};
  const auto places = helpful_places(problem, {1, 0, 0, 0});
  REQUIRE(places.size() == 2);
  // Missing: 0.5 and 1. Place 1: the first option gives 0.5 (no more is missing), the second 0.25.
  CHECK(places[0].first == 1);
  CHECK(places[0].second == Approx(0.5 / 1.5));
  // Place 2: 0.25 of the first row and 0.5 of the second.
  CHECK(places[1].first == 2);
  CHECK(places[1].second == Approx(0.75 / 1.5));
  CHECK(helpful_places(problem, {1, 1, 1, 1}).empty());
}

TEST_CASE("with the suggested luminaires the rules hold, and nothing more is suggested",
          "[design][suggest]") {
  const TemporaryFolder folder;
  const auto scene = test::described(folder.write("scene.toml", one_lamp));
  SuggestOptions options;
  options.threads = 2;
  const auto found = suggest(scene, options, test::nobody);
  INFO((found ? "" : found.problem().text()));
  REQUIRE(found);
  CHECK(found->missing > 0);
  CHECK(found->least < 1);
  REQUIRE_FALSE(found->luminaires.empty());
  // Most light is missing at the far end, and a luminaire helps most there.
  const auto best =
      std::max_element(found->helpful.begin(), found->helpful.end(),
                       [](const auto& a, const auto& b) { return a.share < b.share; });
  REQUIRE(best != found->helpful.end());
  CHECK(best->position.x > 6);
  auto more = std::make_shared<SceneDescription>(*scene);
  for (const SuggestedLuminaire& one : found->luminaires) {
    CHECK(one.of == "lamp");
    Emitter copy = scene->emitters.front();
    copy.name = "copy " + std::to_string(more->emitters.size());
    copy.frame = frame_aiming(one.position, one.aim, {0, 0, 1}).value();
    more->emitters.push_back(std::move(copy));
  }
  AssessOptions asked;
  asked.threads = 2;
  asked.reality = false;
  const auto assessed = assess(more, asked, test::nobody, [](const std::string&, double) {});
  REQUIRE(assessed);
  for (const Check& check : assessed->checks)
    if (check.rule.id == RuleId::E1 || check.rule.id == RuleId::E2 || check.rule.id == RuleId::E4)
      CHECK(check.verdict == CheckVerdict::pass);
  const auto again = suggest(more, options, test::nobody);
  REQUIRE(again);
  CHECK(again->luminaires.empty());
  CHECK(again->helpful.empty());
}

TEST_CASE("without a luminaire to copy nothing is suggested, with a reason", "[design][suggest]") {
  std::string dark = one_lamp;
  dark.erase(dark.find("[[emitter]]"), dark.find("[[route]]") - dark.find("[[emitter]]"));
  const TemporaryFolder folder;
  const auto found = suggest(test::described(folder.write("scene.toml", dark)), {}, test::nobody);
  REQUIRE_FALSE(found);
  CHECK(found.problem().what.find("copies could be added") != std::string::npos);
}

}  // namespace luxodus
