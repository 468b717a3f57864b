// The record of an assessment: its bytes are pinned, it is read back whole, and faults are named.
#include "actors/judge/record/assessment_record.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace luxodus;

namespace {

LookRecord look() {
  LookRecord out;
  out.legend_cd_m2 = {2, 0.5};
  out.transmission = 0.5;
  out.seeing_level = {std::nan(""), std::nan("")};
  return out;
}

SightRecord sight() {
  SightRecord out;
  out.from = {SubjectKind::route, "way"};
  out.stands_for = {1, "m"};
  out.eye = {1, 2, 3};
  out.sign = "exit";
  out.verdict = SightVerdict::visible;
  out.reason = remark(RemarkId::irritant_smoke);
  out.from_gaze_deg = std::nan("");
  out.line_of_sight.visible_within_m = std::nan("");
  const ExperimentsRecord experiments{{MeanObserver::not_known, Untested::age},
                                      {MeanObserver::between, Untested::nothing}};
  out.seen = {true,        look(),    0.25,       {0.5, 4, 12}, {0.5, 2},
              experiments, {8, true}, {9, false}, {},           {}};
  out.seen->other_eyes = {{"protan", SightVerdict::invisible, {}, {0.5, 0.25}}};
  out.seen->other_light = {false, SightVerdict::legible, {}, look()};
  return out;
}

CheckRecord check() {
  CheckRecord out;
  out.rule = {"en1838-2013",
              "de-asr-a3.4-3",
              RuleId::E1,
              "EN 1838:2013",
              "4.2.1",
              {remark(RemarkId::source_bsi)},
              {}};
  out.subject = {SubjectKind::emphasis, "door", EmphasisKind::exit_door};
  out.conditions = {remark(RemarkId::points_in_bodies, 3, 40)};
  out.value = 2;
  out.limit = 1;
  out.unit = "lx";
  out.worst = {1, 2, 0};
  out.verdict = CheckVerdict::pass;
  return out;
}

OverTime over_time() {
  OverTime out;
  out.states = {{0, Operation::mains, {}, 3, {}},
                {30, Operation::emergency, 30, 1, {{"fire", 29}}}};
  RouteOverTime& route = out.routes.emplace_back();
  route.route = "way";
  route.guided = {4,
                  {0, 30},
                  {0, 2},
                  {{Guidance::guided, Guidance::guided}, {Guidance::guided, Guidance::undecided}}};
  route.by_jin = route.by_line = route.by_fds = route.guided;
  route.visibility_m = {{30.0, std::nullopt}, {12.5, 3.0}};
  route.signs = {{"exit", "exit"}, {"exit", ""}};
  route.walks = {{0, GuidedWalk::End::lost, 2, 30}};
  out.walking_speed_m_s = 1;
  out.holds_for = {0.1, 0.5, 0.2};
  return out;
}

/// A record in which every list has an item and every optional value is there.
AssessmentRecord full() {
  AssessmentRecord a;
  a.version = "1";
  a.scene = {"hall", "Hall", "hall.toml", "0123456789abcdef", "failed"};
  a.state.operation = Operation::emergency;
  a.state.seconds_after_failure = 60;
  a.state.luminaires = {1, 2, {"lamp"}};
  a.state.equivalent_background_cd_m2 = 0.001;
  a.state.smoke = StateSmokeRecord{{0.1, 0.2, 633},
                                   SmokeOnLinesRecord{0.12, 0.18, 3},
                                   {{"smoke", "layered", "hall.toml:3", {}, 0.1, 0.2}}};
  a.state.rules = {{"en1838-2013", "", "EN 1838:2013", remark(RemarkId::asks_european), "BSI",
                    remark(RemarkId::superseded)}};
  a.state.deviations = {{"de-asr-a3.4-3",
                         "en1838-2013",
                         "ASR A3.4/3",
                         remark(RemarkId::asks_fifteen_seconds),
                         "BAuA",
                         {}}};
  a.state.remarks = {remark(RemarkId::young_eyes, 20)};
  a.verdict = {"first", "no check made fails", {1, 0, 0, 0}};
  a.not_assessed = {{RuleId::E8, "EN 1838:2013", false, {remark(RemarkId::no_value)}, 2}};
  a.people = {40, 0.5, 100, true, true, {"protan"}};
  a.method = {7, 1000, 0.5, 0.01, 5};
  a.sight_counts = {{"visible but not legible", 1}};
  a.checks = {check()};
  a.sights = {sight()};
  a.sweep = {{0.5, "exit", 3, 2, 1}};
  ThresholdRecord& threshold = a.thresholds.emplace_back();
  threshold.sought = Sought::distance;
  threshold.from = {SubjectKind::route, "way"};
  threshold.sign = "exit";
  threshold.read = true;
  threshold.end = ThresholdEnd::found;
  threshold.at = {2.5, 0.25};
  threshold.above = true;
  threshold.amounts_to = {6.5, "m"};
  a.thresholds.emplace_back();  // not assessed
  a.over_time = over_time();
  a.warnings = {{"hall.toml:3: text", "hall.toml", 3, remark(RemarkId::no_route)}};
  a.project.name = "Hall";
  a.project.logo_png = "cG5n";
  a.scenario = {"failed", Operation::emergency, 60, {{"smoke", 0.5}}, {"a"}, {"b"}, {{"c", 0}}, 1};
  LuminaireRecord& lamp = a.luminaires.emplace_back();
  lamp.name = "lamp";
  lamp.mains_flux = lamp.emergency_flux = {100, "lm"};
  lamp.ifc_guid = "L1";
  lamp.opening_m = {0.1, 0.2, 0.3};
  lamp.onset = {{0, 0}, {5, 1}};
  a.sheets = {{.maker = "Maker",
               .article = "LX-1",
               .battery = "NiMH",
               .watts = 4,
               .duration_h = 1,
               .body_m = {{0.1, 0.2, 0.05}},
               .body_round = true,
               .curve_step_deg = 180,
               .c0_c180 = {1, 2, 1},
               .c90_c270 = {1, 2, 1},
               .spacing = {{3, 1, 0.56, RowSpacingRecord{4, 9}, {}}}}};
  SignRecord& exit = a.signs.emplace_back();
  exit.name = "exit";
  exit.ifc_guid = "S1";
  exit.legend = "red";
  exit.ground = "white";
  exit.colours = {{"red", 500, 400}, {"white", {}, {}}};
  a.places.routes = {{"way", {{0, 0, 0}, {4, 0, 0}}, 2}};
  a.places.areas = {{"hall", true, {{0, 0}, {4, 0}, {4, 4}}, 0, "R1", 500}};
  a.rooms = {{"hall", {{0, 0}, {4, 0}, {4, 4}}, 0, 8, 1, 2, 3, "R1"}};
  a.surfaces = {
      {.subject = {SubjectKind::route, "way"},
       .grids = {{"centre", {{{1, 1, 0.02}, 0.75}}, 0.75, 0.75, 0.75, {1, 1, 0.02}, {1, 1, 0.02}}},
       .in_bodies = 2,
       .map = {}}};
  a.places.emphasis = {{"door", "exit door", {4, 0, 0}, "D1"}};
  a.materials = {{"grey", "glossy", 3, 0.5, 0.1, 0.2, 1.5, true}};
  a.media = {{"smoke", "layered", {{0.2, 633, 1, 0.5, 0.6, 1, 2}}, 1000}};
  a.cameras = {"view"};
  PlanLevel& level = a.plan.levels.emplace_back();
  level.walls = level.furniture = {{{0, 0}, {4, 0}}};
  level.points = {{{1, 1, 0.02}, 0.75}};
  level.map = {{0, 0}, 0.25, 3, 1, {drawn_lux(0), drawn_lux(0.123456), drawn_lux(std::nan(""))}};
  a.plan.backdrops = {{{-1e7, 1e7}, {}, {}, {}, "", {{{{0, 0}, {1, 1}}}}},
                      {{0, 1}, {{0, 0}}, {{1, 0}}, {{0, 1}}, "cG5n", {}}};
  return a;
}

/// The text of the value at a path.
std::string text_at(const Json& json, const char* path) {
  const Json* const found = json.at_path(path);
  return found == nullptr ? "nothing" : found->dump();
}

}  // namespace

TEST_CASE("the record of an assessment is read back as it was written", "[judge][record]") {
  const Json json = assessment_json(full());
  const auto read = assessment_of(json);
  INFO((read ? "" : read.problem().what));
  REQUIRE(read);
  CHECK(assessment_json(read.value()).dump(1) == json.dump(1));
  CHECK(read->checks[0].rule.id == RuleId::E1);
  CHECK(read->checks[0].subject == check().subject);
  CHECK(read->sights[0].seen->other_light->verdict == SightVerdict::legible);
  CHECK(std::isnan(read->sights[0].from_gaze_deg));
  // The times of its states and the places of its route complete each table.
  CHECK(guided_time(read->over_time->routes[0].by_fds).lost_by_s == 30);
}

TEST_CASE("keys, forms and their order in assessment.json stay as they are", "[judge][record]") {
  const Json json = assessment_json(full());
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += (keys.empty() ? "" : " ") + key;
  CHECK(keys ==
        "format version scene state verdict not_assessed people method counts sight_counts checks "
        "sights sweep thresholds over_time warnings project scenario luminaires sheets signs "
        "places rooms surfaces materials media cameras plan");
  CHECK(text_at(json, "sheets/0/spacing/0") ==
        R"({"height_m":3.0,"level_lx":1.0,"factor":0.56,)"
        R"("c0_along":{"to_wall_m":4.0,"between_m":9.0},"c0_across":null})");
  CHECK(text_at(json, "surfaces/0/grids/0/least") == R"({"value":0.75,"unit":"lx"})");
  CHECK(text_at(json, "state/luminaires") == R"({"lit":1,"of":2,"lit_names":["lamp"]})");
  CHECK(text_at(json, "state/smoke/extinction") ==
        R"({"min":0.1,"max":0.2,"unit":"1/m","wavelength_nm":633.0})");
  CHECK(text_at(json, "sights/0/eye_illuminance/direct") == R"({"value":0.5,"unit":"lx"})");
  CHECK(text_at(json, "sights/0/experiments/read") ==
        R"({"mean_observer":"not known","untested":"age"})");
  CHECK(text_at(json, "thresholds/0") ==
        R"({"sought":"distance","from":{"kind":"route","name":"way","text":"route \"way\""},)"
        R"("along":{"value":0.0,"unit":"m"},"eye_height":{"value":0.0,"unit":"m"},)"
        R"("sign":"exit","eyes":"","limit":"read","end":"found","value":2.5,)"
        R"("standard_error":0.25,"unit":"m","holds":"above",)"
        R"("amounts_to":{"value":6.5,"unit":"m"}})");
  CHECK(text_at(json, "thresholds/1/value") == "null");
  CHECK(text_at(json, "state/rules/0/from") == "nothing");
  CHECK(text_at(json, "state/deviations/0/status") == "null");
  CHECK(text_at(json, "verdict") ==
        R"({"first":"first","words":"no check made fails","fail":0,"not_assessed":0,)"
        R"("not_verified":0,"pass":1})");
  CHECK(text_at(json, "people/age") == R"({"value":40.0,"unit":"years"})");
  CHECK(text_at(json, "checks/0/subject") ==
        R"~({"kind":"emphasis","name":"door","emphasis":"exit_door",)~"
        R"~("text":"\"door\" (exit door)"})~");
  CHECK(text_at(json, "checks/0/sense") == R"("at least")");
  CHECK(text_at(json, "checks/0/margin") == "1.0");
  CHECK(text_at(json, "checks/0/worst_place") == "[1.0,2.0,0.0]");
  CHECK(text_at(json, "checks/0/reasons") == "nothing");
  CHECK(text_at(json, "sights/0/light") == R"("new")");
  CHECK(text_at(json, "sights/0/angle_from_gaze") == R"({"value":null,"unit":"deg"})");
  CHECK(text_at(json, "sights/0/legend") == R"({"value":2.0,"standard_error":0.5,"unit":"cd/m2"})");
  CHECK(text_at(json, "sights/0/other_light/light") == R"("aged")");
  CHECK(text_at(json, "sights/0/other_eyes/0") ==
        R"({"eyes":"protan","verdict":"invisible",)"
        R"("reading_level":{"value":0.5,"standard_error":0.25,"unit":"1"}})");
  CHECK(text_at(json, "signs/0/colours/0") ==
        R"({"name":"red","mains":{"value":500.0,"unit":"cd/m2"},)"
        R"("emergency":{"value":400.0,"unit":"cd/m2"}})");
  CHECK(text_at(json, "signs/0/colours/1") == R"({"name":"white"})");
  CHECK(text_at(json, "over_time/routes/0/guided") == R"(["gg","gu"])");
  CHECK(text_at(json, "over_time/routes/0/time") ==
        R"({"until":{"value":0.0,"unit":"s"},"lost_by":{"value":30.0,"unit":"s"},)"
        R"("lost_at":{"value":2.0,"unit":"m"}})");
  CHECK(text_at(json, "over_time/routes/0/fds_visibility") == "[[30.0,null],[12.5,3.0]]");
  CHECK(text_at(json, "scenario/seconds_after_failure") == "60.0");
  CHECK(text_at(json, "scenario/media") == R"([{"name":"smoke","factor":0.5}])");
  CHECK(text_at(json, "plan/levels/0/map/lux") == "[0,0.1235,null]");
  CHECK(text_at(json, "plan/levels/0/points") == "[[1.0,1.0,0.02,0.75]]");
}

TEST_CASE("each value of an assessment.json is required, or is known to be absent",
          "[judge][record]") {
  const auto without = [](const char* path, const char* key) {
    Json json = assessment_json(full());
    (*path == '\0' ? json : *json.at_path(path)).erase(key);
    const auto read = assessment_of(json);
    return read ? std::string() : read.problem().what;
  };
  CHECK(without("", "signs") == "it has no \"signs\"");
  CHECK(without("checks/0", "limit") == "checks[0] has no \"limit\"");
  CHECK(without("state/smoke/media/0", "notes") == "state.smoke.media[0] has no \"notes\"");
  CHECK(without("sights/0", "light") == "sights[0] has no \"light\"");
  CHECK(without("over_time/routes/0/time", "until") == "over_time.routes[0].time has no \"until\"");
  CHECK(without("over_time/routes/0", "fds_visibility") ==
        "over_time.routes: what FDS says is not whole");
  CHECK(without("", "over_time").empty());
  CHECK(without("sights/0", "reason").empty());
  CHECK(without("project", "logo_png").empty());
}

TEST_CASE("an assessment.json that is of another format or inconsistent is refused",
          "[judge][record]") {
  const auto with = [](const char* path, const char* key, const Json& value) {
    Json json = assessment_json(full());
    (*path == '\0' ? json : *json.at_path(path))[key] = value;
    const auto read = assessment_of(json);
    return read ? std::string() : read.problem().what;
  };
  CHECK(with("", "format", "luxodus assessment 2") ==
        "its \"format\" is not \"luxodus assessment 4\"");
  CHECK(with("state/remarks/0", "id", "of_nobody").find("state.remarks[0]: ") == 0);
  CHECK(with("checks/0", "verdict", "maybe") == "checks[0].verdict is \"maybe\": unknown");
  CHECK(with("over_time/routes/0", "guided", Json::array({"gg", "gx"})) ==
        "over_time.routes[0].guided[1] has other letters than g, u and n");
  CHECK(with("luminaires/0", "sheet", 1) == "luminaires: one has no sheet");
  CHECK(with("sheets/0", "c0_c180", Json::array({1, 2})) == "sheets: a curve is not whole");
  CHECK(with("surfaces/0", "grids", Json::array()) == "surfaces: one has no points");
  CHECK(with("rooms/0", "outline", Json::array()) ==
        "rooms: an outline has less than three corners");
  CHECK(with("plan/levels/0/map", "rows", 2) ==
        "plan.levels: a map has not as many values as it has places");
  CHECK(with("plan/levels/0/map", "spacing", 0) == "plan.levels: a map has no spacing");
  CHECK(with("plan/backdrops/0", "png", "cG5n") ==
        "plan.backdrops: one is neither lines nor a picture");
  CHECK(with("project", "logo_png", "<script>") == "project.logo_png is no picture");
  CHECK(with("checks/0/subject", "name", std::string(limits::field_text + 1, 'x')) ==
        "checks[0].subject has more than 20000 characters");
  CHECK(with("checks/0/conditions/0", "args", Json::array({1e20, 1})) ==
        "checks[0].conditions[0] is larger than any number of a result");
  CHECK(with("counts", "pass", 2) == "counts.pass is not the number of its checks");
}
