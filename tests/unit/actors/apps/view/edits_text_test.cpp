#include "actors/apps/view/edits_text.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace luxodus;

TEST_CASE("scene edits are unchanged after their way to a node", "[view]") {
  SceneEdits edits;
  edits.scenario = "smoke \"emergency\"";
  edits.smoke = 1.0 / 3;
  edits.signs["exit é"] = {{0.1, -2e-300, 3}, glm::dvec3(0, 1.0 / 7, 1)};
  edits.luminaires["lamp"] = {{1e6 + 1e-6, 0, 0}, std::nullopt};
  edits.added = {{true, "exit é", "exit é copy"}, {false, "lamp", "lamp copy"},
                 {false, "downlight", "downlight 2", true}};
  edits.at_s = 100.0 / 3;
  const std::string text = edits_text(edits);
  const auto parsed = parse_edits(text);
  REQUIRE(parsed.ok());
  const SceneEdits& read = parsed.value();
  CHECK(read.scenario == edits.scenario);
  CHECK(read.smoke == edits.smoke);
  CHECK(read.signs.at("exit é").position == edits.signs["exit é"].position);
  CHECK(read.signs.at("exit é").facing == edits.signs["exit é"].facing);
  CHECK(read.luminaires.at("lamp").position == edits.luminaires["lamp"].position);
  CHECK_FALSE(read.luminaires.at("lamp").facing);
  CHECK(read.at_s == edits.at_s);
  REQUIRE(read.added.size() == 3);
  CHECK(read.added[0].is_sign);
  CHECK(read.added[1].of == "lamp");
  CHECK(read.added[1].name == "lamp copy");
  CHECK(read.added == edits.added);
  CHECK(edits_text(read) == text);
}

TEST_CASE("malformed text of edits is refused with a reason", "[view][failure]") {
  for (const char* text :
       {"", "[]", "{", "{\"scenario\":1}", "null",
        R"({"scenario":"","smoke":"thick","signs":{},"luminaires":{},"added":[]})",
        R"({"scenario":"","smoke":1,"signs":{"a":{}},"luminaires":{},"added":[]})",
        R"({"scenario":"","smoke":1,"signs":[1],"luminaires":{},"added":[]})",
        R"({"scenario":"","smoke":1,"signs":{"a":{"position":[1,2]}},"luminaires":{},"added":[]})",
        R"({"scenario":"","smoke":1,"signs":{},"luminaires":{},"added":[{"of":"a"}]})",
        R"({"scenario":"","smoke":1,"signs":{},"luminaires":{},"added":[]})",
        R"({"scenario":"","smoke":1,"signs":{},"luminaires":{},"added":[],"at_s":"now"})"}) {
    INFO(text);
    const auto read = parse_edits(text);
    REQUIRE_FALSE(read.ok());
    CHECK_FALSE(read.problem().what.empty());
  }
  CHECK_FALSE(parse_edits(std::string(limits::edits_bytes + 1, ' ')).ok());
}
