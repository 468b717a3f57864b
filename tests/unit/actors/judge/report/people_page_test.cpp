// Tests the section of a report on people who were followed.
#include <array>
#include <catch2/catch.hpp>

#include "actors/judge/report/report.hpp"
#include "runtime/core/regular_file.hpp"
#include "tests/kit/followed_people.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

AssessmentRecord judged_by_codes() {
  AssessOptions options;
  options.reality = false;
  return recorded(room, options);
}

FollowedPeople people_in(const AssessmentRecord& a) {
  FollowedPeople out = two_followed();
  out.scene = a.scene.name;
  out.scenario = a.scene.scenario;
  return out;
}

}  // namespace

TEST_CASE("a report says what people read on their way, in each language", "[report]") {
  const AssessmentRecord a = judged_by_codes();
  const Enclosures enclosures{{}, people_in(a)};
  const std::array<const char*, 3> totals{
      "28.6 % of 14 person-seconds; undecided 14.3 %; without 57.1 %",
      "28,6 % von 14 Personensekunden; unentschieden 14,3 %; ohne 57,1 %",
      "28,6 % de 14 personnes-secondes ; indécis 14,3 % ; sans 57,1 %"};
  for (const Language language : {Language::en, Language::de, Language::fr}) {
    ReportOptions options;
    options.language = language;
    const std::string page = report_html(a, enclosures, options);
    const size_t from = page.find("id=\"people\" class");
    REQUIRE(from != std::string::npos);
    const std::string section = page.substr(from, page.find("<h2", from) - from);
    CHECK_THAT(section, Catch::Contains(totals[static_cast<size_t>(language)]));
    CHECK_THAT(section, Catch::Contains("ASET/RSET"));
    CHECK_THAT(section, Catch::Contains("#e59a4c"));  // 8 person-seconds in a square
    // The one who was longer without comes first.
    const size_t late = section.find("guests &lt;late&gt;");
    REQUIRE(late != std::string::npos);
    CHECK(late < section.find("<td>guests</td>"));
  }
}

TEST_CASE("people of another scenario are named and left out", "[report]") {
  const AssessmentRecord a = judged_by_codes();
  FollowedPeople people = people_in(a);
  people.scenario = "other";
  const std::string page = report_html(a, {{}, people}, {});
  CHECK_THAT(page, Catch::Contains("the scenario “other”. They are left out."));
  CHECK_THAT(page, !Catch::Contains("person-seconds"));
  CHECK_THAT(report_html(a, {}, {}), !Catch::Contains("id=\"people\" class"));
}

TEST_CASE("a report takes in the people beside it, and refuses damaged ones", "[report]") {
  const AssessmentRecord a = judged_by_codes();
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "people");
  REQUIRE(write_json(folder / "people/walk.json", followed_people_json(people_in(a))));
  REQUIRE(write_report(folder / "", a, {}));
  const auto page = read_regular_file(folder / "report.html", 1 << 24);
  REQUIRE(page);
  CHECK_THAT(page.value(), Catch::Contains("id=\"people\" class"));
  folder.write("people/walk.json", "{}");
  const auto refused = write_report(folder / "", a, {});
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.problem().text(), Catch::Contains("walk.json"));
}
