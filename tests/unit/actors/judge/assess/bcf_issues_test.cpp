// Failed checks as issues of BCF 2.1.
#include "actors/judge/assess/bcf_issues.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/texts/remark_json.hpp"
#include "scenes/emergency/remark.hpp"

using namespace luxodus;

namespace {

const std::string space_guid = "1L0000000000000007NPqM", lamp_guid = "1L0000000000000007Nj9i";

Json issue_check(const Subject& subject, const char* verdict) {
  return {{"subject", subject_json(subject)},
          {"rule", "E6"},
          {"rule_set", "en1838-2024"},
          {"edition", "EN 1838:2024"},
          {"clause", "4.3"},
          {"title", "core <area>"},
          {"conditions", Json::array()},
          {"value", 0.3},
          {"limit", 0.5},
          {"unit", "lx"},
          {"sense", "at least"},
          {"verdict", verdict}};
}

Json assessment_with(const Json& checks) {
  const Json outline = {{0.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}, {0.0, 4.0}};
  return {
      {"scene", {{"name", "house"}}},
      {"project", {{"author", "A & B"}, {"date", "2026-05-31"}}},
      {"luminaires", {{{"name", "lamp"}, {"ifc_guid", lamp_guid}, {"position", {3.0, 2.0, 2.9}}}}},
      {"signs", {{{"name", "exit"}, {"position", {6.0, 2.0, 2.2}}, {"facing", {-1.0, 0.0, 0.0}}}}},
      {"places",
       {{"areas",
         {{{"name", "hall"},
           {"kind", "open"},
           {"outline", outline},
           {"z", 0.0},
           {"ifc_guid", space_guid}}}},
        {"routes", {{{"name", "way"}, {"path", {{1.0, 1.0, 0.0}, {5.0, 1.0, 0.0}}}}}},
        {"emphasis", Json::array()}}},
      {"checks", checks}};
}

size_t count_in(const std::string& text, const std::string& what) {
  size_t count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("each failed check is an issue with a camera and GlobalIds", "[assess]") {
  Json area = issue_check({SubjectKind::open_area, "hall"}, "fail");
  area["worst_place"] = {0.5, 0.5, 0.0};
  const Json route = issue_check({SubjectKind::route, "way"}, "fail");
  const Json lamp = issue_check({SubjectKind::luminaire, "lamp"}, "fail");
  const Json sign = issue_check({SubjectKind::sign, "exit"}, "fail");
  const Json passed = issue_check({SubjectKind::luminaire, "lamp"}, "pass");
  const auto bytes = bcf_issues(assessment_with({area, route, lamp, sign, passed}));
  REQUIRE(bytes);
  CHECK(bytes->find("<Version VersionId=\"2.1\">") != std::string::npos);
  CHECK(count_in(*bytes, "<Topic Guid=") == 4);
  CHECK(count_in(*bytes, "<VisualizationInfo Guid=") == 4);
  CHECK(count_in(*bytes, "<PerspectiveCamera>") == 4);
  // The area and the luminaire bear a GlobalId; the route lies in the space.
  CHECK(count_in(*bytes, "<Component IfcGuid=\"" + space_guid + "\"/>") == 2);
  CHECK(count_in(*bytes, "<Component IfcGuid=\"" + lamp_guid + "\"/>") == 1);
  CHECK(bytes->find("core &lt;area&gt;") != std::string::npos);
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
  const Json passed = issue_check({SubjectKind::open_area, "hall"}, "pass");
  const Json failed = issue_check({SubjectKind::open_area, "hall"}, "fail");
  CHECK_FALSE(bcf_issues(assessment_with(Json::array({passed}))));
  Json of_no_model = assessment_with(Json::array({failed}));
  of_no_model["luminaires"][0].erase("ifc_guid");
  of_no_model["places"]["areas"][0].erase("ifc_guid");
  CHECK_FALSE(bcf_issues(of_no_model));
}
