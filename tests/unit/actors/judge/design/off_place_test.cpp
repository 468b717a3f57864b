// Compares layouts that hold off their places with all subsets of few candidates: no subset that
// passes the rules and holds off its places is below the bound.
#include <catch2/catch.hpp>
#include <limits>

#include "actors/judge/design/place_tolerance.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/judge/design/design_scenes.hpp"

namespace luxodus {
namespace {

std::string corridor_of(double length, const std::string& failure) {
  std::string places;
  for (double x = 0.8; x < length - 0.5; x += length / 9)
    places += fmt::format("{}[{:.3f}, 1.3, 2.78]", places.empty() ? "" : ", ", x);
  return test::box_room(length, 2.4, 2.8) + test::judged_2013 +
         test::way_along(1, length - 1, 1.2, 1.4) +
         fmt::format(
             "[design]\nplace_signs = false\nmargin = 1\nfailure = \"{}\"\nplaces = [{}]\n"
             "place_tolerance_m = 0.5\n",
             failure, places);
}

struct Posed {
  explicit Posed(const std::filesystem::path& file) {
    scene = test::described(file);
    scenario = judged_scenario(*scene, "").value();
    codes = judged_codes(*scene, {}, {}).value();
    switched = as_switched(*scene, scenario);
    all = find_candidates(switched, *switched.design, codes, scenario, 2).value().all;
    demands = Demands::make(switched, *switched.design, all, codes, scenario, 2).value();
  }

  PlaceTolerance tolerance(const Layout& layout) const {
    std::vector<LuminaireCandidate> chosen;
    for (size_t i = 0; i < all.size(); ++i)
      if (layout[i] != 0) chosen.push_back(all[i]);
    return tolerance_of(switched, *switched.design, chosen, codes, scenario, 2).value();
  }

  std::shared_ptr<const SceneDescription> scene;
  Scenario scenario;
  std::vector<CodeChoice> codes;
  SceneDescription switched;
  std::vector<LuminaireCandidate> all;
  std::unique_ptr<Demands> demands;
};

/// Smallest objective of all subsets that pass the rules and hold off their places; infinite if
/// none does.
double fewest_off_place(const Posed& posed) {
  const LayoutProblem& problem = posed.demands->problem();
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  double fewest = std::numeric_limits<double>::infinity();
  for (uint32_t bits = 1; bits < 1u << posed.all.size(); ++bits) {
    Layout layout(posed.all.size(), 0);
    for (size_t i = 0; i < layout.size(); ++i) layout[i] = static_cast<char>(bits >> i & 1);
    const double objective = objective_of(problem, layout);
    if (objective >= fewest) continue;
    sums.set(layout);
    if (sums.holds() && posed.tolerance(layout).holds()) fewest = objective;
  }
  return fewest;
}

}  // namespace

TEST_CASE("a layout that holds off its places is the smallest of all that do",
          "[design][tolerance]") {
  int raised = 0;
  for (double length = 8; length < 18; length += 1.5)
    for (const char* failure : {"none", "two"}) {
      INFO("length " << length << ", failure " << failure);
      const test::TemporaryFolder folder;
      const auto file = folder.write("scene.toml", corridor_of(length, failure));
      const Posed posed(file);
      REQUIRE(posed.all.size() <= 10);
      const double fewest = fewest_off_place(posed);
      DesignOptions options;
      options.what_binds = false;
      const DesignResult result = test::designed(file, options);
      raised += result.verifications > 1 ? 1 : 0;
      if (std::isinf(fewest)) {
        CHECK_FALSE(result.tolerance->holds());
        continue;
      }
      CHECK(result.tolerance->holds());
      CHECK(result.answer.objective == Approx(fewest));
      CHECK(result.answer.bound == Approx(fewest));
    }
  CHECK(raised > 0);
}

TEST_CASE("rows for points off the places are satisfied by all layouts that hold there",
          "[design][tolerance]") {
  const test::TemporaryFolder folder;
  const Posed posed(folder.write("scene.toml", corridor_of(12, "two")));
  const size_t rows = posed.demands->problem().covers.size();
  std::vector<Layout> holding;
  size_t broken = 0;
  for (uint32_t bits = 1; bits < 1u << posed.all.size(); bits += 3) {
    Layout layout(posed.all.size(), 0);
    for (size_t i = 0; i < layout.size(); ++i) layout[i] = static_cast<char>(bits >> i & 1);
    const PlaceTolerance tolerance = posed.tolerance(layout);
    if (tolerance.holds()) {
      holding.push_back(layout);
      continue;
    }
    if (broken > 20) continue;
    const auto asked =
        posed.demands->ask_off_place({posed.switched, *posed.switched.design, posed.scenario, 2},
                                     posed.all, broken_points(tolerance), layout);
    REQUIRE(asked);
    CHECK(asked.value() > 0);
    ++broken;
  }
  REQUIRE(holding.size() >= 3);
  REQUIRE(broken >= 3);
  const LayoutProblem& problem = posed.demands->problem();
  CHECK(problem.covers.size() > rows);
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  for (const Layout& layout : holding) {
    sums.set(layout);
    for (size_t row = rows; row < problem.covers.size(); ++row) CHECK(sums.cover(row) >= 1 - 1e-4);
  }
}

TEST_CASE("a luminaire off its place is hidden by an obstacle in front of that position",
          "[design][tolerance]") {
  // A beam under the ceiling beside the luminaire. From its place the luminaire lights the whole
  // route; 0.25 m farther, behind the beam's edge, it does not light the far side.
  const test::TemporaryFolder folder;
  const std::string beam = R"(
[[object]]
name = "beam"
shape = "box"
low = [2.1, 0, 1.2]
high = [2.2, 0.95, 3]
material = "white50"
)";
  const auto posed_with = [&](const std::string& objects, const char* name) {
    return Posed(
        folder.write(name, test::box_room(4, 2, 3) + objects + test::judged_2013 +
                               test::way_along(0.5, 3.5, 1, 0.4) +
                               "[design]\nplace_signs = false\nmargin = 1\nfailure = \"none\"\n"
                               "places = [[1.6, 1.05, 2.98]]\nplace_tolerance_m = 0.25\n"));
  };
  const double open = posed_with("", "open.toml").tolerance({1}).least();
  const Posed past_beam = posed_with(beam, "beam.toml");
  const LayoutProblem& problem = past_beam.demands->problem();
  const LayoutIndex index(problem);
  LayoutSums sums(index);
  sums.set({1});
  CHECK(sums.holds());
  CHECK(open > 1);
  CHECK(past_beam.tolerance({1}).least() < 0.1 * open);
}

}  // namespace luxodus
