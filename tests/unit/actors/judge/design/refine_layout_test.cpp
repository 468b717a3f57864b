// Tests luminaires that are moved between places of the grid: the best place is known by symmetry,
// and moving loses nothing.
#include "actors/judge/design/refine_layout.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/design/design_files.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

std::string way_in_a_room(double length, const char* settings) {
  return test::box_room(length, 4, 3) + test::judged_2013 + test::way_along(1, length - 1, 2) +
         "[design]\nplace_signs = false\nfailure = \"none\"\n" + settings + "\n";
}

DesignResult refined(const TemporaryFolder& folder, const std::string& scene, bool refine) {
  DesignOptions options;
  options.refine = refine;
  return test::designed(folder.write("scene.toml", scene), options);
}

}  // namespace

TEST_CASE("one luminaire beside the middle of a route moves to the middle", "[design][refine]") {
  // By symmetry the darkest ends are brightest if both are equally far away.
  const TemporaryFolder folder;
  const DesignResult result =
      refined(folder, way_in_a_room(6, "places = [[2.7, 2, 2.97]]\nspacing_m = 1\n"), true);
  REQUIRE(result.luminaires.size() == 1);
  REQUIRE(result.refined);
  CHECK(result.refined->moved == 1);
  const LuminaireCandidate& moved = result.luminaires.front().candidate;
  CHECK(moved.position.x == Approx(3).margin(0.1));
  // The floor below decides which demands apply to a luminaire over a route.
  CHECK(moved.floor.x == Approx(moved.position.x).margin(1e-3));
  CHECK(moved.floor.y == Approx(moved.position.y).margin(1e-3));
  CHECK(result.refined->after > result.refined->before);
}

TEST_CASE("moving keeps the number of luminaires, its range and the rules, and is reproducible",
          "[design][refine]") {
  for (const double length : {9.0, 13.0}) {
    INFO("length " << length);
    const TemporaryFolder folder;
    const std::string scene = way_in_a_room(length, "spacing_m = 1.2\n");
    const DesignResult before = refined(folder, scene, false);
    const DesignResult after = refined(folder, scene, true);
    const DesignResult again = refined(folder, scene, true);
    CHECK_FALSE(before.refined);
    REQUIRE(after.luminaires.size() == before.luminaires.size());
    for (const PlacedLuminaire& one : after.luminaires) {
      double nearest = 1e9;
      for (const PlacedLuminaire& other : before.luminaires) {
        const glm::dvec3 off = one.candidate.position - other.candidate.position;
        nearest = std::min(nearest, std::max(std::abs(off.x), std::abs(off.y)));
      }
      CHECK(nearest <= 0.6 + 1e-3);
    }
    for (const Check& check : after.assessment.checks)
      if (test::is_of_luminaires(check.rule.id)) CHECK(check.verdict != CheckVerdict::fail);
    if (after.refined) CHECK(after.refined->after >= after.refined->before);
    const auto read = test::described(folder.path() / "scene.toml");
    CHECK(variant_text(*read, after, after, folder.path()) ==
          variant_text(*read, again, again, folder.path()));
  }
}

TEST_CASE("no luminaire is moved into a keep-out zone", "[design][refine]") {
  const TemporaryFolder folder;
  const DesignResult result =
      refined(folder,
              way_in_a_room(6,
                            "places = [[2.5, 2, 2.97]]\nspacing_m = 1\n[[design.keep_out]]\nname = "
                            "\"detector\"\nposition = [3, 2, 3]\nradius = 0.35\n"),
              true);
  REQUIRE(result.luminaires.size() == 1);
  CHECK(glm::length(glm::dvec2(result.luminaires.front().candidate.position) - glm::dvec2(3, 2)) >=
        0.35 - 1e-3);
}

}  // namespace luxodus
