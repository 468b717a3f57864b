// Estimates at any time, from any place.
#include "actors/judge/visibility_map/sign_estimates.hpp"

#include <catch2/catch.hpp>

#include "actors/judge/visibility_map/signs_in_state.hpp"
#include "tests/unit/actors/judge/visibility_map/small_smoky_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

std::vector<glm::dvec3> places() {
  std::vector<glm::dvec3> out;
  for (double x = 0.5; x < 11.6; x += 0.5)
    for (double y = -1.5; y < 1.6; y += 0.5) out.emplace_back(x, y, 1.65);
  return out;
}

}  // namespace

TEST_CASE("between two times an estimate promises what both do", "[judge][visibility_map]") {
  const TemporaryFolder folder;
  EstimateRequest request;
  request.states = states_of(folder.write("room.toml", thickening_room()));
  request.options.rounds = 2;
  request.eyes = places();
  const auto made = SignEstimates::make(request, nobody_interrupts, say_nothing);
  INFO((made ? "" : made.problem().text()));
  REQUIRE(made);
  const SignEstimates& estimates = *made.value();
  CHECK(estimates.signs() == std::vector<std::string>{"exit"});
  CHECK(estimates.sure_errors() > 3);
  size_t read = 0;
  for (const glm::dvec3& eye : request.eyes) {
    const SignEstimate first = estimates.at(0, eye, 0), next = estimates.at(30, eye, 0);
    const SignEstimate between = estimates.at(12, eye, 0);
    CHECK(between.answer == worse_of(first, next).answer);
    CHECK(between.surely_seen == (first.surely_seen && next.surely_seen));
    read += first.answer == SignAnswer::read ? 1 : 0;
  }
  CHECK(read > request.eyes.size() / 4);
  // Before the first and after the last time nothing is known.
  CHECK(estimates.at(-1, {10, 0, 1.65}, 0).answer == SignAnswer::undecided);
  CHECK(estimates.at(61, {10, 0, 1.65}, 0).answer == SignAnswer::undecided);
  // A sign is hidden behind the screen, behind its own face, and from within a wall.
  CHECK(estimates.at(0, {4.5, -1.5, 1.65}, 0).answer == SignAnswer::hidden);
  CHECK(estimates.at(0, {11.99, 0, 1.65}, 0).answer == SignAnswer::hidden);
  CHECK(estimates.at(0, {5.05, -1, 1.65}, 0).answer == SignAnswer::hidden);
}

TEST_CASE("estimates do not depend on the number of threads", "[judge][visibility_map]") {
  EstimateRequest request;
  request.states.last = described_text(smoky_room("0.6"));
  request.options.rounds = 2;
  request.eyes = places();
  std::vector<std::vector<SignEstimate>> all;
  for (const int threads : {1, 3}) {
    request.options.threads = threads;
    REQUIRE(for_each_state(
        request, nobody_interrupts, say_nothing,
        [&](size_t, std::unique_ptr<SignsInState> state) { all.push_back(state->estimates()); }));
  }
  REQUIRE(all.front().size() == all.back().size());
  for (size_t i = 0; i < all.front().size(); ++i) {
    CHECK(all.front()[i].answer == all.back()[i].answer);
    CHECK(all.front()[i].reading_level.value == all.back()[i].reading_level.value);
  }
}

TEST_CASE("an unknown sign and too many places are refused", "[judge][visibility_map]") {
  EstimateRequest request;
  request.states.last = described_text(smoky_room("0.6"));
  request.signs = {"entry"};
  const auto unknown = SignEstimates::make(request, nobody_interrupts, say_nothing);
  REQUIRE_FALSE(unknown);
  CHECK(unknown.problem().text().find("\"entry\"") != std::string::npos);
  request.signs.clear();
  request.eyes.assign(limits::estimated_eyes + 1, {1, 0, 1.65});
  const auto many = SignEstimates::make(request, nobody_interrupts, say_nothing);
  REQUIRE_FALSE(many);
  CHECK(many.problem().text().find("at most") != std::string::npos);
}
