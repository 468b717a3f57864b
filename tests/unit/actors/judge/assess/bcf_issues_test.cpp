// Failed checks as issues of BCF 2.1.
#include "actors/judge/assess/bcf_issues.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace luxodus;

namespace {

const std::string space_guid = "1L0000000000000007NPqM", lamp_guid = "1L0000000000000007Nj9i";

CheckRecord issue_check(const Subject& subject, CheckVerdict verdict) {
  CheckRecord out;
  out.rule.id = RuleId::E6;
  out.rule.set = "en1838-2024";
  out.rule.edition = "EN 1838:2024 <draft>";
  out.subject = subject;
  out.value = 0.3;
  out.limit = 0.5;
  out.unit = "lx";
  out.verdict = verdict;
  return out;
}

AssessmentRecord assessment_with(const std::vector<CheckRecord>& checks) {
  AssessmentRecord out;
  out.scene.name = "house";
  out.project.author = "A & B";
  out.project.date = "2026-05-31";
  LuminaireRecord& lamp = out.luminaires.emplace_back();
  lamp.name = "lamp";
  lamp.ifc_guid = lamp_guid;
  lamp.position = {3, 2, 2.9};
  SignRecord& exit = out.signs.emplace_back();
  exit.name = "exit";
  exit.position = {6, 2, 2.2};
  exit.facing = {-1, 0, 0};
  AreaRecord& hall = out.places.areas.emplace_back();
  hall.name = "hall";
  hall.outline = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  hall.ifc_guid = space_guid;
  RouteRecord& way = out.places.routes.emplace_back();
  way.name = "way";
  way.path = {{1, 1, 0}, {5, 1, 0}};
  out.checks = checks;
  return out;
}

size_t count_in(const std::string& text, const std::string& what) {
  size_t count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("each failed check is an issue with a camera and GlobalIds", "[assess]") {
  CheckRecord area = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::fail);
  area.worst = glm::dvec3(0.5, 0.5, 0);
  const CheckRecord route = issue_check({SubjectKind::route, "way"}, CheckVerdict::fail);
  const CheckRecord lamp = issue_check({SubjectKind::luminaire, "lamp"}, CheckVerdict::fail);
  const CheckRecord sign = issue_check({SubjectKind::sign, "exit"}, CheckVerdict::fail);
  const CheckRecord passed = issue_check({SubjectKind::luminaire, "lamp"}, CheckVerdict::pass);
  const auto bytes = bcf_issues(assessment_with({area, route, lamp, sign, passed}));
  REQUIRE(bytes);
  CHECK(bytes->find("<Version VersionId=\"2.1\">") != std::string::npos);
  CHECK(count_in(*bytes, "<Topic Guid=") == 4);
  CHECK(count_in(*bytes, "<VisualizationInfo Guid=") == 4);
  CHECK(count_in(*bytes, "<PerspectiveCamera>") == 4);
  // The area and the luminaire bear a GlobalId; the route lies in the space.
  CHECK(count_in(*bytes, "<Component IfcGuid=\"" + space_guid + "\"/>") == 2);
  CHECK(count_in(*bytes, "<Component IfcGuid=\"" + lamp_guid + "\"/>") == 1);
  CHECK(bytes->find("EN 1838:2024 &lt;draft&gt;") != std::string::npos);
  CHECK(bytes->find("Found: 0.3 lx. Demanded: at least 0.5 lx.") != std::string::npos);
  CHECK(bytes->find("<CreationDate>2026-05-31T00:00:00Z</CreationDate>") != std::string::npos);
  CHECK(bytes->find("<CreationAuthor>A &amp; B</CreationAuthor>") != std::string::npos);
  // In front of the sign, which faces -x.
  CHECK(bytes->find("<CameraViewPoint><X>3.5</X><Y>2</Y><Z>2.2</Z></CameraViewPoint>"
                    "<CameraDirection><X>1</X><Y>0</Y><Z>0</Z></CameraDirection>") !=
        std::string::npos);
  CHECK(bytes == bcf_issues(assessment_with({area, route, lamp, sign, passed})));
}

TEST_CASE("an issue on a place of emphasis bears the GlobalId of its door", "[assess]") {
  AssessmentRecord a =
      assessment_with({issue_check({SubjectKind::emphasis, "door"}, CheckVerdict::fail)});
  a.places.emphasis.push_back({"door", "final_exit", {5, 2, 0}, lamp_guid});
  const auto bytes = bcf_issues(a);
  REQUIRE(bytes);
  CHECK(count_in(*bytes, "<Component IfcGuid=\"" + lamp_guid + "\"/>") == 1);
}

TEST_CASE("the camera of an issue is at the height of an eye above the floor below it",
          "[assess]") {
  const auto eye_height = [](const AssessmentRecord& a) {
    const auto bytes = bcf_issues(a);
    REQUIRE(bytes);
    const size_t eye = bytes->find("<CameraViewPoint>");
    const size_t from = bytes->find("<Z>", eye) + 3;
    return std::stod(bytes->substr(from, bytes->find("</Z>", from) - from));
  };
  const CheckRecord lamp = issue_check({SubjectKind::luminaire, "lamp"}, CheckVerdict::fail);
  AssessmentRecord a = assessment_with({lamp});
  a.plan.levels.resize(2);
  a.plan.levels[1].floor_m = 4;
  // A lamp at 2.9 m in a room; a higher area of the same outline, upstairs.
  CHECK(eye_height(a) == Approx(1.6));
  AreaRecord upstairs = a.places.areas.front();
  upstairs.z_m = 4;
  a.places.areas.push_back(upstairs);
  CHECK(eye_height(a) == Approx(1.6));
  a.luminaires.front().position.z = 6.9;
  CHECK(eye_height(a) == Approx(5.6));
  std::swap(a.places.areas.front(), a.places.areas.back());
  CHECK(eye_height(a) == Approx(5.6));
  // Over no area: the floor of the level.
  a.luminaires.front().position = {20, 20, 6.9};
  CHECK(eye_height(a) == Approx(5.6));
  // Below all floors that are known.
  a.luminaires.front().position.z = -1;
  CHECK(eye_height(a) == Approx(-1));
}

TEST_CASE("the identifier of an issue follows from ids alone", "[assess]") {
  CheckRecord after = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::fail);
  after.conditions = {remark(RemarkId::after_mains_failure, 5)};
  const auto topic = [](const CheckRecord& check) {
    const auto bytes = bcf_issues(assessment_with({check}));
    REQUIRE(bytes);
    const size_t from = bytes->find("<Topic Guid=\"") + 13;
    return bytes->substr(from, 36);
  };
  // Neither words nor results change it: not the title, the value, the limit, or which luminaire is
  // the worst. The constant holds it fast.
  const std::string guid = topic(after);
  CHECK(guid == "21a88adb-d9ee-8997-925f-98a530b6c353");
  CheckRecord same = after;
  same.rule.edition = "another name of the edition";
  same.rule.clause = "9.9";
  same.value = 0.2;
  same.limit = 0.6;
  same.reasons = {remark(RemarkId::no_value)};
  CHECK(topic(same) == guid);
  CheckRecord failed = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::fail);
  failed.conditions = {remark(RemarkId::luminaire_failed, "east")};
  CheckRecord other_lamp = failed;
  other_lamp.conditions = {remark(RemarkId::luminaire_failed, "west")};
  CHECK(topic(failed) == topic(other_lamp));
  // Rule, rule set, subject and time do, even if the texts of two times are equal.
  std::set<std::string> guids{guid, topic(failed)};
  CheckRecord other = after;
  other.rule.id = RuleId::E7;
  CHECK(guids.insert(topic(other)).second);
  other = after;
  other.rule.set = "en1838-2013";
  CHECK(guids.insert(topic(other)).second);
  other = after;
  other.subject = {SubjectKind::task_area, "hall"};
  CHECK(guids.insert(topic(other)).second);
  other = after;
  other.conditions = {remark(RemarkId::after_mains_failure, 5.0000001)};
  CHECK(english().remarks(other.conditions) == english().remarks(after.conditions));
  CHECK(guids.insert(topic(other)).second);
}

TEST_CASE("failed checks of equal identity are issues of their own", "[assess]") {
  const CheckRecord check = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::fail);
  const auto bytes = bcf_issues(assessment_with({check, check}));
  REQUIRE(bytes);
  CHECK(count_in(*bytes, "<Topic Guid=") == 2);
  const size_t first = bytes->find("<Topic Guid=\"");
  const size_t second = bytes->find("<Topic Guid=\"", first + 1);
  CHECK(bytes->substr(first, 49) != bytes->substr(second, 49));
}

TEST_CASE("without failed checks or GlobalIds there are no issues", "[assess]") {
  const CheckRecord passed = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::pass);
  const CheckRecord failed = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::fail);
  CHECK_FALSE(bcf_issues(assessment_with({passed})));
  AssessmentRecord of_no_model = assessment_with({failed});
  of_no_model.luminaires[0].ifc_guid = "";
  of_no_model.places.areas[0].ifc_guid = "";
  CHECK_FALSE(bcf_issues(of_no_model));
}
