// Tests results by GlobalId, which the program of the IFC model imports.
#include "actors/judge/assess/guid_results.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/texts/remark_json.hpp"

using namespace luxodus;

namespace {

/// An assessment with the parts that the table is made of.
Json small_assessment() {
  return {{"luminaires",
           {{{"name", "lamp"},
             {"ifc_guid", "L1"},
             {"emergency_flux", {{"value", 120.0}, {"unit", "lm"}}}},
            {{"name", "other"}, {"emergency_flux", {{"value", 5.0}, {"unit", "lm"}}}}}},
          {"signs", {{{"name", "exit"}, {"ifc_guid", "S1"}}}},
          {"places", {{"areas", {{{"name", "hall"}, {"kind", "open"}, {"ifc_guid", "R1"}}}}}},
          {"checks",
           {{{"subject", subject_json({SubjectKind::open_area, "hall"})},
             {"rule", "E6"},
             {"title", "core"},
             {"value", 0.75},
             {"limit", 0.5},
             {"unit", "lx"},
             {"verdict", "pass"}},
            {{"subject", subject_json({SubjectKind::luminaire, "other"})},
             {"rule", "E14"},
             {"verdict", "fail"}}}},
          {"sights",
           {{{"sign", "exit"}, {"verdict", "legible"}},
            {{"sign", "exit"}, {"verdict", "hidden"}},
            {{"sign", "other"}, {"verdict", "legible"}}}}};
}

}  // namespace

TEST_CASE("checks, fluxes and views are listed by the GlobalId of their thing", "[assess]") {
  const auto table = results_by_guid(small_assessment());
  REQUIRE(table);
  CHECK(table->text() ==
        "ifc_guid,kind,name,rule_set,rule,edition,clause,title,condition,value,unit,sense,limit,"
        "verdict,reason\n"
        "L1,luminaire,lamp,,,,,emergency flux,,120,lm,,,information,\n"
        "R1,space,hall,,E6,,,core,,0.75,lx,,0.5,pass,\n"
        "S1,sign,exit,,,,,views from which it is legible,,1,of 2,,,information,"
        "\"1 hidden, 1 legible\"\n");
}

TEST_CASE("without GlobalIds there is no table of results by GlobalId", "[assess]") {
  Json assessment = small_assessment();
  assessment["luminaires"][0].erase("ifc_guid");
  assessment["signs"][0].erase("ifc_guid");
  assessment["places"]["areas"][0].erase("ifc_guid");
  CHECK_FALSE(results_by_guid(assessment));
}

TEST_CASE("checks by GlobalId are properties with the measures of IFC", "[assess]") {
  Json assessment = small_assessment();
  assessment["checks"][0]["rule_set"] = "en1838-2024";
  assessment["checks"].push_back({{"subject", subject_json({SubjectKind::open_area, "hall"})},
                                  {"rule", "F1"},
                                  {"rule_set", ""},
                                  {"title", "one failed"},
                                  {"verdict", "information"}});
  const auto table = property_sets_by_guid(assessment);
  REQUIRE(table);
  CHECK(table->text() ==
        "GlobalId,PropertySet,Property,Value,ValueType,Unit\n"
        "L1,Luxodus_EmergencyLighting,EmergencyFlux,120,IfcLuminousFluxMeasure,lm\n"
        "R1,Luxodus_en1838-2024,E6 core: value,0.75,IfcIlluminanceMeasure,lx\n"
        "R1,Luxodus_en1838-2024,E6 core: limit,0.5,IfcIlluminanceMeasure,lx\n"
        "R1,Luxodus_en1838-2024,E6 core: verdict,pass,IfcLabel,\"\"\n"
        "R1,Luxodus_Information,F1 one failed: verdict,information,IfcLabel,\"\"\n");
}
