// Tests that the user names rule sets, that each set is complete, and that none contains
// requirements of another country.
#include "scenes/emergency/rule_sets.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"
#include "tests/unit/scenes/emergency/code_choices.hpp"

using namespace luxodus;

namespace {

/// A route and an area under two luminaires with stated onset, a bench, an exit sign, a hose: at
/// least one subject for every rule.
SceneDescription building() {
  SceneDescription scene;
  EscapeRoute route;
  route.name = "corridor";
  route.path = {{0, 0, 0}, {10, 0, 0}};
  route.width_m = 1.8;
  scene.routes.push_back(route);
  for (const double x : {2.0, 8.0}) {
    Emitter e;
    e.name = "lamp " + std::to_string(static_cast<int>(x));
    e.frame.origin = {x, 0, 2.8};
    e.distribution = Distribution::isotropic;
    e.emergency_flux = 100;
    e.emergency_ageing = 0.5;
    e.onset = {{0, 0}, {8, 0.6}, {20, 1}};
    scene.emitters.push_back(e);
  }
  AssessedArea hall;
  hall.name = "hall";
  hall.outline = {{0, -1}, {10, -1}, {10, 1}, {0, 1}};
  scene.open_areas.push_back(hall);
  AssessedArea bench = hall;
  bench.name = "bench";
  bench.mains_lx = 100;
  scene.task_areas.push_back(bench);
  Sign sign;
  sign.name = "exit";
  sign.width_m = 0.3;
  sign.height_m = 0.15;
  sign.frame.origin = {5, 1, 2.3};
  sign.colours = white_and_green({400, 80}, {90, 12});
  sign.letters = SignLetters{0.15, 0.02};
  sign.face.width = 2;
  sign.face.height = 1;
  sign.face.colour = {0, 1};
  scene.signs.push_back(sign);
  EmphasisPoint hose;
  hose.name = "hose";
  hose.kind = EmphasisKind::fire_equipment;
  hose.position = {5, 0, 1};
  scene.emphasis.push_back(hose);
  return scene;
}

/// 0.8 lx everywhere at the end of the duration, half from each luminaire.
std::vector<LitPoint> points() {
  return {{{0, 0, 0.02}, {0.4, 0.4}}, {{10, 0, 0.02}, {0.4, 0.4}}};
}

/// All checks that a set makes of the building.
std::vector<Check> report(const CodeChoice& codes) {
  const SceneDescription scene = building();
  std::vector<Check> out;
  const auto add = [&](std::vector<Check> checks) {
    for (Check& check : checks) out.push_back(std::move(check));
  };
  RouteLight light;
  light.centre = light.band = light.inner = points();
  const auto people = walkers(scene.routes[0], 5);
  add(checks_of_route(scene, scene.routes[0], light, codes));
  add(checks_of_distance(scene, scene.routes[0], people,
                         std::vector<std::vector<ClearSign>>(people.size()), codes));
  add(checks_of_open_area(scene, scene.open_areas[0], points(), codes));
  add(checks_of_task_area(scene, scene.task_areas[0], points(), codes));
  add(checks_of_emphasis(scene, scene.emphasis[0], {}, 6.0, codes));
  add(checks_of_sign(scene, scene.signs[0], 0, {}, codes));
  add(checks_of_glare(scene, codes));
  add(checks_beyond(scene, codes));
  add({check_of_duration(scene, codes)});
  return out;
}

std::set<std::string> ids(const std::vector<Check>& checks) {
  std::set<std::string> out;
  for (const Check& check : checks) out.emplace(name_of(check.rule.id));
  return out;
}

const Check& set_of(const std::vector<Check>& checks, const std::string& id) {
  for (const Check& check : checks)
    if (name_of(check.rule.id) == id) return check;
  FAIL("no check " << id);
  return checks.front();
}

CodeChoice with(CodeChoice codes, Deviation deviation) {
  codes.deviations.insert(deviation);
  return codes;
}

}  // namespace

TEST_CASE("no rule set is assumed, and without a name the error lists all", "[emergency][rules]") {
  const auto none = chosen_codes({}, {});
  REQUIRE_FALSE(none.ok());
  for (const NamedRules& set : rule_sets())
    CHECK(none.problem().what.find(set.id) != std::string::npos);
  CHECK(none.problem().what.find("--rules") != std::string::npos);
  const auto wrong = chosen_codes({"en1838"}, {});
  REQUIRE_FALSE(wrong.ok());
  CHECK(wrong.problem().what.find("there is no rule set \"en1838\"; there are: en1838-2013") == 0);
  const auto twice = chosen_codes({"nfpa101", "en1838-2024", "nfpa101"}, {});
  REQUIRE(twice.ok());
  REQUIRE(twice->size() == 2);
  CHECK(twice.value()[0].set == RuleSet::en1838_2024);
}

TEST_CASE("a deviation is accepted only with the sets that it deviates from",
          "[emergency][rules]") {
  const auto codes = chosen_codes({"en1838-2013", "nfpa101"}, {"us-ibc", "de-asr-a3.4-3"});
  REQUIRE(codes.ok());
  CHECK(codes.value()[0].has(Deviation::de_asr));
  CHECK_FALSE(codes.value()[0].has(Deviation::us_ibc));
  CHECK(codes.value()[1].has(Deviation::us_ibc));
  CHECK_FALSE(chosen_codes({"en1838-2013"}, {"us-ibc"}).ok());
  CHECK_FALSE(chosen_codes({"en1838-2013"}, {"de"}).ok());
}

TEST_CASE("requirements of one country do not appear in the report of another",
          "[emergency][rules]") {
  for (const CodeChoice& codes : {en13, en24}) {
    for (const Check& check : report(codes)) {
      INFO(name_of(check.rule.id) << " " << check.rule.edition);
      CHECK(check.rule.set == named(codes.set).id);
      CHECK((name_of(check.rule.id)[0] == 'E' || name_of(check.rule.id)[0] == 'S'));
      CHECK(check.rule.edition.find("NFPA") == std::string::npos);
      CHECK(check.rule.edition.find("DIN") == std::string::npos);
      CHECK(check.rule.edition.find("IBC") == std::string::npos);
    }
  }
  for (const Check& check : report(nfpa)) {
    INFO(name_of(check.rule.id));
    CHECK(check.rule.edition == "NFPA 101");
  }
}

TEST_CASE("the rule set of 2024 is complete, and its rules say if they are taken over from 2013",
          "[emergency][rules]") {
  auto expected = ids(report(en13));
  expected.erase("E1");
  expected.erase("E2");
  expected.insert("E5");
  const auto now = report(en24);
  CHECK(ids(now) == expected);
  for (const Check& check : now) {
    INFO(name_of(check.rule.id));
    if (check.rule.id == RuleId::S8) continue;  // from ISO 3864-4
    CHECK(check.rule.edition == "EN 1838:2024");
    CHECK(check.rule.status ==
          remark(check.rule.id == RuleId::E5 ? RemarkId::not_verified : RemarkId::carried_over));
  }
  CHECK(set_of(report(en13), "E4").rule.status == remark(RemarkId::superseded));
}

TEST_CASE("each deviation changes a limit or adds a check, and names its source",
          "[emergency][rules]") {
  const auto lacks = ids(report(en24));
  CHECK_FALSE(lacks.contains("S5"));
  CHECK_FALSE(lacks.contains("E10g"));
  const auto german = report(with(en24, Deviation::de_asr));
  // 15 s after the failure: 0.6 + 0.4 x 7/12 of 0.8 lx.
  CHECK(*set_of(german, "E10g").value == Approx(0.8 * (0.6 + 0.4 * 7 / 12)));
  CHECK(*set_of(german, "E10g").limit == 1);
  CHECK(set_of(german, "E10g").verdict == CheckVerdict::fail);
  CHECK(set_of(german, "E10g").rule.sources ==
        Remarks{remark(RemarkId::source_named, "messefrankfurt")});
  CHECK(set_of(german, "E10g").rule.deviation == "de-asr-a3.4-3");
  const auto din = report(with(en24, Deviation::de_din_4844));
  CHECK(set_of(din, "S5").verdict == CheckVerdict::fail);
  CHECK(*set_of(report(en24), "E11").limit == 1);
  const auto long_lived = report(with(en24, Deviation::duration_3h));
  CHECK(*set_of(long_lived, "E11n").limit == 3);
  CHECK_FALSE(ids(long_lived).contains("E11"));
  const auto british = report(with(en24, Deviation::uk_bs_5266));
  CHECK(*set_of(british, "E11u").limit == 3);
  CHECK(set_of(british, "E6").verdict == CheckVerdict::pass);  // 0.8 lx of 0.5 lx
  CHECK(*set_of(british, "E6k").limit == 1);
  // NFPA requires a mean of 6.5 lx at the end, the IBC 6 lx; each also requires a smallest value.
  const auto ibc = report(with(nfpa, Deviation::us_ibc));
  CHECK(*set_of(report(nfpa), "N2").limit == 6.5);
  CHECK(*set_of(ibc, "I2").limit == 6);
  CHECK(*set_of(ibc, "I1").limit == 11);
  CHECK(*set_of(ibc, "I1m").limit == 1);
  CHECK(*set_of(ibc, "I2m").limit == 0.6);
  CHECK_FALSE(ids(ibc).contains("N2"));
  const auto hospital = report(with(nfpa, Deviation::us_ibc_i2));
  CHECK(*set_of(hospital, "N4").value == Approx(0.4));
  CHECK(set_of(hospital, "N4").verdict == CheckVerdict::fail);
}

TEST_CASE("a check against a limit that was found in no source neither passes nor fails",
          "[emergency][rules]") {
  Rule rule = rule_of(RuleId::S6a, en13);
  CHECK(rule.recollected());
  for (const double value : {10.0, 30.0}) {
    const Check check = judged(rule, {SubjectKind::sign, "exit"}, value, Limit{20, false});
    CHECK(check.verdict == CheckVerdict::not_verified);
    CHECK(check.reasons == Remarks{remark(value < 20 ? RemarkId::keeps_unread_limit
                                                     : RemarkId::breaks_unread_limit)});
  }
  rule.sources.clear();
  CHECK(judged(rule, {SubjectKind::sign, "exit"}, 10, Limit{20, false}).verdict ==
        CheckVerdict::pass);
  for (const CodeChoice& codes :
       {en13, en24, with(en24, Deviation::uk_bs_5266), with(nfpa, Deviation::us_ibc)})
    for (const Check& check : report(codes)) {
      INFO(name_of(check.rule.id));
      if (check.rule.recollected()) {
        CHECK(check.verdict != CheckVerdict::pass);
        CHECK(check.verdict != CheckVerdict::fail);
      }
    }
}

TEST_CASE("the words of a verdict never say that a building passes", "[emergency][rules]") {
  std::vector<Check> checks(4);
  checks[0].verdict = CheckVerdict::pass;
  CHECK(words_of(counts_of(checks)) == "no check made fails, 3 not assessed");
  checks[1].verdict = CheckVerdict::fail;
  checks[2].verdict = CheckVerdict::not_verified;
  CHECK(words_of(counts_of(checks)) == "1 check fails, 1 not assessed, 1 not verified");
  checks[3].verdict = CheckVerdict::fail;
  CHECK(words_of(counts_of(checks)) == "2 checks fail, 0 not assessed, 1 not verified");
}
