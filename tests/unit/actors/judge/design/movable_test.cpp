// Tests luminaires of the scene that may be moved: they stay if that is enough, and the variant on
// disk has them where the design says.
#include <catch2/catch.hpp>

#include "actors/judge/design/candidates.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::designed;
using test::TemporaryFolder;
namespace fs = std::filesystem;

std::string old_one(const char* name, const char* at, const char* more = "") {
  return fmt::format(R"(
[[emitter]]
name = "{}"
shape = "disc"
diameter = 0.1
position = {}
flux_lm = 300
emergency = "non-maintained"
emergency_flux = 300
maintenance_factor = 0.8
end_of_duration_factor = 0.7
{}
)",
                     name, at, more);
}

/// A corridor with two luminaires at one end.
std::string crowded(const std::string& settings) {
  return test::box_room(12, 3, 3) + test::judged_2013 + test::way_along(1, 11, 1.5) +
         old_one("near the wall", "[0.8, 0.8, 2.97]") + old_one("beside it", "[0.8, 2.2, 2.97]") +
         "[design]\nplace_signs = false\nfailure = \"none\"\n" + settings;
}

/// Two rooms, one above the other.
std::string two_storeys() {
  std::string upper = test::box_room(12, 3, 2.8);
  upper.replace(upper.find("low = [0, 0, 0]"), 15, "low = [0, 0, 3]");
  upper.replace(upper.find("2.8]"), 4, "5.8]");
  upper.replace(upper.find("\"room\""), 6, "\"upper\"");
  return test::box_room(12, 3, 2.8) + upper;
}

std::vector<LuminaireCandidate> candidates_in(const fs::path& file) {
  const auto scene = test::described(file);
  const auto codes = judged_codes(*scene, {}, {});
  REQUIRE(codes);
  const auto found = find_candidates(*scene, *scene->design, codes.value(), scene->scenarios[0], 1);
  INFO((found ? "" : found.problem().text()));
  REQUIRE(found);
  return found->all;
}

size_t new_ones(const DesignResult& result) {
  return static_cast<size_t>(std::count_if(result.luminaires.begin(), result.luminaires.end(),
                                           [](const PlacedLuminaire& o) { return o.is_new(); }));
}

size_t moved_ones(const DesignResult& result) {
  return static_cast<size_t>(
      std::count_if(result.luminaires.begin(), result.luminaires.end(),
                    [](const PlacedLuminaire& o) { return o.moved_from.has_value(); }));
}

}  // namespace

TEST_CASE("movable luminaires save new ones, and the variant on disk has them at their new places",
          "[design][movable]") {
  const TemporaryFolder folder;
  const auto fixed = designed(folder.write("fixed.toml", crowded("")));
  const fs::path file = folder.write("scene.toml", crowded("existing = \"movable\"\n"));
  const auto result = designed(file);
  CHECK(result.answer.end == LayoutEnd::optimal);
  CHECK(new_ones(result) < new_ones(fixed));
  REQUIRE(moved_ones(result) >= 1);
  CHECK(result.removed.empty());
  // Each moved luminaire counts as a quarter, and each that stays counts nothing.
  CHECK(result.answer.objective == Approx(static_cast<double>(new_ones(result)) +
                                          0.25 * static_cast<double>(moved_ones(result))));
  CHECK(test::failing_on_disk(folder, file, result).empty());
  const auto on_disk = test::described(folder.path() / "layout.toml");
  REQUIRE(on_disk->emitters.size() == result.luminaires.size());
  for (const PlacedLuminaire& one : result.luminaires) {
    INFO(one.name);
    const auto is_it = [&](const Emitter& e) { return e.name == one.name; };
    const auto there = std::find_if(on_disk->emitters.begin(), on_disk->emitters.end(), is_it);
    const auto& variant = result.variant->emitters;
    const auto planned = std::find_if(variant.begin(), variant.end(), is_it);
    REQUIRE(there != on_disk->emitters.end());
    REQUIRE(planned != variant.end());
    CHECK(glm::length(there->frame.origin - one.candidate.position) < 1e-6);
    for (int axis = 0; axis < 3; ++axis)
      CHECK(glm::length(there->frame.axes[axis] - planned->frame.axes[axis]) < 1e-6);
    if (one.moved_from) CHECK(one.moved_from->x == Approx(0.8));
  }
  const std::string schedule = schedule_csv(result).text();
  CHECK(schedule.find(",moved,") != std::string::npos);
}

TEST_CASE("the cost of a move decides between moving and a new luminaire", "[design][movable]") {
  const TemporaryFolder folder;
  const auto with = [&](const char* cost) {
    return designed(folder.write(
        "scene.toml",
        crowded(fmt::format("movable = [\"near the wall\"]\nmove_cost = {}\n", cost))));
  };
  const auto cheap = with("0.1"), dear = with("3");
  CHECK(moved_ones(cheap) == 1);
  CHECK(moved_ones(dear) == 0);
  CHECK(new_ones(cheap) < new_ones(dear));
  // The other one is fixed.
  CHECK(cheap.luminaires.front().name == "beside it");
  CHECK(cheap.luminaires.front().candidate.position.y == Approx(2.2));
}

TEST_CASE("a luminaire on a wall moves only to walls and keeps its tilt", "[design][movable]") {
  const TemporaryFolder folder;
  const auto candidates = candidates_in(folder.write(
      "scene.toml", test::box_room(12, 3, 3) + test::judged_2013 + test::way_along(1, 11, 1.5) +
                        old_one("bulkhead", "[6, 0.05, 2.3]", "direction = [0, 1, -1]") +
                        "[design]\nexisting = \"movable\"\nspacing_m = 2\n[[design.type]]\nname "
                        "= \"down\"\nlike = \"bulkhead\"\n"));
  size_t moves = 0;
  for (const LuminaireCandidate& one : candidates) {
    if (!one.moved) continue;
    ++moves;
    REQUIRE(one.aim);
    CHECK(one.aim->z == Approx(-std::sqrt(0.5)).margin(1e-5));  // 45 degrees, as before
    CHECK(one.position.z == Approx(2.3));
  }
  CHECK(moves > 4);
}

TEST_CASE("a luminaire moves only within its storey", "[design][movable]") {
  const TemporaryFolder folder;
  const auto candidates = candidates_in(folder.write(
      "scene.toml", two_storeys() + test::judged_2013 + test::way_along(1, 11, 1.5) +
                        test::route("above", "[1, 1.5, 3], [11, 1.5, 3]") +
                        old_one("old", "[6, 1.5, 5.77]") + "[design]\nexisting = \"movable\"\n"));
  size_t above = 0, below = 0;
  for (const LuminaireCandidate& one : candidates) {
    if (one.moved) CHECK(one.position.z > 3);
    above += one.moved ? 1 : 0;
    below += one.position.z < 3 ? 1 : 0;  // new ones
  }
  CHECK(above >= 10);
  CHECK(below >= 10);
}

TEST_CASE("without a floor below it a luminaire moves to places of about its height",
          "[design][movable]") {
  const auto bench = [](const char* name, double z) {
    return fmt::format(
        "[[task_area]]\nname = \"{}\"\noutline = [[1, 0.5], [11, 0.5], [11, 2.5], [1, 2.5]]\n"
        "z = {}\nmains_lx = 500\n",
        name, z);
  };
  const TemporaryFolder folder;
  // Task areas are no floors.
  const auto candidates = candidates_in(folder.write(
      "scene.toml", two_storeys() + test::judged_2013 + bench("low", 0.8) + bench("high", 3.8) +
                        old_one("old", "[6, 1.5, 5.77]") + "[design]\nexisting = \"movable\"\n"));
  size_t moves = 0;
  for (const LuminaireCandidate& one : candidates) {
    if (!one.moved) continue;
    ++moves;
    CHECK(one.position.z > 3);
  }
  CHECK(moves >= 10);
}

TEST_CASE("the default cost of a move is a share of the lightest type that may be placed",
          "[design][movable]") {
  const auto type = [](const char* name, const char* hours, int cost) {
    return old_one(name, "[11, 1.5, 2.97]", fmt::format("duration_h = {}", hours).c_str()) +
           fmt::format("[[design.type]]\nname = \"{0}, new\"\nlike = \"{0}\"\ncost = {1}\n", name,
                       cost);
  };
  const TemporaryFolder folder;
  // The cheap type does not last an hour, as EN 1838 requires.
  const auto scene = test::described(folder.write(
      "scene.toml", test::box_room(12, 3, 3) + test::judged_2013 + test::way_along(1, 11, 1.5) +
                        old_one("old", "[0.8, 0.8, 2.97]") +
                        "[design]\nexisting = \"removed\"\nmovable = [\"old\"]\nobjective = "
                        "\"cost\"\nplace_signs = false\n" +
                        type("short", "0.5", 1) + type("long", "1", 100)));
  const auto codes = judged_codes(*scene, {}, {});
  REQUIRE(codes);
  const Scenario& doors = scene->scenarios[0];
  const auto found = find_candidates(*scene, *scene->design, codes.value(), doors, 1);
  REQUIRE(found);
  REQUIRE(found->unused.size() == 1);
  const auto demands = Demands::make(*scene, *scene->design, found->all, codes.value(), doors, 1);
  INFO((demands ? "" : demands.problem().text()));
  REQUIRE(demands);
  const auto& options = demands.value()->problem().options;
  size_t moves = 0;
  for (size_t i = 0; i < options.size(); ++i) {
    if (!found->all[i].moved) continue;
    ++moves;
    CHECK(options[i].weight == Approx(0.25 * 100));
  }
  CHECK(moves > 0);
}

TEST_CASE("a luminaire that violates a rule at its place must move, or the design is refused",
          "[design][movable]") {
  // 1.9 m above the floor is too low (E14).
  const std::string low = test::box_room(12, 3, 3) + test::judged_2013 +
                          test::way_along(1, 11, 1.5) + old_one("low", "[6, 1.5, 1.9]") +
                          "[design]\nplace_signs = false\nfailure = \"none\"\n";
  const TemporaryFolder folder;
  const auto moved = designed(folder.write("scene.toml", low + "existing = \"movable\"\n"));
  REQUIRE(moved_ones(moved) == 1);
  CHECK(moved.luminaires.front().candidate.position.z == Approx(2.97));
  const auto refused = test::tried(
      folder.write("none.toml", low + "existing = \"movable\"\nplaces = [[3, 1.5, 1.8]]\n"));
  REQUIRE_FALSE(refused);
  CHECK(refused.problem().text().find("no place to move it to") != std::string::npos);
}

}  // namespace luxodus
