// Tests paired comparisons of layouts in smoke, from shared paths: a difference may be certain
// although the ranges overlap, and is open if nothing separates the layouts.
#include "actors/judge/design/smoke_differences.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "actors/judge/design/layout_groups.hpp"
#include "actors/judge/design/record_design.hpp"
#include "actors/judge/design/smoke_race.hpp"
#include "actors/judge/design/smoke_section.hpp"
#include "runtime/core/random.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/unit/actors/judge/design/silent.hpp"
#include "tests/unit/actors/judge/design/smoke_corridor.hpp"

namespace luxodus {
namespace {

using std::numbers::pi;
using test::corridor_layout;
using test::nobody;

/// A view straight ahead at this distance along the route, with this reading level.
SightRow seen_from(double along_m, double level, double error) {
  SightRow row;
  row.from = {SubjectKind::route, "way"};
  row.along_m = along_m;
  row.height_m = 1.65;
  row.gaze_deg = 0;
  row.sight.reading_level = {level, error};
  row.sight.verdict = level - 2 * error >= level_read  ? SightVerdict::legible
                      : level + 2 * error < level_read ? SightVerdict::visible
                                                       : SightVerdict::undecided;
  return row;
}

/// One view from each of several places, which stand for two metres of the route each.
struct Looked {
  std::vector<SightRow> rows;
  SeenPlaces places;
};
Looked looked(const std::vector<Uncertain>& levels) {
  Looked out;
  for (size_t i = 0; i < levels.size(); ++i) {
    const double along = 1 + 2 * static_cast<double>(i);
    out.rows.push_back(seen_from(along, levels[i].value, levels[i].error));
    const SightVerdict verdict = out.rows.back().sight.verdict;
    out.places[{Subject{SubjectKind::route, "way"}, along, 1.65}] = {
        2, verdict == SightVerdict::legible     ? Read::a_sign
           : verdict == SightVerdict::undecided ? Read::undecided
                                                : Read::nothing};
  }
  return out;
}

ErrorOfDifference always(double error) {
  return [error](size_t) { return std::optional(error); };
}

LegibleShare all_of(const Looked& one) {
  return share_of(one.places, [](const RoutePlace&) { return true; });
}

/// The corridor in bright smoke with a dim sign and places this far apart: from some of them the
/// sign is just legible.
std::shared_ptr<const SceneDescription> closely_looked_at(const std::string& spacing_m) {
  std::string text = test::corridor_with(test::even_smoke);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"spacing_m = 2", "spacing_m = " + spacing_m},
        {"emergency_white = 100", "emergency_white = 6"},
        {"emergency_green = 10", "emergency_green = 0.6"},
        {"eye_heights_m = [1.65]", "eye_heights_m = [1.6, 1.65, 1.7]"},
        {"albedo = 0.6", "albedo = 0.95"}})
    text = test::replaced(text, from, to);
  return test::described_text(text);
}

/// Ten undecided places, 0.4 around the limit, and one place that only the other layout lights.
Looked open_views(double more, bool and_the_last) {
  std::vector<Uncertain> levels(10, {level_read + more, 0.4});
  levels.push_back({and_the_last ? 9.0 : 5.0, 0.1});
  return looked(levels);
}

}  // namespace

TEST_CASE("one or two undecided places do not make a difference certain", "[design]") {
  const auto nothing_known = [](size_t) { return std::optional<double>(); };
  const auto beyond = [&](const std::vector<Uncertain>& first,
                          const std::vector<Uncertain>& other) {
    const Looked a = looked(first), b = looked(other);
    return difference_of({a.places, a.rows}, {b.places, b.rows}, nothing_known);
  };
  // Read with probability 0.2, at 0.85 standard errors; the other layout is certainly read.
  const Uncertain hardly{level_read - 0.34, 0.4}, surely{9, 0.1}, perhaps{level_read + 0.5, 0.4};
  CHECK_FALSE(beyond({hardly}, {surely}).surely_more());
  CHECK_FALSE(beyond({hardly, perhaps}, {surely, perhaps}).surely_more());
  CHECK(beyond({{5, 0.1}}, {surely}).surely_more());
  // Not all of forty places.
  const std::vector<Uncertain> many(40, hardly), read(40, surely);
  const ShareDifference of_many = beyond(many, read);
  CHECK(of_many.surely_more());
  CHECK(of_many.least < 0.8);
  CHECK(of_many.least > 0.5);
  // Equal shares of different places: three won and three lost.
  std::vector<Uncertain> a(7, {5, 0.1}), b = a;
  for (const size_t i : {0, 1, 2}) a[i] = surely;
  for (const size_t i : {4, 5, 6}) b[i] = surely;
  CHECK_FALSE(beyond(a, b).surely_more());
  CHECK(beyond(a, b).surely_no_less());
}

TEST_CASE(
    "the probability of two correlated variables is that of the bivariate normal distribution",
    "[design]") {
  for (const double r : {-1.0, -0.9, -0.3, 0.0, 0.4, 0.99, 1.0}) {
    // Sheppard 1899: the closed form at the centre.
    CHECK(chance_below(0, 0, r) == Approx(0.25 + std::asin(r) / (2 * pi)).margin(1e-9));
    CHECK(chance_below(1.3, 8, r) == Approx(chance_below(1.3, 8, 0)).margin(1e-9));
  }
  Random random(1, RandomStream::test);
  random.start(0);
  constexpr int draws = 200'000;
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1 - random.uniform_double())) *
           std::cos(2 * pi * random.uniform_double());
  };
  for (const double r : {-0.7, 0.5, 0.95}) {
    int below = 0;
    for (int i = 0; i < draws; ++i) {
      const double x = normal(), y = r * x + std::sqrt(1 - r * r) * normal();
      below += x < 0.4 && y < -0.3;
    }
    const double chance = chance_below(0.4, -0.3, r);
    const double error = std::sqrt(chance * (1 - chance) / draws);
    CHECK(std::abs(below / static_cast<double>(draws) - chance) < 4 * error);
  }
}

TEST_CASE("layouts whose ranges overlap differ certainly if the same paths show both", "[design]") {
  const Looked first = open_views(0, false), other = open_views(0.05, true);
  // 0 to 91 % and 9 to 100 %: by these ranges the other layout may be read from far less.
  CHECK(all_of(first).most > all_of(other).least);
  const LayoutViews a{first.places, first.rows}, b{other.places, other.rows};
  const ShareDifference sure = difference_of(a, b, always(0.01));
  INFO(sure.least << " to " << sure.most);
  CHECK(sure.least > 0);
  CHECK(sure.most < 0.5);
  // The certain place contributes, and so does the shift of a hundredth at the others.
  CHECK(sure.least < 1.0 / 11 + 10.0 / 11 * 0.05);
  CHECK(sure.most > 1.0 / 11 + 10.0 / 11 * 0.05);
  const ShareDifference apart = difference_of(a, b, {});
  CHECK(apart.least < 0);
  CHECK(apart.most - apart.least > 2 * (sure.most - sure.least));
}

TEST_CASE("equal layouts have no difference by shared paths, and an open one by separate paths",
          "[design]") {
  const Looked one = open_views(0, false);
  const LayoutViews views{one.places, one.rows};
  const ShareDifference same = difference_of(views, views, always(0));
  CHECK(same.least == Approx(0).margin(1e-12));
  CHECK(same.most == Approx(0).margin(1e-12));
  // Reading more and reading less are equally likely.
  for (const ShareDifference& open :
       {difference_of(views, views, always(0.2)), difference_of(views, views, {})}) {
    CHECK(open.least < -0.05);
    CHECK(open.most == Approx(-open.least));
  }
}

TEST_CASE("a reported difference holds in 19 of 20 draws", "[design]") {
  // Levels of twelve views with two layouts: the common error is 0.3, and the error of the
  // difference is 0.1. The true levels are drawn, and from them what paths would find.
  Random random(3, RandomStream::test);
  random.start(0);
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1 - random.uniform_double())) *
           std::cos(2 * pi * random.uniform_double());
  };
  constexpr int draws = 400;
  int held = 0;
  double width = 0, width_apart = 0;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<Uncertain> a, b;
    double truly = 0;
    for (int view = 0; view < 12; ++view) {
      const double x = level_read - 0.6 + 1.2 * random.uniform_double();
      const double y = x + 0.2 * normal();
      truly += ((y >= level_read) - (x >= level_read)) / 12.0;
      const double common = 0.3 * normal();
      a.push_back({x + common, 0.3});
      b.push_back({y + common + 0.1 * normal(), std::hypot(0.3, 0.1)});
    }
    const Looked first = looked(a), other = looked(b);
    const LayoutViews of_a{first.places, first.rows}, of_b{other.places, other.rows};
    const ShareDifference said = difference_of(of_a, of_b, always(0.1));
    const ShareDifference apart = difference_of(of_a, of_b, {});
    held += truly >= said.least - 1e-9 && truly <= said.most + 1e-9;
    width += said.most - said.least;
    width_apart += apart.most - apart.least;
  }
  INFO(held << " of " << draws << " hold");
  // 95 %, within three standard errors of this number of draws.
  CHECK(held >= 0.95 * draws - 3 * std::sqrt(0.95 * 0.05 * draws));
  CHECK(width < 0.8 * width_apart);
}

TEST_CASE("a layout that is certainly read less than one of no higher cost is eliminated",
          "[design]") {
  const auto judged_as = [](const std::string& name, double objective, LegibleShare share,
                            ShareDifference beyond) {
    JudgedLayout out;
    out.name = name;
    out.objective = objective;
    out.rounds = 1;
    out.smoke = {{"fire", {}, share, beyond}};
    return out;
  };
  const JudgedLayout a = judged_as("A", 4, {0.5, 0.7}, {0, 0});
  const JudgedLayout less = judged_as("B", 5, {0.45, 0.65}, {-0.1, -0.02}),
                     more = judged_as("C", 5, {0.55, 0.75}, {0.02, 0.1}),
                     open = judged_as("D", 5, {0.45, 0.75}, {-0.05, 0.05});
  CHECK(beats(a, less));
  CHECK_FALSE(beats(a, more));
  CHECK_FALSE(beats(a, open));
  CHECK(beats(more, less));  // by the differences of both from A
  CHECK_FALSE(beats(more, open));
  SmokeStage stage;
  stage.scenarios = {"fire"};
  stage.layouts = {a, less, more, open};
  CHECK(stage.recommended().name == "C");
  const Texts english(Language::en);
  DesignRecord record;
  record.objective.kind = "number";
  record.smoke = record_of(stage);
  std::string told;
  for (const std::string& line : smoke_words(english, *record.smoke)) told += line + "\n";
  INFO(told);
  CHECK(told.find("+2.0 to +10.0 % beside layout A: it is recommended") != std::string::npos);
  const std::string page = smoke_section(english, record);
  CHECK(page.find("−10.0 to −2.0 %") != std::string::npos);
  CHECK(page.find("−5.0 to +5.0 %") != std::string::npos);
}

TEST_CASE("shared paths estimate the difference of layouts better than each layout", "[design]") {
  // Where the sign is just legible, the luminaire that differs is far away.
  const auto scene = closely_looked_at("0.2");
  const std::vector<JudgedLayout> layouts{corridor_layout(scene, "A", {3, 8, 13}),
                                          corridor_layout(scene, "B", {5, 8, 13}),
                                          corridor_layout(scene, "C", {3, 8, 13})};
  const auto groups = layout_groups_of(layouts, 1, true);
  REQUIRE(groups.size() == 1);
  const Scenario fire = find_scenario(*scene, "fire").value();
  // Differences of levels over many seeds, with the errors that single seeds report.
  struct Found {
    std::vector<double> difference, said, alone;
  };
  std::map<size_t, Found> views;
  size_t equal = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    AssessOptions asked;
    asked.threads = 2;
    asked.seed = seed;
    asked.sure_errors = sure_errors_of_races;
    auto state = LayoutGroupState::make(*groups.front().lights, *groups.front().base, fire, asked,
                                        [](const std::string&, double) {});
    REQUIRE(state.ok());
    SightsInLights& sights = state.value()->sights();
    REQUIRE(sights.trace(0, {true, true, true}, nobody, [](const std::string&, double) {}).ok());
    for (size_t row = 0; row < sights.rows(0).size(); ++row) {
      const Sight &a = sights.rows(0)[row].sight, &b = sights.rows(1)[row].sight,
                  &c = sights.rows(2)[row].sight;
      if (const auto none = sights.error_beyond_first(2, row)) {
        CHECK(*none == 0);  // the same luminaires
        CHECK(a.reading_level.value == Approx(c.reading_level.value));
        ++equal;
      }
      const auto error = sights.error_beyond_first(1, row);
      if (error && may_be_read(a) && may_be_read(b)) {
        Found& found = views[row];
        found.difference.push_back(b.reading_level.value - a.reading_level.value);
        found.said.push_back(*error);
        found.alone.push_back(std::hypot(a.reading_level.error, b.reading_level.error));
      }
    }
  }
  CHECK(equal > 0);
  size_t looked_at = 0;
  for (const auto& [row, found] : views) {
    if (found.difference.size() < 10) continue;
    ++looked_at;
    const auto mean = [](const std::vector<double>& list) {
      double sum = 0;
      for (const double x : list) sum += x;
      return sum / static_cast<double>(list.size());
    };
    double squares = 0;
    for (const double x : found.difference)
      squares += (x - mean(found.difference)) * (x - mean(found.difference));
    const double spread = std::sqrt(squares / static_cast<double>(found.difference.size() - 1));
    INFO("row " << row << ": spread " << spread << ", said " << mean(found.said)
                << ", as of independent layouts " << mean(found.alone));
    CHECK(mean(found.said) < 0.5 * mean(found.alone));
    // The standard deviation of 10 draws has an error of 24 %.
    CHECK(spread < 1.7 * mean(found.said));
  }
  CHECK(looked_at >= 1);
}

TEST_CASE("two layouts in smoke are distinguished although their ranges overlap", "[design]") {
  const auto scene = closely_looked_at("0.1");
  SmokeStageOptions asked;
  asked.scenarios = {"fire"};
  asked.threads = 2;
  asked.rounds = 1;
  // B has one more luminaire, whose light falls on the sign; C has the luminaires of A.
  const auto stage = judge_in_smoke(
      {corridor_layout(scene, "A", {3, 8, 13}), corridor_layout(scene, "B", {3, 8, 13, 15}),
       corridor_layout(scene, "C", {3, 8, 13})},
      asked, nobody, [](const std::string&) {});
  INFO((stage ? "" : stage.problem().text()));
  REQUIRE(stage);
  const JudgedLayout &a = stage->layouts[0], &b = stage->layouts[1], &c = stage->layouts[2];
  INFO(a.worst().least << " to " << a.worst().most << ", and " << b.worst().least << " to "
                       << b.worst().most << ": " << b.beyond_first().least << " to "
                       << b.beyond_first().most);
  CHECK(a.worst().least < a.worst().most);
  CHECK(b.worst().least < a.worst().most);
  CHECK(b.beyond_first().least > 0);
  CHECK(stage->recommended().name == "B");
  CHECK(c.worst().least < c.worst().most);
  CHECK(difference_of(a, c).least == 0);
  CHECK(difference_of(a, c).most == 0);
  // Four times as many paths give the same result.
  asked.rounds = 2;
  const auto longer = judge_in_smoke(
      {corridor_layout(scene, "A", {3, 8, 13}), corridor_layout(scene, "B", {3, 8, 13, 15})}, asked,
      nobody, [](const std::string&) {});
  REQUIRE(longer);
  CHECK(longer->layouts[1].beyond_first().least > 0);
}

}  // namespace luxodus
