// People who are followed with each of several layouts: how long they read no sign, and which
// layout is then recommended.
#include "actors/judge/design/layout_people.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "actors/judge/design/record_design.hpp"
#include "actors/judge/design/smoke_section.hpp"
#include "actors/results/run/open_scene.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/kit/walkers.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"
#include "tests/unit/actors/judge/design/smoke_corridor.hpp"

namespace luxodus {
namespace {

using test::nobody;

const AssessProgress silent = [](const std::string&, double) {};

PeopleQuestion question() {
  PeopleQuestion out;
  out.people = {test::walker_from({1, 0, 0}, {15, 0, 0}, 14),
                test::walker_from({15, 0, 0}, {1, 0, 0}, 14)};  // turns the back to the sign
  out.people.back().id = 2;
  out.scenarios = {"fire"};
  return out;
}

std::shared_ptr<const SceneDescription> corridor(const std::string& smoke) {
  return test::described_text(test::corridor_with(smoke));
}

PeopleUnread unread(const std::shared_ptr<const SceneDescription>& variant,
                    const PeopleQuestion& asked) {
  const auto found = people_unread(variant, asked, nobody, silent);
  INFO((found ? "" : found.problem().text()));
  REQUIRE(found);
  return found.value();
}

JudgedLayout layout_with(const std::string& name, double objective, const PeopleUnread& people) {
  JudgedLayout out;
  out.name = name;
  out.objective = objective;
  out.rounds = 1;
  out.smoke = {{"fire", {}, {0.5, 0.5}}};
  out.people = people;
  return out;
}

}  // namespace

TEST_CASE("a sign is read earlier on the way in thinner smoke, and never behind one's back",
          "[design][walk]") {
  const auto in_smoke = [](const char* extinction) {
    return unread(corridor(test::replaced(test::even_smoke, "0.4", extinction)), question());
  };
  const PeopleUnread dense = in_smoke("3"), thin = in_smoke("0.2");
  INFO(dense.least_s << " to " << dense.most_s << ", " << thin.least_s << " to " << thin.most_s);
  for (const PeopleUnread& one : {dense, thin}) {
    CHECK(one.all_s == 30);
    CHECK(one.least_s >= 15);  // of the person who turns the back
    CHECK(one.most_s >= one.least_s);
  }
  CHECK(dense.surely_more_than(thin));
  CHECK(thin.surely_no_more_than(dense));
}

TEST_CASE("people are followed through the states of a layout, in the worst scenario",
          "[design][walk]") {
  const std::string thickening =
      test::replaced(test::even_smoke, "0.4", "[[0, 0.05], [14, 20]]") +
      "[time]\nfrom = 0\nto = 14\nstep = 7\nmains_fail_at = 0\n"
      "[[scenario]]\nname = \"more\"\noperation = \"emergency\"\nsmoke_factor = 2\n";
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.toml", test::corridor_with(thickening));
  const auto variant = test::described(file);
  PeopleQuestion asked = question();
  std::vector<double> times_s;
  const SceneAtTime read = reader_at_times(*variant, file, FireFrames::nearest);
  asked.scene_at = [&](double at_s) -> Result<std::shared_ptr<const SceneDescription>> {
    times_s.push_back(at_s);
    const auto then = read(at_s);
    if (!then) return then;
    auto out = std::make_shared<SceneDescription>(*then.value());
    out->signs.clear();  // those of the layout count
    return std::shared_ptr<const SceneDescription>(std::move(out));
  };
  const PeopleUnread once = unread(variant, asked);
  CHECK(std::set(times_s.begin(), times_s.end()) == std::set<double>{0, 7, 14});
  CHECK(once.least_s < once.all_s);
  asked.scenarios = {"fire", "more"};
  const PeopleUnread worst = unread(variant, asked);
  CHECK(worst.least_s >= once.least_s);
  CHECK(worst.most_s >= once.most_s);
  CHECK(worst.all_s == once.all_s);
}

TEST_CASE("the layout is recommended with which people are surely sooner at a sign", "[design]") {
  const auto stage_of = [](std::vector<JudgedLayout> layouts) {
    SmokeStage out;
    out.scenarios = {"fire"};
    out.layouts = std::move(layouts);
    return out;
  };
  const JudgedLayout a = layout_with("A", 4, {100, 120, 500});
  CHECK(stage_of({a, layout_with("B", 5, {90, 110, 500})}).recommended().name == "A");
  CHECK(stage_of({a, layout_with("B", 5, {60, 90, 500})}).recommended().name == "B");
  CHECK(stage_of({a, layout_with("B", 3, {60, 100, 500})}).recommended().name == "B");
  const SmokeStage stage = stage_of({a, layout_with("B", 5, {60, 90, 500})});
  for (const auto& [language, words] :
       {std::pair{Language::en, "for 60 to 90 of 500 person-seconds, with layout A for 100 to 120"},
        {Language::de, "60 bis 90 von 500 Personensekunden"},
        {Language::fr, "60 à 90 sur 500 personnes-secondes"}}) {
    std::string said;
    for (const std::string& line : smoke_words(Texts(language), record_of(stage))) said += line;
    CHECK_THAT(said, Catch::Contains(words));
  }
}

}  // namespace luxodus
