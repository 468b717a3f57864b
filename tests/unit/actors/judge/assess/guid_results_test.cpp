// Tests results by GlobalId, which the program of the IFC model imports.
#include "actors/judge/assess/guid_results.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

LuminaireRecord luminaire(const char* name, const char* guid, double lm) {
  LuminaireRecord out;
  out.name = name;
  out.ifc_guid = guid;
  out.emergency_flux = {lm, "lm"};
  return out;
}

CheckRecord check(RuleId rule, const Subject& subject) {
  CheckRecord out;
  out.rule.id = rule;
  out.subject = subject;
  out.verdict = CheckVerdict::fail;
  return out;
}

SightRecord sight(const char* sign, SightVerdict verdict) {
  SightRecord out;
  out.sign = sign;
  out.verdict = verdict;
  return out;
}

/// An assessment with the parts that the table is made of.
AssessmentRecord small_assessment() {
  AssessmentRecord out;
  out.luminaires = {luminaire("lamp", "L1", 120), luminaire("other", "", 5)};
  SignRecord& exit = out.signs.emplace_back();
  exit.name = "exit";
  exit.ifc_guid = "S1";
  AreaRecord& hall = out.places.areas.emplace_back();
  hall.name = "hall";
  hall.ifc_guid = "R1";
  CheckRecord core = check(RuleId::E6, {SubjectKind::open_area, "hall"});
  core.value = 0.75;
  core.limit = 0.5;
  core.unit = "lx";
  core.verdict = CheckVerdict::pass;
  EmphasisRecord& door = out.places.emphasis.emplace_back();
  door.name = "door";
  door.ifc_guid = "D1";
  out.checks = {core, check(RuleId::E14, {SubjectKind::luminaire, "other"})};
  out.sights = {sight("exit", SightVerdict::legible), sight("exit", SightVerdict::invisible),
                sight("other", SightVerdict::legible)};
  return out;
}

}  // namespace

TEST_CASE("checks, fluxes and views are listed by the GlobalId of their thing", "[assess]") {
  const auto table = results_by_guid(small_assessment());
  REQUIRE(table);
  CHECK(table->text() ==
        "ifc_guid,kind,name,rule_set,rule,edition,clause,title,condition,value,unit,sense,limit,"
        "verdict,reason\n"
        "L1,luminaire,lamp,,,,,emergency flux,,120,lm,,,information,\n"
        "R1,space,hall,,E6,,," +
            english().rule_title("E6") +
            ",,0.75,lx,at least,0.5,pass,\n"
            "S1,sign,exit,,,,,views from which it is legible,,1,of 2,,,information,"
            "\"1 invisible, 1 legible\"\n");
}

TEST_CASE("a place of emphasis is listed by the GlobalId of its door", "[assess]") {
  AssessmentRecord assessment = small_assessment();
  assessment.checks = {check(RuleId::E12, {SubjectKind::emphasis, "door"})};
  const auto table = results_by_guid(assessment);
  REQUIRE(table);
  CHECK(table->text().find("D1,place of emphasis,door,,E12,") != std::string::npos);
}

TEST_CASE("without GlobalIds there is no table of results by GlobalId", "[assess]") {
  AssessmentRecord assessment = small_assessment();
  assessment.luminaires[0].ifc_guid = "";
  assessment.signs[0].ifc_guid = "";
  assessment.places.areas[0].ifc_guid = "";
  assessment.places.emphasis[0].ifc_guid = "";
  CHECK_FALSE(results_by_guid(assessment));
}

TEST_CASE("checks by GlobalId are properties with the measures of IFC", "[assess]") {
  AssessmentRecord assessment = small_assessment();
  assessment.checks[0].rule.set = "en1838-2024";
  CheckRecord& failure =
      assessment.checks.emplace_back(check(RuleId::F1, {SubjectKind::open_area, "hall"}));
  failure.verdict = CheckVerdict::information;
  const auto table = property_sets_by_guid(assessment);
  const std::string title = "E6 " + english().rule_title("E6");
  REQUIRE(table);
  CHECK(table->text() ==
        "GlobalId,PropertySet,Property,Value,ValueType,Unit\n"
        "L1,Luxodus_EmergencyLighting,EmergencyFlux,120,IfcLuminousFluxMeasure,lm\n"
        "R1,Luxodus_en1838-2024," +
            title + ": value,0.75,IfcIlluminanceMeasure,lx\n" + "R1,Luxodus_en1838-2024," + title +
            ": limit,0.5,IfcIlluminanceMeasure,lx\n" + "R1,Luxodus_en1838-2024," + title +
            ": verdict,pass,IfcLabel,\"\"\n" + "R1,Luxodus_Information,F1 " +
            english().rule_title("F1") + ": verdict,information,IfcLabel,\"\"\n");
}
