#include "actors/judge/assess/check_words.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/texts/remark_json.hpp"

using namespace luxodus;

TEST_CASE("the line of a check has no empty brackets, and no unit or value that it lacks",
          "[assess]") {
  Json check = {{"subject", subject_json({SubjectKind::route, "stairs"})},
                {"title", "Largest over smallest illuminance"},
                {"rule", "E4"},
                {"conditions", Json::array()},
                {"value", 116.0},
                {"unit", "1"},
                {"limit", 40.0},
                {"sense", "at most"}};
  CHECK(check_words(check) ==
        "route \"stairs\": Largest over smallest illuminance: 116, at most 40 (E4)");
  check["value"] = nullptr;
  CHECK(check_words(check) ==
        "route \"stairs\": Largest over smallest illuminance: no value, at most 40 (E4)");
  check["reasons"] = remarks_json({remark(RemarkId::no_sign_ahead)});
  check["conditions"] = remarks_json({remark(RemarkId::without_furniture)});
  CHECK(check_words(check) ==
        "route \"stairs\": Largest over smallest illuminance: no sign ahead faces this place, at "
        "most 40 (E4, without furniture)");
  check["value"] = 1.25;
  check["unit"] = "of the viewing distance";
  check["limit"] = nullptr;
  CHECK(check_words(check).find("1.25 of the viewing distance (E4") != std::string::npos);
  check["unit"] = "lx";
  CHECK(check_words(check).find("1.25 lx (E4") != std::string::npos);
}
