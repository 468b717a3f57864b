// The record of a design: its bytes are pinned, and it is read back whole.
#include "actors/judge/design/design_record.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace luxodus;

namespace {

const Subject way{SubjectKind::route, "way"};

SmokeRecord smoke() {
  SmokeRecord out;
  out.scenarios = {"fire"};
  out.heights_m = {1.65};
  out.end = RaceEnd::time;
  out.recommended = "A";
  SmokeLayoutRecord& layout = out.layouts.emplace_back();
  layout.name = "A";
  layout.guided = {30, 60, true, {{"way", 1.65, 30, {}}}};
  layout.people = {60, 90, 500};
  layout.worst = {0.5, 0.75};
  layout.scenarios = {{"fire", {0.5, 0.75}, {-0.1, 0.1}, {{{0.5, 0.75}, 1.65}}}};
  return out;
}

/// A record in which every list has an item and every optional value is there.
DesignRecord full() {
  DesignRecord d;
  d.program = "luxodus 1";
  d.scene = {"hall", "Hall"};
  d.outcome = {LayoutEnd::within_gap, "2 luminaires"};
  d.objective = {"number", 2, 1, 0.5, 3};
  d.settings = {1.25, "full", 0.5, {"en1838-2024"}};
  d.candidates = {10, 20, 30, {}};
  d.candidates.left_out.no_wall = 4;
  d.hidden_by_furniture = {{"E6", way, 2}};
  d.types_not_placed = {{"lamp", "EN 1838:2024", 1, 3}};
  d.unlit_flights = {"stairs"};
  d.luminaires = {{"lamp 1", "lamp", true, {}, {1, 2, 3}, "ceiling", 90},
                  {"lamp 2", "", false, {{0, 0, 3}}, {1, 2, 3}, "", 0}};
  d.removed = {"old lamp"};
  d.types = {{"lamp", 1, 100, 3, "1 h", 200}};
  d.constraints = {{DemandKind::stairs, RuleId::E1, way, 1, "at least 1 lx", std::nan(""), 0.5}};
  d.because = {{1, 1, 1, true, 0, {}}, {1, 1, 1, false, {}, "lamp 1"}, {1, 1, 1, false, {}, {}}};
  d.checks = {.pass = 4, .fail = 3, .not_assessed = 2, .not_verified = 1};
  d.failing_otherwise = {{RuleId::S4, way, {remark(RemarkId::no_sign_ahead)}}};
  d.refined = {2, 1, 1.5};
  d.off_place = {0.25, true, {{DemandKind::minimum, RuleId::E1, way, 1.5, {1, 2, 0}}}};
  d.signs.emplace();
  d.signs->placed = {{"exit", "sign", true, "wall", {1, 2, 3}, {1, 0, 0}, {{"way", "left"}}}};
  d.signs->removed = {"old sign"};
  d.signs->types = {{"sign", 1, 50, 2}};
  d.signs->unguided = {{"way", 1, 9, true, false, {1, 2, 0}}};
  d.smoke = smoke();
  return d;
}

std::string text_at(const Json& json, const char* path) {
  const Json* const found = json.at_path(path);
  return found == nullptr ? "nothing" : found->dump();
}

}  // namespace

TEST_CASE("the record of a design is read back as it was written", "[design][record]") {
  const Json json = design_json(full());
  const auto read = design_of(json);
  INFO((read ? "" : read.problem().what));
  REQUIRE(read);
  CHECK(design_json(read.value()).dump(1) == json.dump(1));
  CHECK(read->constraints[0].kind == DemandKind::stairs);
  CHECK(read->because[1].luminaire == "lamp 1");
  Json cut = json;
  cut["smoke"]["layouts"][0].erase("worst");
  CHECK(design_of(cut).problem().what == "smoke.layouts[0] has no \"worst\"");
  CHECK_FALSE(design_of(Json::object()));
}

TEST_CASE("keys, forms and their order in design.json stay as they are", "[design][record]") {
  const Json json = design_json(full());
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += (keys.empty() ? "" : " ") + key;
  CHECK(keys ==
        "format program scene outcome objective settings candidates "
        "hidden_by_furniture "
        "types_not_placed unlit_flights luminaires removed types constraints "
        "because checks "
        "failing_otherwise refined between_points off_place signs smoke");
  CHECK(text_at(json, "outcome") == R"({"end":"within the gap","words":"2 luminaires"})");
  CHECK(text_at(json, "candidates/left_out") ==
        R"({"no_ceiling":0,"in_bodies":0,"near_walls":0,"near_signs":0,"keep_out":0,"too_low":0,)"
        R"("glaring":0,"no_wall":4})");
  CHECK(text_at(json, "luminaires/0/moved_from") == "null");
  CHECK(text_at(json, "luminaires/1/moved_from") == "[0.0,0.0,3.0]");
  CHECK(text_at(json, "constraints/0/kind") == R"("flight")");
  CHECK(text_at(json, "constraints/0/least_share") == "null");
  CHECK(text_at(json, "because/0") ==
        R"({"what":"constraint","saved":1.0,"objective_without":1.0,"fewer_luminaires":1,)"
        R"("exact":true,"constraint":0})");
  CHECK(text_at(json, "because/1/what") == R"("failure")");
  CHECK(text_at(json, "because/2/what") == R"("failures")");
  CHECK(text_at(json, "between_points") == R"({"added":0,"least":null})");
  CHECK(text_at(json, "smoke/end") == R"("time")");
  CHECK(text_at(json, "smoke/layouts/0/guided") ==
        R"({"until_least_s":30.0,"until_most_s":60.0,"never_lost":true,"routes":[{"route":"way",)"
        R"("height_m":1.65,"until_least_s":30.0,"until_most_s":null}]})");
  CHECK(text_at(json, "smoke/layouts/0/scenarios/0/by_height/0") ==
        R"({"least":0.5,"most":0.75,"height_m":1.65})");
}
