// Tests luminaires on walls: where they hang, that the layout on disk agrees, and that they pass
// the assessment.
#include "actors/judge/design/wall_places.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/design/design.hpp"
#include "actors/judge/design/design_files.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::TemporaryFolder;

/// A corridor of 2 m, with a bulkhead as the model of a type, which is removed.
std::string wall_scene(const char* settings) {
  return test::box_room(12, 2, 3) + test::judged_2013 + R"(
[[emitter]]
name = "bulkhead"
shape = "disc"
diameter = 0.2
position = [6, 1, 2.97]
flux_lm = 400
emergency = "non-maintained"
emergency_flux = 400
maintenance_factor = 0.8
end_of_duration_factor = 0.8
)" + test::way_along(1, 11, 1) +
         "[design]\nplace_signs = false\nexisting = \"removed\"\n" + settings + "\n";
}

const char* const on_walls = R"(
[[design.type]]
name = "wall light"
like = "bulkhead"
mount = "wall"
aim_deg = 60
)";

DesignResult on_the_walls(const std::filesystem::path& file) {
  DesignOptions options;
  options.threads = 2;
  auto result = design(test::described(file), options, test::nobody, test::silent);
  INFO((result ? "" : result.problem().text()));
  REQUIRE(result);
  return std::move(result).value();
}

}  // namespace

TEST_CASE("luminaires on walls hang in front of them and pass the assessment", "[design][walls]") {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", wall_scene("wall_height_m = 2.2\n") + on_walls);
  const DesignResult result = on_the_walls(file);
  REQUIRE(result.luminaires.size() >= 2);  // two over the route
  for (const PlacedLuminaire& one : result.luminaires) {
    const glm::dvec3& p = one.candidate.position;
    CHECK(p.z == Approx(2.2));
    CHECK(std::min({p.y, 2 - p.y}) == Approx(0.03).margin(1e-3));
    REQUIRE(one.candidate.aim);
    // Away from the wall, and 60 degrees from straight down.
    CHECK(one.candidate.aim->y * (p.y < 1 ? 1 : -1) == Approx(std::sqrt(0.75)).margin(1e-5));
    CHECK(one.candidate.aim->z == Approx(-0.5).margin(1e-5));
  }
  for (const Check& check : result.assessment.checks)
    if (test::is_of_luminaires(check.rule.id)) CHECK(check.verdict != CheckVerdict::fail);
}

TEST_CASE("the file of a layout has luminaires on walls where the design placed them",
          "[design][walls]") {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", wall_scene("") + on_walls);
  const DesignResult result = on_the_walls(file);
  const auto read = test::described(folder.write(
      "layout.toml", variant_text(*test::described(file), result, result, folder.path())));
  REQUIRE(read->emitters.size() == result.variant->emitters.size());
  for (size_t i = 0; i < read->emitters.size(); ++i) {
    const Frame &a = read->emitters[i].frame, &b = result.variant->emitters[i].frame;
    CHECK(glm::length(a.origin - b.origin) < 1e-4);
    for (int axis = 0; axis < 3; ++axis) CHECK(glm::length(a.axes[axis] - b.axes[axis]) < 1e-4);
  }
}

TEST_CASE("a luminaire on a wall that faces straight down is off its place along the wall or up it",
          "[design][walls][tolerance]") {
  const auto min_of = [](const char* aim_deg) {
    const TemporaryFolder folder;
    std::string types = on_walls;
    types.replace(types.find("60"), 2, aim_deg);
    const DesignResult result =
        on_the_walls(folder.write("scene.toml", wall_scene("failure = \"none\"\n") + types));
    REQUIRE_FALSE(result.luminaires.empty());
    std::vector<LuminaireCandidate> chosen;
    for (const PlacedLuminaire& one : result.luminaires) {
      REQUIRE(one.candidate.outward);
      CHECK(std::abs(one.candidate.outward->y) == Approx(1));
      chosen.push_back(one.candidate);
    }
    const auto scene = test::described(folder.path() / "scene.toml");
    const auto codes = judged_codes(*scene, {}, {});
    REQUIRE(codes);
    // So far that horizontal displacements out of the wall would change the result by several per
    // cent.
    DesignSettings far_off = *scene->design;
    far_off.place_tolerance_m = 0.6;
    const auto found =
        tolerance_of(*scene, far_off, chosen, codes.value(), scene->scenarios.front(), 2);
    REQUIRE(found);
    return std::pair{chosen.size(), found->least()};
  };
  // One degree changes the light little, and must not change the directions of displacement.
  const auto down = min_of("0"), nearly = min_of("1");
  REQUIRE(down.first == nearly.first);
  CHECK(down.second == Approx(nearly.second).epsilon(0.03));
}

TEST_CASE("types for ceilings and for walls compete with each other", "[design][walls]") {
  const TemporaryFolder folder;
  const std::string both = wall_scene("objective = \"cost\"\n") + on_walls + R"(cost = 3
[[design.type]]
name = "ceiling light"
like = "bulkhead"
cost = 1
)";
  const DesignResult result = on_the_walls(folder.write("scene.toml", both));
  REQUIRE_FALSE(result.luminaires.empty());
  // The ceiling lights more of the floor at a lower cost.
  for (const PlacedLuminaire& one : result.luminaires) CHECK_FALSE(one.candidate.aim);
}

TEST_CASE("no luminaire hangs on a wall in a keep-out zone", "[design][walls]") {
  const TemporaryFolder folder;
  const DesignResult result = on_the_walls(folder.write(
      "scene.toml",
      wall_scene("") + on_walls +
          "[[design.keep_out]]\nname = \"door\"\nposition = [4, 0, 2]\nradius = 1.5\n"));
  CHECK(result.left_out.keep_out > 0);
  for (const PlacedLuminaire& one : result.luminaires)
    CHECK(glm::length(glm::dvec2(one.candidate.position) - glm::dvec2(4, 0)) >= 1.5);
}

}  // namespace luxodus
