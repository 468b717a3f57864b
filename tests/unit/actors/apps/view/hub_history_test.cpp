// The hub's history of edits, and its answers to questions about the codes and signs.
#include <catch2/catch.hpp>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/apps/view/hub_kit.hpp"

using namespace luxodus;
using test::Edited;
using test::Remembers;

TEST_CASE("edits are undone and redone for all viewers, and only what differs is traced",
          "[view]") {
  Edited edited;
  const auto steps = [&] { return (*edited.viewer.last("history"))["steps"].size(); };
  const auto done = [&] { return (*edited.viewer.last("history"))["done"]; };
  CHECK(steps() == 0);
  edited.says(R"({"type":"move","kind":"luminaire","name":"left","position":[1,1,1]})");
  CHECK(steps() == 1);
  edited.until_done();
  CHECK(Edited::named(edited.scene()["luminaires"], "left")["position"][2] == 1.0);
  edited.says(R"({"type":"factor","group":"left","factor":0.25})");
  CHECK((*edited.viewer.last("history"))["steps"][1] ==
        Json({{"kind", "factor"}, {"name", "left"}, {"count", 1}, {"value", 0.25}}));
  Remembers late;
  edited.hub.joins(late);
  CHECK((*late.last("history"))["done"] == 2);
  edited.says(R"({"type":"history","done":1})");
  CHECK((*late.last("factors"))["factors"] == Json({{"left", 1.0}}));
  CHECK(done() == 1);
  CHECK(edited.viewer.last("scene") == nullptr);  // dimming is not traced
  edited.says(R"({"type":"history","done":0})");
  edited.until_done();
  CHECK(Edited::named(edited.scene()["luminaires"], "left")["position"][2] != 1.0);
  edited.says(R"({"type":"history","done":2})");
  edited.until_done();
  CHECK(Edited::named(edited.scene()["luminaires"], "left")["position"][2] == 1.0);
  CHECK(edited.group("left")["factor"] == 0.25);
  edited.says(R"({"type":"history","done":3})");
  CHECK(edited.why() == "there are only 2 steps to undo or redo");
  edited.hub.says(late, R"({"type":"history","done":0})");
  CHECK((*late.last("refused"))["why"].get<std::string>().find("somebody else") == 0);
  edited.hub.leaves(late);
}

TEST_CASE("an addition is undone with its light", "[view]") {
  Edited edited;
  edited.says(R"({"type":"add","kind":"luminaire","of":"left","position":[1,1,1]})");
  edited.until_done();
  REQUIRE(edited.scene()["luminaires"].size() == 3);
  edited.says(R"({"type":"factor","group":"left copy","factor":0.5})");
  edited.says(R"({"type":"history","done":0})");
  edited.until_done();
  CHECK(edited.scene()["luminaires"].size() == 2);
  edited.says(R"({"type":"history","done":1})");
  edited.until_done();
  CHECK(edited.group("left copy")["factor"] == 1.0);
}

TEST_CASE("checks that cannot be made are refused with the reason, in their own place", "[view]") {
  Edited edited;
  edited.says(R"({"type":"checks"})");
  edited.posts.until([&] { return edited.viewer.last("refused") != nullptr; });
  CHECK((*edited.viewer.last("refused"))["checks"] == true);
  CHECK(edited.why().find("there is nothing to check: add [[route]]") == 0);
}

TEST_CASE("provisional verdicts on a sign come before the sure ones", "[view]") {
  const test::TemporaryFolder folder;
  Edited edited(test::described(folder.write("room.toml", test::live_room + R"(
[[observer]]
name = "west"
eye = [1, 2, 1.6]
gaze = [1, 0, 0]
)")));
  const Json sure = edited.verdicts_on("exit");
  std::vector<bool> provisional;
  for (const Json& text : edited.viewer.texts)
    if (text["type"] == "sign") provisional.push_back(text["provisional"].get<bool>());
  CHECK(provisional == std::vector<bool>{true, false});
  REQUIRE(sure["rows"].size() == 1);
  CHECK(sure["rows"][0]["verdict"] == "legible");
}

TEST_CASE("a dragged slider is one step, and each change of it is told in short", "[view]") {
  Edited edited;
  edited.says(R"({"type":"factor","group":"left","factor":0.25})");
  CHECK((*edited.viewer.last("history"))["steps"].size() == 1);
  edited.says(R"({"type":"factor","group":"left","factor":0.5})");
  CHECK(edited.viewer.last("history") == nullptr);
  CHECK((*edited.viewer.last("step"))["last"]["value"] == 0.5);
  edited.says(R"({"type":"history","done":0})");
  CHECK((*edited.viewer.last("factors"))["factors"] == Json({{"left", 1.0}}));
}
