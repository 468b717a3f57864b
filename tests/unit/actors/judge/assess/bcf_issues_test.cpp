// Failed checks as issues of BCF 2.1.
#include "actors/judge/assess/bcf_issues.hpp"

#include <catch2/catch.hpp>

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

TEST_CASE("without failed checks or GlobalIds there are no issues", "[assess]") {
  const CheckRecord passed = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::pass);
  const CheckRecord failed = issue_check({SubjectKind::open_area, "hall"}, CheckVerdict::fail);
  CHECK_FALSE(bcf_issues(assessment_with({passed})));
  AssessmentRecord of_no_model = assessment_with({failed});
  of_no_model.luminaires[0].ifc_guid = "";
  of_no_model.places.areas[0].ifc_guid = "";
  CHECK_FALSE(bcf_issues(of_no_model));
}
