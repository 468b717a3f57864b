// Thresholds of sight: at a found value an assessment of its own gives the level of the limit.
#include "actors/judge/thresholds/thresholds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/assess/threshold_words.hpp"
#include "actors/results/run/run_in_pieces.hpp"
#include "scenes/emergency/smoke_laws.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"
#include "tests/unit/actors/judge/assess/round_nodes.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

const std::atomic<bool> nobody{false};
const AssessProgress no_report = [](const std::string&, double) {};

/// The scene with its assessment, in which thresholds are sought.
struct Assessed {
  explicit Assessed(const std::string& text)
      : scene(described_text(text)), scenario(find_scenario(*scene, "failed").value()) {
    options.threads = 2;
    options.rules = {"en1838-2013"};
    auto made = assess(scene, options, nobody, no_report);
    INFO((made.ok() ? "" : made.problem().text()));
    REQUIRE(made.ok());
    assessment = std::move(made).value();
  }
  Result<ThresholdRows> tried(Sought sought) const {
    return find_thresholds({*scene, scenario, assessment, options, nobody, no_report}, {sought});
  }
  ThresholdRows found(Sought sought) const {
    auto rows = tried(sought);
    INFO((rows.ok() ? "" : rows.problem().text()));
    REQUIRE(rows.ok());
    return std::move(rows).value();
  }

  std::shared_ptr<const SceneDescription> scene;
  Scenario scenario;
  AssessOptions options;
  Assessment assessment;
};

/// The view of a threshold in another scene or smoke, with other random numbers and many paths.
SightRow view_of(const ThresholdRecord& threshold, const std::string& text, double smoke = 1) {
  const auto scene = described_text(text);
  AssessOptions options;
  options.seed = 99;
  options.threads = 2;
  options.rounds = 3;
  options.wanted = [&](const SightRow& row) {
    return row.from == threshold.from && row.along_m == threshold.along_m;
  };
  options.enough = [](const SightRow&) { return false; };
  Assessment out;
  REQUIRE(assess_sights(*scene, find_scenario(*scene, "failed").value(), {smoke, {}, false},
                        options, nobody, no_report, out)
              .ok());
  REQUIRE(out.sights.size() == 1);
  return out.sights.front();
}

/// Whether the view's level is that of the threshold's limit, within five standard errors and the
/// change of the level over five errors of the threshold.
void check_at_limit(const ThresholdRecord& threshold, const SightRow& view, double level_by_value) {
  const LevelPoint point = point_of(0, view.sight, threshold.read);
  INFO(name_of(threshold.sought) << " " << threshold.at.value << " +- " << threshold.at.error
                                 << ", excess " << point.excess << " +- " << point.error);
  CHECK(std::abs(point.excess) <=
        5 * std::hypot(point.error, level_by_value * threshold.at.error) + 0.02);
}

const std::string smoky = with_smoke(0.5, 0.9);

}  // namespace

TEST_CASE("at a found extinction signs are just read and just seen") {
  const Assessed room(smoky);
  const auto rows = room.found(Sought::extinction);
  REQUIRE(rows.size() == 2 * room.assessment.sights.size());
  size_t found = 0;
  for (const ThresholdRecord& row : rows) {
    if (row.end != ThresholdEnd::found) continue;
    ++found;
    CHECK_FALSE(row.above);
    CHECK(row.at.error < 0.05 * row.at.value);
    CHECK(row.amounts_to->value == Approx(0.5 * row.at.value).epsilon(1e-2));
    const SightRow view = view_of(row, smoky, row.at.value);
    // Beer's law: the level falls at least with the line's optical depth.
    check_at_limit(row, view, 0.5 * view.view.distance_m);
  }
  CHECK(found >= 4);
}

TEST_CASE("irritant smoke ends reading at its extinction, whatever the light") {
  const Assessed room(replaced(smoky, "irritant_smoke = false", "irritant_smoke = true"));
  for (const ThresholdRecord& row : room.found(Sought::extinction)) {
    if (!row.read) continue;
    REQUIRE(row.end == ThresholdEnd::found);
    // Jin and Yamada's distance is that of the eye.
    const auto view = std::find_if(room.assessment.sights.begin(), room.assessment.sights.end(),
                                   [&](const SightRow& one) { return one.along_m == row.along_m; });
    const double limit = irritant_distance_m(jin_constant(SignLighting::internal),
                                             row.amounts_to->value * (1 - 1e-3));
    CHECK(view->view.distance_m <= limit);
  }
}

TEST_CASE("at a found luminance and size signs are just read") {
  const Assessed room(smoky);
  for (const Sought sought : {Sought::luminance, Sought::size}) {
    size_t checked = 0;
    for (const ThresholdRecord& row : room.found(sought)) {
      if (row.end != ThresholdEnd::found || !row.read || row.at.value < 0.5) continue;
      ++checked;
      CHECK(row.above);
      const double f = row.at.value;
      std::string text = smoky;
      if (sought == Sought::luminance) {
        text =
            replaced(text, "emergency_white = 100", fmt::format("emergency_white = {}", 100 * f));
        text = replaced(text, "emergency_green = 10", fmt::format("emergency_green = {}", 10 * f));
        CHECK(row.amounts_to->value == Approx(100 * f));
      } else {
        text = replaced(text, "width = 0.4\nheight = 0.2",
                        fmt::format("width = {}\nheight = {}", 0.4 * f, 0.2 * f));
        text = replaced(text, "letter_height = 0.15",
                        fmt::format("letter_height = {}\nstroke = {}", 0.15 * f, 0.01905 * f));
      }
      // In a limited range the level rises no faster than with the square of the factor.
      check_at_limit(row, view_of(row, text), 2 / f);
    }
    CHECK(checked >= 1);
  }
}

TEST_CASE("at a found distance along the route the sign is just read") {
  const std::string fine = replaced(smoky, "spacing_m = 4", "spacing_m = 2");
  const Assessed room(fine);
  size_t checked = 0;
  for (const ThresholdRecord& row : room.found(Sought::distance)) {
    if (row.end != ThresholdEnd::found) continue;
    ++checked;
    CHECK(row.above);
    CHECK(row.amounts_to->value == Approx(std::hypot(10.95 - row.at.value, 0.55)).epsilon(1e-2));
    const std::string there = replaced(
        fine, "[[scenario]]",
        fmt::format(
            "[[observer]]\nname = \"eye\"\neye = [{}, 0, 1.65]\ngaze = [1, 0, 0]\n[[scenario]]",
            1 + row.at.value));
    ThresholdRecord by_observer = row;
    by_observer.from = {SubjectKind::observer, "eye"};
    by_observer.along_m = 0;
    check_at_limit(row, view_of(by_observer, there), 1);
  }
  CHECK(checked >= 1);
}

TEST_CASE("in layered smoke a sign is read below a height that is found") {
  const std::string layered = room + R"(
[[medium]]
name = "smoke"
kind = "layered"
[[medium.layer]]
z_low = 0
z_high = 1.5
extinction = 0.05
albedo = 0.5
[[medium.layer]]
z_low = 1.5
z_high = 3
extinction = 4
albedo = 0.5
)";
  const std::string lower_eyes =
      replaced(layered, "eye_heights_m = [1.65]", "eye_heights_m = [1.2]");
  const Assessed under(lower_eyes);
  const auto rows = under.found(Sought::height);
  size_t checked = 0;
  for (const ThresholdRecord& row : rows) {
    if (row.end != ThresholdEnd::found || !row.read || row.above) continue;
    ++checked;  // besides, the table hides signs near the floor
    CHECK(row.at.value > 1.2);
    CHECK(row.at.value < 2.5);
    const std::string hung =
        replaced(lower_eyes, "11.95, 0, 2.2", fmt::format("11.95, 0, {}", row.at.value));
    // Where the layer begins, 0.3 m above the eye, the depth on the line grows by this for a metre.
    const SightRow view = view_of(row, hung);
    check_at_limit(row, view, 4 * view.view.distance_m / 0.3);
  }
  CHECK(checked >= 1);
}

TEST_CASE("what cannot be found is said: no smoke, no sign, no light of its own") {
  const Assessed clear(room);
  const auto smoke = clear.tried(Sought::extinction);
  REQUIRE_FALSE(smoke.ok());
  CHECK(smoke.problem().what.find("has no smoke whose extinction could be varied") !=
        std::string::npos);
  const std::string luminances =
      "mains_white = 500\nmains_green = 50\nemergency_white = 100\nemergency_green = 10\n";
  const Assessed external(replaced(
      replaced(smoky, "lighting = \"internal\"", "lighting = \"external\""), luminances, ""));
  for (const ThresholdRecord& row : external.found(Sought::luminance))
    CHECK(row.end == ThresholdEnd::not_assessed);
  Assessed nobody_looks(smoky);
  nobody_looks.assessment.sights.clear();
  CHECK_FALSE(nobody_looks.tried(Sought::distance).ok());
}

TEST_CASE("thresholds of other eyes stand beside those of the stated age") {
  const Assessed room(
      replaced(smoky, "spacing_m = 4", "spacing_m = 4\nother_eyes = [\"23\", \"75\"]"));
  for (const Sought sought : {Sought::extinction, Sought::luminance}) {
    const auto rows = room.found(sought);
    REQUIRE(rows.size() == 6 * room.assessment.sights.size());
    size_t compared = 0;
    for (size_t i = 0; i < rows.size(); i += 6) {  // stated age, 23, 75: read, seen each
      if (rows[i + 2].end != ThresholdEnd::found || rows[i + 4].end != ThresholdEnd::found)
        continue;
      CHECK(rows[i + 2].eyes == "23");
      CHECK(rows[i + 4].eyes == "75");
      ++compared;
      const double young = rows[i + 2].at.value, old = rows[i + 4].at.value;
      if (sought == Sought::extinction)
        CHECK(young > old);
      else
        CHECK(young < old);
    }
    CHECK(compared >= 1);
  }
}

TEST_CASE("several thresholds are found as each by itself", "[thresholds]") {
  const Assessed room(smoky);
  const std::vector<Sought> sought{Sought::size, Sought::distance, Sought::luminance};
  const auto together = find_thresholds(
      {*room.scene, room.scenario, room.assessment, room.options, nobody, no_report}, sought);
  REQUIRE(together.ok());
  size_t rows = 0;
  for (const Sought one : sought) {
    const auto alone = room.found(one);
    rows += alone.size();
    for (const ThresholdRecord& row : alone)
      CHECK(std::any_of(together->begin(), together->end(), [&](const ThresholdRecord& other) {
        return other.sought == one && other.sign == row.sign && other.along_m == row.along_m &&
               other.read == row.read && other.end == row.end &&
               (row.end != ThresholdEnd::found || other.at.value == row.at.value);
      }));
  }
  CHECK(together->size() == rows);
}

TEST_CASE("nodes find the same thresholds as threads") {
  Assessed room(smoky);
  const RoundNodes nodes(room.scene);
  RunInPieces pieces(*nodes.nodes->executor(), []() -> Result<void> { return {}; });
  for (const Sought sought : {Sought::extinction, Sought::luminance}) {
    const auto by_threads = room.found(sought);
    room.options.executor = &pieces;
    const auto by_nodes = room.found(sought);
    room.options.executor = nullptr;
    REQUIRE(by_nodes.size() == by_threads.size());
    for (size_t i = 0; i < by_nodes.size(); ++i) {
      REQUIRE(by_nodes[i].end == by_threads[i].end);
      if (by_nodes[i].end != ThresholdEnd::found) continue;
      CHECK(by_nodes[i].at.value == by_threads[i].at.value);
      CHECK(by_nodes[i].at.error == by_threads[i].at.error);
    }
  }
}

TEST_CASE("thresholds are said for each sign and quantity, with the number of views") {
  const auto row = [](ThresholdEnd end, double value, const std::string& eyes = "") {
    ThresholdRecord out;
    out.sign = "exit";
    out.eyes = eyes;
    out.read = true;
    out.end = end;
    if (end == ThresholdEnd::found) out.at = {value, 0.1};
    return out;
  };
  const std::vector<ThresholdRecord> rows{
      row(ThresholdEnd::found, 2), row(ThresholdEnd::found, 0.5), row(ThresholdEnd::nowhere, 0),
      row(ThresholdEnd::not_assessed, 0), row(ThresholdEnd::found, 9, "23")};
  CHECK(thresholds_text(rows) ==
        "thresholds: extinction, as a factor on all smoke; in brackets the number of views\n"
        "  sign \"exit\" read: at most 0.5 to 2 (in 2), never (in 1), not assessed (in 1)\n");
  CHECK(thresholds_text({row(ThresholdEnd::found, 2)}).find("at most 2 (in 1)") !=
        std::string::npos);
  const std::string csv = thresholds_csv(rows).text();
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 6);
  CHECK(csv.find("exit,23,read,found,9,0.1") != std::string::npos);
  CHECK(thresholds_text({}).empty());
}
