// Tests minima between the points of the grid: if light ends sharply, a gap may lie between two
// points, and a layout must have none there.
#include <catch2/catch.hpp>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

/// A corridor under spots of 45 degrees at 2.97 m, which light 2.95 m on each side. Points are 0.25
/// m apart, starting at `from`. Between the light of the first two places lie 0.1 m without light,
/// from 5.95 m to 6.05 m.
std::string corridor_with_gap(double from) {
  return test::box_room(12, 2, 3) + test::judged_2013 + test::spot_of_45_deg +
         fmt::format(R"(
[[route]]
name = "corridor"
path = [[{}, 1, 0], [{}, 1, 0]]
width = 0.3

[design]
existing = "removed"
place_signs = false
failure = "none"
margin = 1
place_tolerance_m = 0
places = [[3, 1, 2.97], [9, 1, 2.97], [6, 1, 2.97]]
)",
                     from, from + 10.75);
}

}  // namespace

TEST_CASE("every minimum holds between the points of the grid as well", "[design][between]") {
  const test::TemporaryFolder folder;
  // A point lies in the gap, at 6 m.
  const auto seen = test::designed(folder.write("seen.toml", corridor_with_gap(0.5)));
  CHECK(seen.luminaires.size() == 3);
  CHECK(seen.between.added == 0);
  // The gap lies between the points at 5.875 m and 6.125 m.
  const auto hidden = test::designed(folder.write("hidden.toml", corridor_with_gap(0.625)));
  CHECK(hidden.between.added > 0);
  CHECK(hidden.luminaires.size() == 3);
  CHECK(hidden.between.least >= 1);
  CHECK(hidden.verifications == 2);
}

TEST_CASE("no points are added between others if the light varies smoothly", "[design][between]") {
  const test::TemporaryFolder folder;
  const auto result = test::designed(folder.write(
      "scene.toml", test::box_room(9, 3, 3) + test::judged_2013 + test::way_along(1, 8, 1.5) +
                        "[design]\nplace_signs = false\nfailure = \"none\"\n"));
  CHECK(result.between.added == 0);
  CHECK(result.between.least > 0.99);
  CHECK(result.between.least < 5);
}

namespace {

/// A corridor under two spots that light 2.95 m on each side, refined from these places on.
DesignResult refined_spots(const test::TemporaryFolder& folder, const std::string& path,
                           const std::string& places) {
  DesignOptions options;
  options.refine = true;
  return test::designed(
      folder.write("scene.toml",
                   test::box_room(12, 2, 3) + test::judged_2013 + test::spot_of_45_deg +
                       test::route("corridor", path, 0.3) +
                       "[design]\nexisting = \"removed\"\nplace_signs = false\n"
                       "failure = \"none\"\nmargin = 1\nplace_tolerance_m = 0\nplaces = " +
                       places + "\nspacing_m = 0.5\n"),
      options);
}

/// Requires that the spots leave no gap at 6 m, in the middle between them.
void check_that_cones_meet(const DesignResult& result) {
  REQUIRE(result.luminaires.size() == 2);
  constexpr double lit_m = 2.95;
  double nearest = lit_m;
  for (const PlacedLuminaire& one : result.luminaires)
    nearest = std::min(nearest, std::abs(one.candidate.position.x - 6));
  CHECK(nearest < lit_m);
  CHECK(result.between.least > 0.99);
}

}  // namespace

TEST_CASE("moving luminaires opens no gap between the points of the grid",
          "[design][between][refine]") {
  const test::TemporaryFolder folder;
  // Spots at 3.06 m and 8.94 m light the whole route. Its ends and the points at 5.875 m and 6.125
  // m would be brightest under spots at 3 m and 9 m, which leave 0.1 m in the middle dark. Wherever
  // they are moved, their cones hardly meet, and the assessment finds a dark sliver: they stay.
  const auto stays =
      refined_spots(folder, "[0.125, 1, 0], [11.875, 1, 0]", "[[3.06, 1, 2.97], [8.94, 1, 2.97]]");
  check_that_cones_meet(stays);
  CHECK_FALSE(stays.refined);
  // The ends of a shorter route are brighter under spots that are farther apart, and still meet.
  const auto moves =
      refined_spots(folder, "[0.375, 1, 0], [11.625, 1, 0]", "[[3.25, 1, 2.97], [8.75, 1, 2.97]]");
  check_that_cones_meet(moves);
  REQUIRE(moves.refined);
  CHECK(moves.refined->after > moves.refined->before);
}

}  // namespace luxodus
