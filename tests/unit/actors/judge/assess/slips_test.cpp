// Tests against verdicts that are better than the judged state: luminaires that are switched off,
// times after all durations, signs behind glass, and assessments whose counts are not those of
// their checks.
#include <algorithm>

#include "actors/judge/assess/assessment_files.hpp"
#include "actors/judge/assess/state_words.hpp"
#include "actors/judge/texts/texts.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

AssessOptions by_codes() {
  AssessOptions options;
  options.reality = false;
  return options;
}

std::string in_state(const std::string& keys) {
  return replaced(room, "operation = \"emergency\"\n", "operation = \"emergency\"\n" + keys);
}

bool remarks(const std::string& text, const std::string& words,
             const AssessOptions& options = by_codes()) {
  const std::string said = english().remarks(assessed(text, options).state.remarks);
  UNSCOPED_INFO(said);
  return said.find(words) != std::string::npos;
}

const Check& first_of(const Assessment& a, const std::string& id) {
  const auto at = std::find_if(a.checks.begin(), a.checks.end(),
                               [&](const Check& c) { return name_of(c.rule.id) == id; });
  REQUIRE(at != a.checks.end());
  return *at;
}

}  // namespace

TEST_CASE("luminaires that the judged state switches off do not light any check",
          "[assess][slips]") {
  const std::string on_circuit =
      replaced(in_state("circuits = { lamps = 0.5 }\n"), "name = \"lamp\"\n",
               "name = \"lamp\"\ncircuit = \"lamps\"\n");
  const Assessment full = assessed(room, by_codes());
  const Assessment half = assessed(on_circuit, by_codes());
  CHECK(*first_of(half, "E1").value == Approx(*first_of(full, "E1").value / 2));
  CHECK(remarks(on_circuit, "switch off 0 emergency luminaires and dim 1"));
  const std::string off = replaced(on_circuit, "lamps = 0.5", "lamps = 0");
  const Assessment dark = assessed(off, by_codes());
  CHECK(first_of(dark, "E1").verdict == CheckVerdict::fail);
  CHECK(*first_of(dark, "E1").value == 0);
  CHECK(remarks(off, "switch off 1 emergency luminaires"));
  // A flux above the stated one makes no check pass.
  const std::string raised = replaced(on_circuit, "lamps = 0.5", "lamps = 100");
  CHECK(*first_of(assessed(raised, by_codes()), "E1").value == Approx(*first_of(full, "E1").value));
  CHECK(remarks(raised, "raise the flux of 1 emergency luminaires"));
}

TEST_CASE("an exhausted supply makes every check dark, without a clock", "[assess][slips]") {
  const auto lasting = [](const std::string& hours) {
    return replaced(
        in_state("seconds_after_failure = 60\n"), "end_of_duration_factor = 0.75\n",
        "end_of_duration_factor = 0.75\nonset = [[0, 1], [1, 1]]\nduration_h = " + hours +
            "\n[[emphasis]]\nname = \"door\"\nkind = \"final_exit\"\n"
            "position = [6.5, 0, 0]\n");
  };
  const Assessment lit = assessed(lasting("1"), by_codes());
  for (const char* id : {"E1", "E10h", "E10f"}) CHECK(*first_of(lit, id).value > 0);
  CHECK(first_of(lit, "E12").verdict == CheckVerdict::pass);
  CHECK(first_of(lit, "E11").verdict == CheckVerdict::not_assessed);  // the sign states none
  const Assessment dark = assessed(lasting("0.01"), by_codes());
  for (const char* id : {"E1", "E10f", "E11", "E12"})
    CHECK(first_of(dark, id).verdict == CheckVerdict::fail);
  for (const char* id : {"E1", "E10f"}) CHECK(*first_of(dark, id).value == 0);
  CHECK(*first_of(dark, "E11").value == Approx(0.01));
  CHECK(*first_of(dark, "E10h").value == *first_of(lit, "E10h").value);  // lit after 5 s
  // What dazzles before the supply ends is judged all the same.
  CHECK(*first_of(dark, "E8").value == *first_of(lit, "E8").value);
  for (const PlanLevel& level : dark.levels)
    for (const PlanPoint& point : level.points) CHECK(point.lux == 0);
}

TEST_CASE("a sign whose supply is exhausted passes no check, and is named", "[assess][slips]") {
  const auto lasting = [](const std::string& hours) {
    return replaced(in_state("seconds_after_failure = 60\n"), "emergency_green = 10\n",
                    "emergency_green = 10\nduration_h = " + hours + "\n");
  };
  const auto named_dark = [](const Assessment& a) {
    return std::count(a.state.warnings.begin(), a.state.warnings.end(),
                      remark(RemarkId::sign_unlit, "exit"));
  };
  const Assessment lit = assessed(lasting("3"), by_codes());
  CHECK(first_of(lit, "S3").verdict == CheckVerdict::pass);
  CHECK(first_of(lit, "S4").verdict == CheckVerdict::pass);
  CHECK(named_dark(lit) == 0);
  const Assessment dark = assessed(lasting("0.01"), by_codes());
  CHECK(*first_of(dark, "S1").value == 0);
  CHECK(first_of(dark, "S1").verdict == CheckVerdict::fail);
  CHECK(first_of(dark, "S3").verdict == CheckVerdict::not_assessed);
  CHECK(first_of(dark, "S4").verdict == CheckVerdict::fail);
  CHECK(first_of(dark, "E11").verdict == CheckVerdict::fail);
  CHECK(named_dark(dark) == 1);
}

TEST_CASE("a remark names times at which light or adaptation is only assumed", "[assess][slips]") {
  CHECK(remarks(in_state("seconds_after_failure = 7200\n"), "rated duration of 1 h"));
  CHECK_FALSE(remarks(in_state("seconds_after_failure = 3600\n"), "rated duration of"));
  AssessOptions british = by_codes();
  british.deviations = {"uk-bs5266-1"};
  CHECK_FALSE(remarks(in_state("seconds_after_failure = 7200\n"), "rated duration of", british));
  CHECK(remarks(in_state("seconds_after_failure = 10801\n"), "rated duration of 3 h", british));
  CHECK(remarks(in_state("seconds_after_failure = 5\n"),
                "1 emergency luminaires do not say how fast they come on"));
  CHECK_FALSE(remarks(in_state("seconds_after_failure = 60\n"), "do not say how fast"));
}

TEST_CASE("a remark names eyes, spacings and rule sets that make verdicts better",
          "[assess][slips]") {
  const auto with = [](const std::string& keys) {
    return replaced(room, "irritant_smoke = false\n", "irritant_smoke = false\n" + keys);
  };
  CHECK(remarks(with("age_years = 25\n"), "judged by eyes of 25 years"));
  CHECK(remarks(replaced(room, "[1.65]", "[0.6]"), "nobody who walks upright is judged"));
  CHECK(remarks(replaced(room, "spacing_m = 4", "spacing_m = 10"), "stand 10 m apart"));
  CHECK_FALSE(remarks(room, "apart"));
  AssessOptions both = by_codes();
  both.rules = {"en1838-2013", "en1838-2024"};
  CHECK(remarks(room, "two editions of EN 1838 are judged", both));
  AssessOptions older = by_codes();
  older.rules = {"en1838-2013"};
  CHECK(remarks(with("rules = [\"en1838-2024\"]\n"),
                "the scene names other rules (en1838-2024) than were asked for", older));
  CHECK_FALSE(remarks(with("rules = [\"en1838-2013\"]\n"), "the scene names other rules", older));
}

TEST_CASE("smoke with an extinction of zero is clear air", "[assess][slips]") {
  const std::string none =
      "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 0\nalbedo = 0.3\n";
  const Assessment a = assessed(room + none, by_codes());
  CHECK_FALSE(a.state.smoke);
  CHECK(remarks(room + none, "CLEAR AIR"));
  CHECK(std::any_of(a.warnings.begin(), a.warnings.end(),
                    [](const StateWarning& w) { return w.remark == remark(RemarkId::clear_air); }));
}

TEST_CASE("a state that lacks one of several smokes says so", "[assess][slips]") {
  const auto smoke = [](const std::string& name, const std::string& extinction) {
    return "[[medium]]\nname = \"" + name +
           "\"\nkind = \"homogeneous\"\nextinction = " + extinction + "\nalbedo = 0.3\n";
  };
  const std::string two = smoke("thick", "2") + smoke("haze", "0.01");
  CHECK(remarks(in_state("media = { thick = 0 }\n") + two, "none of the smoke \"thick\""));
  CHECK_FALSE(remarks(room + two, "none of the smoke"));
}

TEST_CASE("the first sentence says what was judged and what came of it", "[assess][slips]") {
  const Assessment a = assessed(in_state("seconds_after_failure = 600\n"), by_codes());
  const std::string first = record_of(*described_text(room), a, "1").verdict.first;
  CHECK(
      first.starts_with("\"failed\", emergency operation, 600 s after the failure, in clear air, "
                        "by EN 1838:2013: "));
  CHECK(first.find(words_of(counts_of(a.checks))) != std::string::npos);
  CHECK(first.ends_with("no view of a sign was judged"));
}

TEST_CASE("an assessment with checks of other rule sets or with wrong counts is refused",
          "[assess][slips]") {
  AssessOptions options = by_codes();
  options.rules = {"en1838-2013"};
  options.deviations = {"de-asr-a3.4-3"};
  const Json good = assessment_json(recorded(room, options));
  REQUIRE(assessment_of(good));
  const auto refused_for = [](const Json& damaged, const std::string& words) {
    const auto checked = assessment_of(damaged);
    REQUIRE_FALSE(checked);
    INFO(checked.problem().what);
    CHECK(checked.problem().what.find(words) != std::string::npos);
  };
  Json dangling = good;
  dangling["state"]["deviations"] = Json::array();
  refused_for(dangling, "\"de-asr-a3.4-3\", which is not among state.deviations");
  Json other = good;
  other["state"]["rules"][0]["id"] = "en1838-2024";
  refused_for(other, "which is not among state.rules");
  for (const char* table : {"counts", "verdict"}) {
    Json counted = good;
    counted[table]["fail"] = good[table]["fail"].get<int>() + 1;
    refused_for(counted, ".fail is not the number of its checks");
  }
}

TEST_CASE("the check of a sign that is seen only through glass says so", "[assess][slips]") {
  const std::string pane =
      "[[material]]\nname = \"pane\"\nkind = \"glass\"\n"
      "[[object]]\nname = \"screen\"\nshape = \"quad\"\ncorner = [11, -2, 0]\n"
      "edge_u = [0, 4, 0]\nedge_v = [0, 0, 3]\nmaterial = \"pane\"\n";
  const std::string words = "signs are seen through glass alone";
  CHECK(english().remarks(first_of(assessed(room, by_codes()), "S4").reasons).find(words) ==
        std::string::npos);
  const std::string behind =
      replaced(room, "path = [[1, 0, 0], [11, 0, 0]]", "path = [[1, 0, 0], [10.5, 0, 0]]") + pane;
  CHECK(english().remarks(first_of(assessed(behind, by_codes()), "S4").reasons).find(words) !=
        std::string::npos);
}

TEST_CASE("a dark sign and a sign behind dark glass guide nobody", "[assess][slips]") {
  CHECK(first_of(assessed(room, by_codes()), "S4").verdict == CheckVerdict::pass);
  const std::string dark = replaced(room, "emergency_white = 100\nemergency_green = 10",
                                    "emergency_white = 0\nemergency_green = 0");
  CHECK(first_of(assessed(dark, by_codes()), "S4").verdict == CheckVerdict::fail);
  const std::string off = replaced(in_state("circuits = { signs = 0 }\n"), "emergency_green = 10\n",
                                   "emergency_green = 10\ncircuit = \"signs\"\n");
  CHECK(first_of(assessed(off, by_codes()), "S4").verdict == CheckVerdict::fail);
  CHECK(*first_of(assessed(off, by_codes()), "S1").value == 0);
  CHECK(remarks(off, "switch off 1 signs: checks by the codes take them as dark"));
  const std::string pane =
      "[[material]]\nname = \"pane\"\nkind = \"glass\"\ntransmittance = 0.1\n"
      "[[object]]\nname = \"screen\"\nshape = \"quad\"\ncorner = [11, -2, 0]\n"
      "edge_u = [0, 4, 0]\nedge_v = [0, 0, 3]\nmaterial = \"pane\"\n";
  const std::string behind =
      replaced(room, "path = [[1, 0, 0], [11, 0, 0]]", "path = [[1, 0, 0], [10.5, 0, 0]]") + pane;
  CHECK(first_of(assessed(behind, by_codes()), "S4").verdict == CheckVerdict::fail);
}

TEST_CASE("an assessment replaces its own files and refuses to replace those of other programs",
          "[assess][slips]") {
  const TemporaryFolder folder;
  const std::vector<std::string> files{"report.html", "assessment.json", "checks.csv"};
  CHECK(refuse_files_of_others(folder.path(), files).ok());
  folder.write("report.html", "<p>of somebody else</p>");
  const auto refused = refuse_files_of_others(folder.path(), files);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().text().find("--overwrite") != std::string::npos);
  folder.write("assessment.json", "{\"format\": \"of another program\"}");
  CHECK_FALSE(refuse_files_of_others(folder.path(), files).ok());
  folder.write("assessment.json", "{\"format\": \"" + std::string(assessment_format) + "\"}");
  CHECK(refuse_files_of_others(folder.path(), files).ok());
}
