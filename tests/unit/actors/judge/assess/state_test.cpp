// The judged state is named or refused, never guessed, and is printed before any verdict.
#include <catch2/catch.hpp>
#include <cmath>

#include "actors/judge/assess/compare.hpp"
#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/assess/state_words.hpp"
#include "actors/judge/report/report.hpp"
#include "scenes/emergency/adaptation.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// The room in smoke of 0.5/m, with these lines instead of its only scenario.
std::string in_states(const std::string& scenarios) {
  return replaced_all(with_smoke(0.5, 0.3),
                      "[[scenario]]\nname = \"failed\"\noperation = \"emergency\"\n", scenarios);
}

std::string state(const std::string& name, const std::string& more) {
  return "[[scenario]]\nname = \"" + name + "\"\n" + more;
}

const std::string emergency = "operation = \"emergency\"\n";
const std::string dark = "operation = \"dark\"\n";
const std::string clear = "media = { smoke = 0 }\n";

Problem refused(const std::string& text, const AssessOptions& options = codes_alone()) {
  const auto result = tried(text, options);
  REQUIRE_FALSE(result.ok());
  return result.problem();
}

std::string chosen(const std::string& scenarios) {
  return assessed(in_states(scenarios), codes_alone()).state.scenario;
}

AssessOptions one_round(const std::string& scenario = "") {
  AssessOptions options;
  options.rounds = 1;
  options.scenario = scenario;
  return options;
}

}  // namespace

TEST_CASE("a scene without a scenario is refused with what to write", "[assess][state]") {
  const Problem problem = refused(in_states(""));
  CHECK(has(problem.what, "there is no [[scenario]]"));
  CHECK(has(problem.what, "operation = \"emergency\""));
}

TEST_CASE(
    "a smoky scenario whose operation may have been forgotten is not replaced by the clear one",
    "[assess][state]") {
  const Problem problem = refused(in_states(state("fire", "") + state("clear", emergency + clear)));
  CHECK(has(problem.what, "no scenario with smoke is in emergency operation"));
  CHECK(has(problem.what, "--scenario"));
  CHECK(has(problem.what, "operation = \"emergency\""));
  CHECK(has(problem.what, "\"fire\" (mains operation, with smoke)"));
  CHECK(has(problem.what, "\"clear\" (emergency operation, without smoke)"));
  CHECK(problem.where.line > 0);
  // Nor by thin smoke.
  CHECK(has(
      refused(in_states(state("thick", "media = { smoke = 5 }\n") + state("thin", emergency))).what,
      "its operation may have been forgotten"));
  // Nor by a scenario in which no circuit is off.
  CHECK(
      has(refused(in_states(state("cut", "circuits = { lamps = 0 }\n") + state("all", emergency)) +
                  "[[emitter]]\nname = \"b\"\nshape = \"point\"\nposition = [3, 0, 2]\n"
                  "flux_lm = 1\ncircuit = \"lamps\"\n")
              .what,
          "its operation may have been forgotten"));
}

TEST_CASE("the judged state is the only scenario in emergency operation, with smoke if any has it",
          "[assess][state]") {
  CHECK(chosen(state("fire", emergency)) == "fire");
  CHECK(chosen(state("day", clear) + state("clear", emergency + clear) +
               state("fire", emergency)) == "fire");
  // A scenario with the same smoke and the mains on does no harm: in emergency operation it would
  // be the same.
  CHECK(chosen(state("mains", "") + state("fire", emergency) + state("dark", dark)) == "fire");
  CHECK(chosen(state("day", clear) + state("clear", emergency + clear)) == "clear");
  for (const std::string& open : {clear, std::string()})
    CHECK(has(refused(in_states(state("a", emergency + open) + state("b", emergency + open))).what,
              "\"a\" and \"b\" are both in emergency operation"));
  CHECK(has(refused(in_states(state("fire", dark) + state("clear", emergency + clear))).what,
            "no scenario with smoke is in emergency operation"));
  AssessOptions named = codes_alone();
  named.scenario = "b";
  CHECK(assessed(in_states(state("a", emergency) + state("b", emergency)), named).state.scenario ==
        "b");
  named.scenario = "c";
  CHECK(has(refused(in_states(state("a", emergency)), named).what, "there is no scenario \"c\""));
}

TEST_CASE("mains operation is judged only if it is named, and is then reported first",
          "[assess][state]") {
  const std::string text = in_states(state("day", ""));
  CHECK(has(refused(text).what, "is in emergency operation"));
  AssessOptions options = codes_alone();
  options.scenario = "day";
  const Assessment a = assessed(text, options);
  REQUIRE_FALSE(a.warnings.empty());
  CHECK(a.warnings.front().remark == remark(RemarkId::mains_operation));
  CHECK(a.warnings.front().place.line > 0);
  const AssessmentRecord record = record_of(*described_text(text), a, "1");
  CHECK(record.state.operation == Operation::mains);
  CHECK(has(state_text(record), "MAINS: not an emergency"));
  CHECK(has(english().remarks(record.state.remarks),
            "Checks by the codes are for emergency operation"));
  CHECK(record.state.luminaires.lit == 0);  // non-maintained
}

TEST_CASE("no rule set is assumed, and a scene may name its own", "[assess][state]") {
  static const std::atomic<bool> nobody{false};
  const auto judge = [&](const std::string& text) {
    return assess(described_text(text), codes_alone(), nobody, [](const std::string&, double) {});
  };
  const auto none = judge(room);
  REQUIRE_FALSE(none.ok());
  CHECK(has(none.problem().what, "en1838-2013, en1838-2024, nfpa101"));
  const auto said = judge(replaced_all(room, "spacing_m = 4\n",
                                       "spacing_m = 4\nrules = [\"nfpa101\"]\n"
                                       "deviations = [\"us-ibc\"]\n"));
  REQUIRE(said.ok());
  REQUIRE(said->state.codes.size() == 1);
  CHECK(said->state.codes[0].set == RuleSet::nfpa101);
  CHECK(said->state.codes[0].has(Deviation::us_ibc));
  for (const Check& check : said->checks) CHECK(check.rule.set != "en1838-2013");
}

TEST_CASE("a scene with smoke must state whether the smoke is irritant, or nothing is judged in it",
          "[assess][state]") {
  const std::string unsaid = replaced_all(with_smoke(0.5, 0.3), "irritant_smoke = false\n", "");
  const Problem problem = refused(unsaid, one_round());
  CHECK(has(problem.what, "irritant_smoke = true"));
  CHECK(has(problem.what, "scenario \"failed\""));
  CHECK(problem.where.line > 0);
  CHECK(has(problem.where.file, "scene.toml"));
  // The codes do not consider smoke, and clear air does not irritate.
  CHECK(tried(unsaid, codes_alone()).ok());
  CHECK(tried(replaced_all(room, "irritant_smoke = false\n", ""), one_round()).ok());
}

TEST_CASE("the judged state is in the JSON, in the text, and first on the page",
          "[assess][state]") {
  std::string text = with_smoke(0.5, 0.3);
  text = replaced_all(text, "operation = \"emergency\"\n",
                      "operation = \"emergency\"\nseconds_after_failure = 5\n"
                      "media = { smoke = 0.4 }\n");
  text +=
      "[[emitter]]\nname = \"hall\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
      "position = [3, 0, 2.5]\nflux_lm = 1000\n";
  const Assessment a = assessed(text, one_round());
  const AssessmentRecord record = record_of(*described_text(text), a, "1");
  const Json json = assessment_json(record);
  const Json& s = json["state"];
  CHECK(s["scenario"] == "failed");
  CHECK(s["operation"] == "emergency");
  CHECK(s["seconds_after_failure"]["value"] == 5);
  CHECK(s["luminaires"]["lit"] == 1);
  CHECK(s["luminaires"]["of"] == 2);
  CHECK(s["luminaires"]["lit_names"][0] == "lamp");
  CHECK(s["smoke"]["extinction"]["max"].get<double>() == Approx(0.2));
  CHECK(s["smoke"]["extinction"]["wavelength_nm"] == 633);
  CHECK(s["smoke"]["on_lines"]["views"].get<size_t>() > 0);
  CHECK(s["smoke"]["on_lines"]["max"].get<double>() == Approx(0.2).epsilon(0.02));
  CHECK(s["smoke"]["media"][0]["name"] == "smoke");
  CHECK(has(s["smoke"]["media"][0]["place"], "scene.toml:"));
  CHECK(json["scenario"]["media"] == Json::parse(R"([{"name": "smoke", "factor": 0.4}])"));
  CHECK(s["rules"][0]["id"] == "en1838-2013");
  CHECK(s["rules"][0]["edition"] == "EN 1838:2013");
  CHECK(s["rules"][0]["status"]["id"] == "superseded");
  CHECK(s["equivalent_background"]["value"].get<double>() ==
        Approx(equivalent_background(100, 5)).epsilon(1e-6));
  CHECK(has(s["light"]["text"], "the worse verdict counts"));
  CHECK(json["verdict"]["words"] == words_of(counts_of(a.checks)));
  CHECK(json["verdict"]["fail"] == json["counts"]["fail"]);
  CHECK(json["counts"]["not_verified"].get<int>() > 0);  // S6a
  size_t unassessed = 0;
  for (const Json& group : json["not_assessed"]) {
    CHECK_FALSE(group["why"].empty());
    if (group["what"] != "views of signs") unassessed += group["count"].get<size_t>();
  }
  CHECK(unassessed == json["counts"]["not_assessed"].get<size_t>());
  const std::string words = state_text(record);
  CHECK(has(words, "emergency, 5 s after the failure of the mains"));
  CHECK(has(words, "1 of 2 lit: lamp"));
  CHECK(has(words, "pupils and retinas have not yet followed"));
  const std::string page = report_html(record, {}, {});
  CHECK(page.find("1 of 2 lit") < page.find("<h2 "));  // beside the verdict
  CHECK(page.find(record.verdict.words) < page.find("<h2 "));
  CHECK(has(page, "pupils and retinas have not yet followed"));
}

TEST_CASE("pupils and retinas count as not adapted within a minute of the failure, and not after",
          "[assess][state]") {
  for (const double seconds : {0.0, 59.0, 60.0, 600.0}) {
    const std::string text = replaced_all(
        room, "operation = \"emergency\"\n",
        "operation = \"emergency\"\nseconds_after_failure = " + std::to_string(seconds) + "\n");
    const AssessedState judged = assessed(text, codes_alone()).state;
    CHECK(has(english().remarks(judged.remarks), "pupils and retinas have not yet followed") ==
          (seconds < 60));
  }
  const AssessedState unsaid = assessed(room, codes_alone()).state;
  CHECK_FALSE(unsaid.seconds_after_failure);
  CHECK(has(english().remarks(unsaid.remarks), "does not say how long after the failure"));
}

TEST_CASE("remarks name clear air in a scene with smoke, and luminaires that are off",
          "[assess][state]") {
  const std::string text =
      replaced_all(in_states(state("fire", emergency) + state("clear", emergency + clear) +
                             state("failed", emergency + "circuits = { lamps = 0 }\n")),
                   "name = \"lamp\"\n", "name = \"lamp\"\ncircuit = \"lamps\"\n");
  const auto remarks = [&](const std::string& scenario) {
    AssessOptions options = codes_alone();
    options.scenario = scenario;
    return english().remarks(assessed(text, options).state.remarks);
  };
  CHECK(has(remarks("clear"), "CLEAR AIR"));
  CHECK_FALSE(has(remarks("fire"), "CLEAR AIR"));
  CHECK_FALSE(has(remarks("fire"), "not lit in this state"));
  CHECK(has(remarks("failed"), "1 emergency luminaire is not lit in this state"));
}

TEST_CASE("views are judged in aged and in new light, and the worse verdict counts",
          "[assess][state]") {
  const Json aged_and_new = assessment_json(recorded(room, one_round()));
  // This scene with all ageing factors 1: its light is the new light.
  const std::string fresh =
      replaced_all(replaced_all(room, "maintenance_factor = 0.8", "maintenance_factor = 1"),
                   "end_of_duration_factor = 0.75", "end_of_duration_factor = 1");
  const Assessment as_new = assessed(fresh, one_round());
  const Assessment both = assessed(room, one_round());
  REQUIRE(both.sights.size() == as_new.sights.size());
  for (size_t i = 0; i < both.sights.size(); ++i) {
    const SightRow& row = both.sights[i];
    REQUIRE(row.other.has_value());
    CHECK_FALSE(as_new.sights[i].other.has_value());
    const SignLook& aged = row.in_new_light ? row.other->look : row.look;
    const SignLook& renewed = row.in_new_light ? row.look : row.other->look;
    const SignLook& alone = as_new.sights[i].look;
    CHECK(renewed.veil_cd_m2 == Approx(alone.veil_cd_m2));
    CHECK(aged.veil_cd_m2 == Approx(0.6 * alone.veil_cd_m2));
    const auto agrees = [](const Uncertain& a, const Uncertain& b) {
      CHECK(std::abs(a.value - b.value) <= 4 * std::hypot(a.error, b.error) + 1e-9 * b.value);
    };
    agrees(renewed.legend, alone.legend);
    agrees(renewed.ground, alone.ground);
    agrees(renewed.surround, alone.surround);
    agrees(renewed.difference, alone.difference);
    // The wall beside the sign is lit by the lamp, and only a little by the sign.
    CHECK(renewed.surround.value > aged.surround.value);
    CHECK(renewed.legend.value >= aged.legend.value);
  }
  CHECK(aged_and_new["sights"][0].contains("other_light"));
}

TEST_CASE("a sign that is hidden only by glare in new light is not legible", "[assess][state]") {
  // A lamp beside the line of sight, whose light falls to a hundredth as it ages.
  std::string glare = replaced_all(room, "position = [6, 0, 2.5]", "position = [6, 0.3, 2.3]");
  glare = replaced_all(glare, "emergency_flux = 500", "emergency_flux = 60000");
  glare = replaced_all(glare, "maintenance_factor = 0.8", "maintenance_factor = 0.1");
  glare = replaced_all(glare, "end_of_duration_factor = 0.75", "end_of_duration_factor = 0.1");
  glare = replaced_all(glare, "emergency_white = 100\nemergency_green = 10",
                       "emergency_white = 10\nemergency_green = 1");
  AssessOptions options;
  options.rounds = 4;
  bool turned = false;
  for (const SightRow& row : assessed(glare, options).sights) {
    if (!row.in_new_light || row.other->sight.verdict != SightVerdict::legible) continue;
    turned = turned || row.sight.verdict == SightVerdict::visible ||
             row.sight.verdict == SightVerdict::invisible;
  }
  CHECK(turned);
}

TEST_CASE("without the initial flux of a rated luminaire no sign is called legible",
          "[assess][state]") {
  const std::string rated =
      replaced_all(room, "emergency_flux_is = \"initial\"\nend_of_duration_factor = 0.75",
                   "emergency_flux_is = \"rated\"");
  size_t unknown = 0;
  for (const SightRow& row : assessed(rated, one_round()).sights) {
    CHECK(row.sight.verdict != SightVerdict::legible);
    if (row.sight.reason == remark(RemarkId::initial_flux_unknown)) ++unknown;
  }
  CHECK(unknown > 0);
  const std::string stated = replaced_all(rated, "\"rated\"", "\"rated\"\ninitial_flux = 600");
  for (const SightRow& row : assessed(stated, one_round()).sights)
    CHECK(row.sight.reason != remark(RemarkId::initial_flux_unknown));
}

TEST_CASE("each luminaire is renewed by its own ageing factor", "[assess][state]") {
  const std::string second =
      "[[emitter]]\nname = \"old lamp\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
      "position = [9, 0, 2.5]\nflux_lm = 1000\nemergency = \"non-maintained\"\n"
      "emergency_flux = 400\nmaintenance_factor = 0.5\nend_of_duration_factor = 0.5\n";
  const Assessment both = assessed(room + second, one_round());
  std::string fresh = room + second;
  for (const char* factor : {"maintenance_factor = 0.8", "maintenance_factor = 0.5"})
    fresh = replaced_all(fresh, factor, "maintenance_factor = 1");
  for (const char* factor : {"end_of_duration_factor = 0.75", "end_of_duration_factor = 0.5"})
    fresh = replaced_all(fresh, factor, "end_of_duration_factor = 1");
  const Assessment as_new = assessed(fresh, one_round());
  REQUIRE(both.sights.size() == as_new.sights.size());
  for (size_t i = 0; i < both.sights.size(); ++i) {
    const SightRow& row = both.sights[i];
    REQUIRE(row.other.has_value());
    const SignLook& renewed = row.in_new_light ? row.look : row.other->look;
    const SignLook& alone = as_new.sights[i].look;
    CHECK(renewed.veil_cd_m2 == Approx(alone.veil_cd_m2));
    CHECK(std::abs(renewed.surround.value - alone.surround.value) <=
          4 * std::hypot(renewed.surround.error, alone.surround.error));
  }
}

TEST_CASE("in mains operation new light is the light before maintenance only", "[assess][state]") {
  std::string text = replaced_all(room, "\"non-maintained\"", "\"maintained\"");
  text = replaced_all(text, "operation = \"emergency\"\n", "operation = \"mains\"\n");
  for (const SightRow& row : assessed(text, one_round("failed")).sights) {
    REQUIRE(row.other.has_value());
    const double aged = (row.in_new_light ? row.other->look : row.look).veil_cd_m2;
    const double renewed = (row.in_new_light ? row.look : row.other->look).veil_cd_m2;
    CHECK(renewed == Approx(aged / 0.8));
  }
}

TEST_CASE("a comparison reports that two judged states differ", "[assess][state]") {
  const std::string text = in_states(state("fire", emergency) + state("clear", emergency + clear));
  AssessOptions options = codes_alone();
  const auto judged = [&](const std::string& scenario) {
    options.scenario = scenario;
    return recorded(text, options);
  };
  const std::string said = comparison_text(comparison_of(judged("fire"), judged("clear")));
  CHECK(has(said, "scenario: fire -> clear"));
  CHECK(comparison_of(judged("fire"), judged("fire")).state.empty());
}

TEST_CASE("checks that fail and checks or views without a clear verdict are open",
          "[assess][state]") {
  AssessmentRecord done;
  done.verdict.counts.pass = 3;
  done.sight_counts = {{"legible", 4}, {"invisible", 1}};
  CHECK_FALSE(anything_open(done));
  for (const auto verdict :
       {&CountsRecord::fail, &CountsRecord::not_assessed, &CountsRecord::not_verified}) {
    AssessmentRecord open = done;
    open.verdict.counts.*verdict = 1;
    CHECK(anything_open(open));
  }
  for (const char* verdict : {"undecided", "not assessed"}) {
    AssessmentRecord open = done;
    open.sight_counts[verdict] = 1;
    CHECK(anything_open(open));
  }
}
