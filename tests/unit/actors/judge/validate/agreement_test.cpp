#include "actors/judge/validate/agreement.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace luxodus::light {
namespace {

using Catch::Matchers::Contains;

constexpr Agreement kept = Agreement::kept, failing = Agreement::failing,
                    open = Agreement::not_answered;

Agreement seen(double predicted, double error, const Interval& observed) {
  return seen_agrees({predicted, error}, observed).agreement;
}

Agreement read(double at_level_7, double at_level_1, const Interval& observed) {
  return read_agrees({at_level_7, 0.01}, {at_level_1, 0.01}, observed).agreement;
}

}  // namespace

TEST_CASE("a value is judged where it is two standard errors from the limits",
          "[validate][experiments]") {
  const Interval allowed{1, 3};
  CHECK(within({2, 0.4}, allowed).agreement == kept);
  CHECK(within({2, 0.6}, allowed).agreement == open);
  CHECK(within({3.5, 0.1}, allowed).agreement == failing);
  CHECK(within({3.5, 0.3}, allowed).agreement == open);
  CHECK(within({0.5, 0.1}, allowed).agreement == failing);
  CHECK(within({3, 0}, allowed).agreement == kept);
  CHECK(within({1e9, 1}, {2, unlimited}).agreement == kept);
  CHECK_THAT(within({4, 0}, {-unlimited, 3}).reason, Contains("4, allowed at most 3"));
}

TEST_CASE("seeing agrees within a factor of two in luminance", "[validate][experiments]") {
  CHECK(seen(8.0, 0.02, {7.6, 7.6}) == kept);
  CHECK(seen(7.0, 0.02, {7.6, 7.6}) == kept);
  CHECK(seen(8.4, 0.02, {7.6, 7.6}) == failing);
  CHECK(seen(6.8, 0.02, {7.6, 7.6}) == failing);
  CHECK(seen(8.3, 0.02, {7.6, 7.6}) == open);
  CHECK(seen(10.4, 0.02, {7.8, 9.8}) == kept);
  CHECK(seen(10.6, 0.02, {7.8, 9.8}) == failing);
}

TEST_CASE("the difference from an observed interval is that from its nearer end",
          "[validate][experiments]") {
  CHECK(deviation(5, {4, 6}) == 0);
  CHECK(deviation(7, {4, 6}) == 1);
  CHECK(deviation(3.5, {4, 6}) == -0.5);
}

TEST_CASE("the mean difference of seeing is held more closely than each",
          "[validate][experiments]") {
  CHECK(mean_seen_agrees(std::vector{0.6, -0.6, 0.3}).agreement == kept);
  CHECK(mean_seen_agrees(std::vector{0.6, 0.5, 0.4}).agreement == failing);
  CHECK(mean_seen_agrees(std::vector{-0.6, -0.5, -0.4}).agreement == failing);
  CHECK(mean_seen_agrees({}).agreement == open);
}

TEST_CASE("reading agrees where nothing is promised that people did not read, nor denied",
          "[validate][experiments]") {
  CHECK(read(6.5, 8.5, {8.3, 8.3}) == kept);
  CHECK(read(6.5, 7.9, {8.3, 8.3}) == kept);      // half a unit beyond the threshold
  CHECK(read(8.6, 10.5, {8.3, 8.3}) == failing);  // promised
  CHECK(read(5.5, 7.5, {8.3, 8.3}) == failing);   // denied
  // Of an interval the lower end counts for the promise, the upper one for the denial.
  CHECK(read(6.8, 8.0, {6.9, 8.2}) == kept);
  CHECK(read(7.5, 9.4, {6.9, 8.2}) == failing);
  CHECK(read(5.0, 7.0, {6.9, 8.2}) == failing);
  CHECK_THAT(read_agrees({8.6, 0}, {10.5, 0}, {8.3, 8.3}).reason,
             Contains("promised up to 8.6") && !Contains("denied"));
}

TEST_CASE("an order is kept, broken, or too close to be told", "[validate][experiments]") {
  CHECK(is_beyond({9, 0.1}, {8, 0.1}).agreement == kept);
  CHECK(is_beyond({8, 0.1}, {9, 0.1}).agreement == failing);
  CHECK(is_beyond({8.1, 0.1}, {8, 0.1}).agreement == open);
  CHECK(is_much_beyond({9, 0.1}, {8, 0.1}).agreement == kept);
  CHECK(is_much_beyond({8.3, 0.1}, {8, 0.1}).agreement == failing);
  CHECK(is_about_equal({8.3, 0.1}, {8, 0.1}).agreement == kept);
  CHECK(is_about_equal({10.8, 0.1}, {8, 0.1}).agreement == failing);
}

TEST_CASE("a detail at the limit of acuity has a level of about one", "[validate][experiments]") {
  CHECK(acuity_agrees({1.1, 0}).agreement == kept);
  CHECK(acuity_agrees({0.4, 0}).agreement == failing);
  CHECK(acuity_agrees({2.5, 0}).agreement == failing);
}

TEST_CASE("a slope and a quotient carry the errors of their values", "[validate][experiments]") {
  const std::vector<double> x{0, 1, 2};
  const std::vector<Uncertain> y{{5, 0.1}, {7, 0.1}, {9, 0.1}};
  CHECK(slope_of(x, y).value == Approx(2));
  CHECK(slope_of(x, y).error == Approx(0.1 / std::sqrt(2.0)));  // (y2 - y0) / 2
  CHECK(quotient({6, 0.3}, {3, 0.1}).value == Approx(2));
  CHECK(quotient({6, 0.3}, {3, 0.1}).error == Approx(2 * std::hypot(0.05, 1 / 30.0)));
}

TEST_CASE("several claims fail together if one fails", "[validate][experiments]") {
  const RuleResult good{kept, "good"}, bad{failing, "bad"}, unknown{open, "unknown"};
  CHECK(all_of(std::vector{good, unknown, bad}).agreement == failing);
  CHECK(all_of(std::vector{good, unknown, bad}).reason == "bad");
  CHECK(all_of(std::vector{good, unknown}).reason == "unknown");
  CHECK(all_of(std::vector{good, good}).agreement == kept);
}

}  // namespace luxodus::light
