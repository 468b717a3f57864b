// Estimates promise nothing that an assessment denies.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <random>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/visibility_map/sign_estimates.hpp"
#include "actors/judge/visibility_map/signs_in_state.hpp"
#include "tests/kit/test_length.hpp"
#include "tests/unit/actors/judge/visibility_map/small_smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

struct Box {
  glm::dvec2 low, high;
};

std::vector<glm::dvec3> random_eyes(const Box& box, size_t count, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> x(box.low.x, box.high.x), y(box.low.y, box.high.y);
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < count; ++i) {
    const double at = x(random);
    out.emplace_back(at, y(random), 1.65);
  }
  return out;
}

/// Views that an assessment decides, and of them those that the estimates decide or get wrong.
struct Counts {
  size_t decided = 0, read = 0, seen = 0, undecided = 0, wrong = 0;
};

/// Compares the estimates of the first `count` eyes with an assessment of the same scene.
void compare(const SceneDescription& scene, const SignsInState& state,
             const std::vector<glm::dvec3>& eyes, size_t count, Counts& counts) {
  SceneDescription alone = scene;
  alone.routes.clear();
  alone.open_areas.clear();
  alone.observers.clear();
  for (size_t i = 0; i < count; ++i) {
    Observer& observer = alone.observers.emplace_back();
    observer.name = fmt::format("{}", i);
    observer.eye = eyes[i];
    observer.gaze = {1, 0, 0};
  }
  AssessOptions options;
  options.seed = 1000;
  options.threads = 2;
  const auto scenario = judged_scenario(scene, "");
  REQUIRE(scenario);
  Assessment assessed;
  REQUIRE(assess_sights(alone, scenario.value(), {}, options, nobody_interrupts, say_nothing,
                        assessed));
  for (const SightRow& row : assessed.sights) {
    const SightVerdict verdict = row.sight.verdict;
    const bool partly_hidden = row.sight.reason && row.sight.reason->id == RemarkId::partly_hidden;
    if ((verdict == SightVerdict::undecided && !partly_hidden) ||
        verdict == SightVerdict::not_assessed)
      continue;
    size_t sign = 0;
    while (scene.signs[sign].name != row.sign) ++sign;
    const size_t eye = std::stoul(row.from.name);
    const SignEstimate& estimate = state.estimates()[eye * scene.signs.size() + sign];
    // Of a part of a sign an assessment says nothing, and an estimate promises nothing.
    if (partly_hidden) {
      CHECK(estimate.answer != SignAnswer::read);
      counts.wrong += estimate.answer == SignAnswer::read ? 1 : 0;
      continue;
    }
    const bool seen = verdict == SightVerdict::legible || verdict == SightVerdict::visible;
    ++counts.decided;
    counts.read += estimate.answer == SignAnswer::read ? 1 : 0;
    counts.seen += estimate.surely_seen ? 1 : 0;
    counts.undecided += estimate.answer == SignAnswer::undecided ? 1 : 0;
    const bool wrong = (estimate.answer == SignAnswer::read && verdict != SightVerdict::legible) ||
                       (estimate.surely_seen && !seen);
    counts.wrong += wrong ? 1 : 0;
    INFO(row.sign << " from (" << row.eye.x << ", " << row.eye.y << "): " << name_of(verdict)
                  << ", level " << row.sight.reading_level.value << " +- "
                  << row.sight.reading_level.error << "; estimated " << name_of(estimate.answer)
                  << ", level " << estimate.reading_level.value << " +- "
                  << estimate.reading_level.error);
    CHECK_FALSE(wrong);
  }
}

Counts compared(const StatesToAssess& states, const std::vector<glm::dvec3>& eyes, size_t count) {
  EstimateRequest request;
  request.states = states;
  request.options.threads = 2;
  request.options.rounds = 2;
  request.eyes = eyes;
  Counts counts;
  const auto made = for_each_state(
      request, nobody_interrupts, say_nothing, [&](size_t i, std::unique_ptr<SignsInState> state) {
        auto scene =
            states.times_s.empty() ? Result(states.last) : states.reader(states.times_s[i]);
        REQUIRE(scene);
        compare(*scene.value(), *state, eyes, count, counts);
      });
  REQUIRE(made);
  std::printf(
      "%zu views decided by the assessment: estimates say %zu read, %zu seen, %zu "
      "undecided, %zu wrong\n",
      counts.decided, counts.read, counts.seen, counts.undecided, counts.wrong);
  return counts;
}

}  // namespace

TEST_CASE("no estimate says read or seen where an assessment denies it",
          "[judge][visibility_map]") {
  const TemporaryFolder folder;
  const auto file = folder.write("room.toml", thickening_room());
  const Box box{{0.2, -1.8}, {11.5, 1.8}};
  const Counts counts = compared(states_of(file), random_eyes(box, 300, 5), in_full() ? 300 : 25);
  CHECK(counts.wrong == 0);
  CHECK(counts.read > counts.decided / 10);
  CHECK(counts.undecided < counts.decided / 3);
}

TEST_CASE("on a floor in a fire no estimate says what an assessment denies",
          "[judge][visibility_map][.long]") {
  const std::filesystem::path file = std::filesystem::path(LUX_SOURCE_DIR) /
                                     "tests/unit/actors/judge/visibility_map/office_fire.toml";
  StatesToAssess states = states_of(file);
  states.times_s = {90, 180, 240, 300};
  const char* const asked = std::getenv("LUXODUS_PLACES");
  const size_t count = asked != nullptr ? std::stoul(asked) : 500;  // at each time
  const Box box{{0.1, 0.1}, {25.9, 15.9}};
  const Counts counts = compared(states, random_eyes(box, 5000, 7), count);
  CHECK(counts.wrong == 0);
  CHECK(counts.read > 0);
}
