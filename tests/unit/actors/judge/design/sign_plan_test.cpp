// Tests signs of a design: every place of a route is guided, in an assessment of the layout on disk
// and by the rules of guidance; arrows point along the route.
#include "actors/judge/design/sign_plan.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "actors/judge/assess/clear_signs.hpp"
#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/design/design.hpp"
#include "actors/judge/design/design_files.hpp"
#include "runtime/core/random.hpp"
#include "scenes/emergency/guidance.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/ctrl_c.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

using test::route;
using test::TemporaryFolder;
namespace fs = std::filesystem;

std::string hall(double x, double y, double z) {
  return test::box_room(x, y, z) + test::judged_2013;
}

std::string partition(const char* name, const char* low, const char* high) {
  return fmt::format(
      "[[object]]\nname = \"{}\"\nshape = \"box\"\nlow = [{}]\nhigh = [{}]\nmaterial = "
      "\"white50\"\n",
      name, low, high);
}

DesignResult designed_with_signs(const fs::path& file) {
  DesignOptions options;
  options.gap = 0.2;
  options.what_binds = false;
  return test::designed(file, options);
}

/// The scene of the layout, read from its file.
std::shared_ptr<const SceneDescription> read_back(const TemporaryFolder& folder,
                                                  const fs::path& file,
                                                  const DesignResult& result) {
  return test::described(folder.write(
      "layout.toml", variant_text(*test::described(file), result, result, folder.path())));
}

/// Places on routes that no sign guides within its viewing distance.
std::vector<std::string> unguided_places(const SceneDescription& scene) {
  const auto building =
      Building::make(code_scene(scene, true), code_scenario(scene, scene.scenarios.front()), 2);
  REQUIRE(building);
  std::vector<std::string> out;
  for (const EscapeRoute& way : scene.routes) {
    const auto people = walkers(way, scene.assessment.spacing_m);
    const auto clear = clear_signs(scene, *building.value(), people);
    for (size_t i = 0; i < people.size(); ++i)
      if (std::none_of(clear[i].begin(), clear[i].end(), [&](const ClearSign& seen) {
            const Sign& sign = scene.signs[seen.sign];
            return can_guide(way, people[i], sign, seen.view) &&
                   viewing_distance(sign, seen.view).within;
          }))
        out.push_back(fmt::format("{} at {:.1f} m", way.name, people[i].along_m));
  }
  return out;
}

/// Number of failing rules for the distance to signs in an assessment of a scene.
size_t failing_distances(const std::shared_ptr<const SceneDescription>& scene) {
  AssessOptions options;
  options.threads = 2;
  options.reality = false;
  const auto assessed = assess(scene, options, test::nobody, [](const std::string&, double) {});
  REQUIRE(assessed);
  return static_cast<size_t>(
      std::count_if(assessed->checks.begin(), assessed->checks.end(), [](const Check& check) {
        return check.verdict == CheckVerdict::fail &&
               (check.rule.id == RuleId::S4 || check.rule.id == RuleId::N8);
      }));
}

void check_guided(const TemporaryFolder& folder, const fs::path& file, const DesignResult& result) {
  const auto scene = read_back(folder, file, result);
  const auto unguided = unguided_places(*scene);
  INFO((unguided.empty() ? std::string() : unguided.front()));
  CHECK(unguided.empty());
  CHECK(failing_distances(scene) == 0);
}

const LeadsTo* way_of(const PlacedSign& sign, const std::string& name) {
  for (const LeadsTo& way : sign.leads_to)
    if (way.route == name) return &way;
  return nullptr;
}

/// A building with a partition and two routes; random by seed.
std::string random_building(uint64_t seed) {
  Random random(seed, RandomStream::test, 22);
  random.start(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform_double();
  };
  const double x = between(10, 24), y = between(7, 12), wall = between(4, x - 5);
  const double gap = between(2.2, y - 2.5), door = y - gap / 2 - 0.5;
  const double low = between(0.8, 1.6), end = x - between(0.4, 1.5);
  std::string out = hall(x, y, between(2.6, 4));
  out += partition("wall", fmt::format("{}, 0, 0", wall).c_str(),
                   fmt::format("{}, {}, 4", wall + 0.15, y - gap).c_str());
  out += route("first", fmt::format("[1, {0}, 0], [1, {1}, 0], [{2}, {1}, 0]", low, door, end));
  out += route("second", fmt::format("[{0}, {1}, 0], [{2}, {1}, 0], [{2}, {3}, 0], [{0}, {3}, 0]",
                                     end, low, wall + 1.2, door));
  if (random.uniform_double() < 0.5)
    out += partition("cupboard", fmt::format("{}, {}, 0", wall + 2, low + 1).c_str(),
                     fmt::format("{}, {}, {}", wall + 3, low + 1.5, between(1, 2.2)).c_str()) +
           "tags = [\"furniture\"]\n";
  return out + fmt::format("[design]\nspacing_m = 1.5\nfailure = \"none\"\nsign_spacing_m = {}\n",
                           between(3, 6));
}

void check_random_buildings(uint64_t first, uint64_t count) {
  for (uint64_t seed = first; seed < first + count; ++seed) {
    const TemporaryFolder folder;
    const fs::path file = folder.write("scene.toml", random_building(seed));
    INFO("seed " << seed << "\n" << random_building(seed));
    const DesignResult result = designed_with_signs(file);
    REQUIRE(result.signs);
    REQUIRE(result.signs->unguided.empty());
    if (result.answer.layout.empty()) continue;
    check_guided(folder, file, result);
    CHECK(result.signs->bound <= result.signs->objective + 1e-9);
  }
}

}  // namespace

TEST_CASE("one sign at its end guides along a straight corridor", "[design][signs]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write(
      "scene.toml", hall(20, 2, 3) + route("way", "[1, 1, 0], [19, 1, 0]") + "[design]\n");
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  REQUIRE(result.signs->signs.size() == 1);
  const PlacedSign& sign = result.signs->signs.front();
  CHECK(sign.spot.mount == SignMount::above);
  CHECK(sign.spot.position.x > 19.9);
  CHECK(sign.spot.facing.x == Approx(-1));
  REQUIRE(way_of(sign, "way") != nullptr);
  CHECK(way_of(sign, "way")->arrow == SignArrow::ahead);
  CHECK(result.signs->end == LayoutEnd::optimal);
  check_guided(folder, file, result);
}

TEST_CASE("a corridor longer than the viewing distance needs signs in proportion to its length",
          "[design][signs]") {
  // 0.1 m high and lit from within: visible for 20 m. Places are 5 m apart under the ceiling.
  const TemporaryFolder folder;
  const fs::path file =
      folder.write("scene.toml", hall(62, 2, 3) + route("way", "[1, 1, 0], [61, 1, 0]") + R"(
[design]
failure = "none"
[[design.sign]]
name = "small"
plain = "green"
smallest_detail = 0.02
width = 0.2
height = 0.1
mains_white = 500
mains_green = 60
emergency_white = 200
emergency_green = 30
)");
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  // 60 m of route: from 61.98 m back by 19.9 m each: 4 signs, and no fewer.
  CHECK(result.signs->signs.size() == 4);
  CHECK(result.signs->bound == Approx(4));
  check_guided(folder, file, result);
}

TEST_CASE("at a bend the arrow points along the route, and in the mirror image to the other side",
          "[design][signs]") {
  for (const bool left : {true, false}) {
    INFO((left ? "left" : "right"));
    const TemporaryFolder folder;
    // Up a corridor and then to one side, behind walls: the exit is not visible from the start.
    const std::string walls =
        partition("a", "0, 0, 0", "9, 6, 3") + partition("b", "11, 0, 0", "20, 6, 3");
    const fs::path file =
        folder.write("scene.toml", hall(20, 8, 3) + walls +
                                       route("way", left ? "[10, 1, 0], [10, 7, 0], [1, 7, 0]"
                                                         : "[10, 1, 0], [10, 7, 0], [19, 7, 0]") +
                                       "[design]\n");
    const DesignResult result = designed_with_signs(file);
    REQUIRE(result.signs);
    REQUIRE(result.signs->signs.size() == 2);
    size_t aside = 0, ahead = 0;
    for (const PlacedSign& sign : result.signs->signs) {
      REQUIRE(way_of(sign, "way") != nullptr);
      const SignArrow arrow = way_of(sign, "way")->arrow;
      aside += arrow == (left ? SignArrow::left : SignArrow::right);
      ahead += arrow == SignArrow::ahead;
    }
    CHECK(aside == 1);
    CHECK(ahead == 1);
    check_guided(folder, file, result);
  }
}

TEST_CASE("a type with an arrow in its drawing hangs only where that arrow is right",
          "[design][signs]") {
  const TemporaryFolder folder;
  const fs::path file =
      folder.write("scene.toml", hall(20, 2, 3) + route("way", "[1, 1, 0], [19, 1, 0]") + R"(
[design]
[[design.sign]]
name = "to the left"
plain = "green"
smallest_detail = 0.02
width = 0.3
height = 0.15
mains_white = 500
mains_green = 60
emergency_white = 200
emergency_green = 30
arrow = "left"
)");
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  CHECK(result.signs->signs.empty());
  REQUIRE(result.signs->unguided.size() == 1);
  CHECK(result.signs->unguided.front().places == result.signs->unguided.front().of);
}

TEST_CASE("an existing sign that guides saves a new one, and a removable useless one is removed",
          "[design][signs]") {
  const auto sign = [](const char* name, const char* position, const char* facing) {
    return fmt::format(
        "[[sign]]\nname = \"{}\"\nplain = \"green\"\nsmallest_detail = 0.02\nwidth = "
        "0.3\nheight = 0.15\nmains_white = 500\nmains_green = 60\nemergency_white = "
        "200\nemergency_green = 30\nposition = [{}]\nfacing = [{}]\n[[sign.leads_to]]\nroute = "
        "\"way\"\narrow = \"ahead\"\n",
        name, position, facing);
  };
  const TemporaryFolder folder;
  const fs::path file = folder.write(
      "scene.toml", hall(20, 2, 3) + route("way", "[1, 1, 0], [19, 1, 0]") +
                        sign("good", "19.97, 1, 2.4", "-1, 0, 0") +
                        sign("useless", "0.03, 1, 2.4", "1, 0, 0") +
                        "[design]\nplace_signs = true\nexisting_signs = \"removable\"\n");
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  REQUIRE(result.signs->signs.size() == 1);
  CHECK(result.signs->signs.front().name == "good");
  CHECK(result.signs->removed == std::vector<std::string>{"useless"});
  const auto scene = read_back(folder, file, result);
  CHECK(scene->signs.size() == 1);
  CHECK(unguided_places(*scene).empty());
}

TEST_CASE("two existing signs that hang back to back both stay", "[design][signs]") {
  const auto sign = [](const char* name, const char* position, const char* facing) {
    return fmt::format(
        "[[sign]]\nname = \"{}\"\nplain = \"green\"\nsmallest_detail = 0.02\nwidth = "
        "0.3\nheight = 0.15\nmains_white = 500\nmains_green = 60\nemergency_white = "
        "200\nemergency_green = 30\nposition = [{}]\nfacing = [{}]\n",
        name, position, facing);
  };
  const TemporaryFolder folder;
  const fs::path file =
      folder.write("scene.toml", hall(20, 2, 3) + route("way", "[1, 1, 0], [19, 1, 0]") +
                                     sign("west face", "9.9, 1, 2.4", "-1, 0, 0") +
                                     sign("east face", "10, 1, 2.4", "1, 0, 0") +
                                     "[design]\nplace_signs = true\nexisting_signs = \"fixed\"\n");
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  CHECK(result.signs->end == LayoutEnd::optimal);
  CHECK(result.signs->removed.empty());
  REQUIRE(result.signs->signs.size() >= 3);
  CHECK(result.signs->signs[0].name == "west face");
  CHECK(result.signs->signs[1].name == "east face");
  check_guided(folder, file, result);
}

/// A corridor of 1 m up to a junction, where one route turns left and the other right. Signs are as
/// wide as the corridor, so that people at its start see only those at its end.
std::string parting_routes(const std::string& more) {
  return hall(20, 8, 3) + partition("a", "0, 0, 0", "9.5, 6, 3") +
         partition("b", "10.5, 0, 0", "20, 6, 3") +
         route("left", "[10, 1, 0], [10, 7, 0], [1, 7, 0]") +
         route("right", "[10, 1, 0], [10, 7, 0], [19, 7, 0]") + R"(
[design]
failure = "none"
[[design.sign]]
name = "wide"
plain = "green"
smallest_detail = 0.02
width = 0.998
height = 0.3
mains_white = 500
mains_green = 60
emergency_white = 200
emergency_green = 30
)" + more;
}

TEST_CASE("a place whose sign is hidden by another in every plan is reported, and the plan is kept",
          "[design][signs]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", parting_routes(""));
  // One sign on the wall and one under the ceiling before it: two places, and none for a third
  // sign.
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  REQUIRE(result.signs->unguided.size() == 1);
  const UnguidedPlaces& hidden = result.signs->unguided.front();
  CHECK(hidden.behind_signs);
  CHECK(hidden.places >= 1);
  CHECK(hidden.places < hidden.of);
  CHECK(hidden.first.y < 6);
  CHECK(result.signs->signs.size() == 4);
  CHECK(result.signs->bound == Approx(result.signs->objective));
  // In the file all other places are guided.
  CHECK(unguided_places(*read_back(folder, file, result)).size() == hidden.places);
}

TEST_CASE("if no plan of signs exists the error says so, and what would help", "[design][signs]") {
  // Without a place under the ceiling one sign would have to point to both sides.
  const TemporaryFolder folder;
  const fs::path file = folder.write(
      "scene.toml", parting_routes("[[design.keep_out]]\nname = \"detector\"\nposition = [10, 7, "
                                   "3]\nradius = 0.4\n"));
  DesignOptions options;
  options.threads = 2;
  const auto result = design(test::described(file), options, test::nobody, test::silent);
  REQUIRE_FALSE(result);
  CHECK(result.problem().text().find("no plan of signs guides along all routes") !=
        std::string::npos);
}

TEST_CASE("Ctrl-C while signs are planned keeps their plan and ends the following steps",
          "[design][signs]") {
  // Crossing routes: the arrow for one of them is wrong for others.
  std::string crossing = hall(40, 24, 3);
  for (int i = 0; i < 6; ++i)
    crossing +=
        route(fmt::format("way {}", i), fmt::format("[{}, 1, 0], [{}, {}, 0], [{}, 23, 0]",
                                                    2 + 6 * i, 37 - 6 * i, 8 + 2 * i, 4 + 5 * i));
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.toml", crossing + "[design]\nspacing_m = 2\n");
  DesignOptions options;
  options.threads = 2;
  test::CtrlC ctrl_c;
  const auto result =
      design(test::described(file), options, ctrl_c.interrupt(), ctrl_c.pressed_at("signs: ", 2));
  INFO((result ? "" : result.problem().text()));
  REQUIRE(ctrl_c.interrupt());
  CHECK(ctrl_c.times_taken() == 0);
  REQUIRE(result);
  REQUIRE(result->signs);
  CHECK(result->signs->end == LayoutEnd::interrupted);
  CHECK_FALSE(result->signs->signs.empty());
  CHECK(result->signs->bound <= result->signs->objective);
  // The luminaires are those of the greedy heuristic, and they pass.
  CHECK(result->answer.end == LayoutEnd::interrupted);
  CHECK_FALSE(result->luminaires.empty());
  CHECK(result->because.empty());
  CHECK(test::failing_on_disk(folder, file, result.value()).empty());
  check_guided(folder, file, result.value());
}

TEST_CASE("a sign type on a circuit that is off is not placed", "[design][signs]") {
  const auto signs_with = [](const char* circuits) {
    const TemporaryFolder folder;
    const fs::path file = folder.write(
        "scene.toml", hall(20, 2, 3) + circuits + route("way", "[1, 1, 0], [19, 1, 0]") + R"(
[[sign]]
name = "old"
circuit = "B"
plain = "green"
smallest_detail = 0.02
width = 0.3
height = 0.15
mains_white = 500
mains_green = 60
emergency_white = 200
emergency_green = 30
position = [19.97, 1, 2.4]
facing = [-1, 0, 0]
[design]
place_signs = true
existing_signs = "removed"
[[design.sign]]
name = "group B"
circuit = "B"
plain = "green"
smallest_detail = 0.02
width = 0.3
height = 0.15
mains_white = 500
mains_green = 60
emergency_white = 200
emergency_green = 30
)");
    return *designed_with_signs(file).signs;
  };
  CHECK(signs_with("circuits = { B = 1 }\n").signs.size() == 1);
  const SignPlan out = signs_with("circuits = { B = 0 }\n");
  CHECK(out.signs.empty());
  CHECK(out.left_out.forbidden > 0);
}

TEST_CASE("scenarios know a circuit that only a sign type of a design uses", "[design][signs]") {
  const auto scene =
      test::described_text(test::box_room(20, 2, 3) + test::judged_2013 +
                           "circuits = { B = 0.5 }\n" + test::way_along(1, 19, 1) + R"(
[design]
place_signs = true
[[design.sign]]
name = "group B"
circuit = "B"
plain = "green"
smallest_detail = 0.02
width = 0.3
height = 0.15
mains_white = 500
mains_green = 60
emergency_white = 200
emergency_green = 30
)");
  REQUIRE(scene->design->sign_types.size() == 1);
  const SceneDescription switched = as_switched(*scene, scene->scenarios.front());
  CHECK(switched.design->sign_types[0].sign.colours[0].emergency_cd_m2 == Approx(100));
}

TEST_CASE("an externally lit sign gets a luminaire", "[design][signs]") {
  const TemporaryFolder folder;
  const fs::path file =
      folder.write("scene.toml", hall(12, 2, 3) + route("way", "[1, 1, 0], [11, 1, 0]") + R"(
[design]
failure = "none"
[[design.sign]]
name = "board"
plain = "green"
smallest_detail = 0.02
width = 0.4
height = 0.2
lighting = "external"
green_reflectance = 0.1
white_reflectance = 0.7
)");
  const DesignResult result = designed_with_signs(file);
  REQUIRE(result.signs);
  REQUIRE(result.signs->signs.size() == 1);
  bool lit = false;
  for (const Check& check : result.assessment.checks)
    if (check.rule.id == RuleId::S6l) lit = check.verdict == CheckVerdict::pass;
  CHECK(lit);
  check_guided(folder, file, result);
}

TEST_CASE("signs of random buildings on disk guide from every place", "[design][signs]") {
  const char* seed = std::getenv("LUXODUS_SEED");
  check_random_buildings(seed == nullptr ? 1 : std::strtoull(seed, nullptr, 10), 5);
}

TEST_CASE("signs of 200 random buildings on disk guide from every place",
          "[design][signs][.][long]") {
  check_random_buildings(1000, 200);
}

}  // namespace luxodus
