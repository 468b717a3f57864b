// Tests plans of several layouts on one page: each shows its own luminaires.
#include "actors/judge/design/side_by_side.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/assess/record_assessment.hpp"
#include "actors/judge/design/design_page.hpp"
#include "actors/judge/design/record_design.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

size_t count_of(const std::string& text, const std::string& what) {
  size_t count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

JudgedLayout judged(const char* name, const DesignResult& result) {
  JudgedLayout out;
  out.name = name;
  out.layout = result;
  out.placed = result.luminaires.size();
  out.objective = result.answer.objective;
  return out;
}

std::string room(const char* settings) {
  return test::box_room(12, 3, 3) + test::judged_2013 + test::way_along(1, 11, 1.5) +
         "[design]\nplace_signs = false\n" + settings;
}

}  // namespace

TEST_CASE("a page has the plans of all layouts that were judged, each with its luminaires",
          "[design][side]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.toml", room("failure = \"none\"\n"));
  const auto scene = test::described(file);
  DesignResult best = test::designed(file);
  const DesignResult more = test::designed(folder.write("full.toml", room("failure = \"full\"\n")));
  REQUIRE(more.luminaires.size() > best.luminaires.size());
  const std::string last = more.luminaires.back().name;
  const AssessmentRecord assessed = record_of(*best.variant, best.assessment, "1");
  CHECK(layout_plans(best, "1").empty());
  const std::string alone =
      design_page(record_of(*scene, best, "1"), assessed, layout_plans(best, "1"), Language::en);
  CHECK(alone.find("side by side") == std::string::npos);

  best.smoke.emplace();
  best.smoke->layouts = {judged("A", best), judged("B", more), judged("A low", best)};
  best.smoke->layouts[2].sign_factor = 2;  // as A, with other signs
  const auto plans = layout_plans(best, "1");
  REQUIRE(plans.size() == 2);
  const Texts texts(Language::en);
  const std::string section = side_by_side(texts, record_of(*scene, best, "1"), plans);
  CHECK(count_of(section, "<figure>") == 2);
  CHECK(section.find("A, recommended: ") != std::string::npos);
  CHECK(section.find(fmt::format("B: {} new luminaires", more.luminaires.size())) !=
        std::string::npos);
  // The last luminaire of the other layout is in its plan only.
  const size_t second = section.find("<figure>", section.find("<figure>") + 1);
  CHECK(section.substr(0, second).find(">" + last + "<") == std::string::npos);
  CHECK(section.find(">" + last + "<", second) != std::string::npos);
}

}  // namespace luxodus
