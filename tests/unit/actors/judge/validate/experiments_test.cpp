// Experiments end to end: the cheap ones, and those whose threshold is known from a law.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "actors/judge/validate/experiment_report.hpp"
#include "actors/judge/validate/experiment_scene.hpp"
#include "scenes/emergency/mean_observer.hpp"
#include "scenes/emergency/sight.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::light {
namespace {

using Catch::Matchers::Contains;

const std::atomic<bool> nobody{false};

std::vector<ExperimentResult> run(const Experiments& experiments,
                                  const ExperimentOptions& options = {}) {
  auto results = run_experiments(experiments, options, nobody, [](const std::string&, double) {});
  INFO((results.ok() ? "" : results.problem().text()));
  REQUIRE(results.ok());
  return std::move(results).value();
}

/// An experiment of one trial.
Experiment of_trial(const Trial& trial) {
  Experiment out;
  out.id = "X1";
  out.title = "a test";
  out.trials = {trial};
  return out;
}

using std::numbers::pi;

double arcmin_of(double diameter_m, double distance_m) {
  return 2 * std::atan2(diameter_m / 2, distance_m) * 180 * 60 / pi;
}

constexpr ExperimentOptions few_paths{
    .rounds = 1, .verdict_rounds = 1, .max_repeats = 1, .other_levels = 1};

std::string shipped_page() {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/docs/validation/experiments.md");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("every experiment says its source, and claims something of its trials",
          "[validate][experiments]") {
  std::set<std::string> ids;
  for (const Experiment& e : all_experiments()) {
    INFO(e.id);
    CHECK(ids.insert(e.id).second);
    CHECK_FALSE(e.source.empty());
    CHECK_FALSE(e.read.empty());
    CHECK_FALSE(e.assumed.empty());
    CHECK_FALSE(e.claims.empty());
    for (const Claim& claim : e.claims) {
      CHECK_FALSE(claim.says.empty());
      for (const size_t i : claim.trials) {
        REQUIRE(i < e.trials.size());
        if (claim.rule == Rule::seen || claim.rule == Rule::read) CHECK(e.trials[i].observed);
      }
    }
  }
  CHECK(ids == std::set<std::string>{"T1", "T2", "T5", "T6", "T8", "T12", "T14", "T16", "T17",
                                     "T18", "T20"});
}

TEST_CASE("the levels at which the mean observer reads are those of T8 on the page",
          "[validate][experiments]") {
  std::ifstream page(std::string(LUX_SOURCE_DIR) + "/docs/validation/experiments.md");
  double least = 1e9, most = 0;
  bool of_t8 = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("### ")) of_t8 = line.starts_with("### T8");
    if (line.starts_with("At the threshold")) of_t8 = false;
    if (!of_t8 || !line.starts_with("| ") || line.starts_with("| trial")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
    const double factor = std::stod(cells.at(6));
    least = std::min(least, factor);
    most = std::max(most, factor);
  }
  const auto reads_at = [](double level) {
    ObservedView view{.age_years = 23, .distance_m = 8, .extinction = 1};
    view.reading_level = level;
    return standing_in_reading(view).observer;
  };
  REQUIRE(least < most);
  CHECK(reads_at(level_read * least * 0.95) == MeanObserver::no);
  CHECK(reads_at(level_read * least * 1.05) == MeanObserver::between);
  CHECK(reads_at(level_read * most * 0.95) == MeanObserver::between);
  CHECK(reads_at(level_read * most * 1.05) == MeanObserver::yes);
}

TEST_CASE("an experiment is named by its id, several by a part of their titles",
          "[validate][experiments]") {
  const auto ids = [](const std::string& text) {
    std::vector<std::string> out;
    for (const Experiment& e : experiments_named(text)) out.push_back(e.id);
    return out;
  };
  CHECK(ids("t1") == std::vector<std::string>{"T1"});
  CHECK(ids("landolt") == std::vector<std::string>{"T8", "T18"});
  CHECK(ids("no such thing").empty());
  CHECK(ids("").size() == all_experiments().size());
}

TEST_CASE("a target in black smoke is seen as far as Beer's law and the eye's threshold say",
          "[validate][experiments]") {
  Trial trial;
  trial.name = "disc";
  trial.scene = {.distance_m = 5,
                 .target = {.shape = TargetShape::disc, .width_m = 0.05, .luminance_cd_m2 = 100},
                 .smoke = {.albedo = 0}};
  trial.searched = {2, 20};
  const auto results = run({of_trial(trial)}, few_paths);
  const double arcmin = arcmin_of(0.05, 5);
  for (const double level : threshold_levels) {
    const auto& at = results[0].trials[0].at_level(level).at;
    REQUIRE(at);
    const double least = level * luminance_threshold(0, arcmin, false, {23});
    CHECK(at->value == Approx(std::log(100 / least)).margin(0.01));
  }
}

TEST_CASE("a contrast in clear air is seen at the eye's threshold", "[validate][experiments]") {
  const Experiments contrast = experiments_named("T2");
  const auto results = run(contrast);
  const ExperimentTarget& target = contrast[0].trials[0].scene.target;
  const double arcmin = arcmin_of(target.width_m, contrast[0].trials[0].scene.distance_m);
  const double least = luminance_threshold(target.ground_cd_m2, arcmin, false, {23});
  CHECK(results[0].trials[0].crossings[0].at->value ==
        Approx(least / target.ground_cd_m2).epsilon(1e-2));
}

TEST_CASE("lamps give the illuminance that an experiment states", "[validate][experiments]") {
  // A grey target reflects the light of the room: its luminance doubles with the illuminance.
  ExperimentScene scene{.distance_m = 3,
                        .target = {.shape = TargetShape::disc, .width_m = 0.3, .reflectance = 0.5},
                        .room = {.width_m = 2, .height_m = 2, .walls = 0.8, .far_wall = 0.8},
                        .lamps = {.lux = 100}};
  const auto difference = [&] {
    const auto seen = look_at_target(scene, {}, nobody);
    REQUIRE(seen.ok());
    return seen->difference;
  };
  const Uncertain once = difference();
  // Between a floor and a wall of a white room illuminances differ little.
  CHECK(once.value == Approx(100 * 0.5 / pi).epsilon(0.4));
  scene.lamps.lux = 200;
  CHECK(difference().value == Approx(2 * once.value).epsilon(1e-6));
}

TEST_CASE("a threshold in white smoke is the same for any number of threads",
          "[validate][experiments]") {
  Experiment first = experiments_named("T8").front();
  first.trials.resize(1);
  first.claims.resize(1);
  ExperimentOptions options = few_paths;
  const auto alone = run({first}, options);
  options.threads = 2;
  const auto together = run({first}, options);
  const auto& at = alone[0].trials[0].crossings;
  REQUIRE((at[0].at && at[1].at));
  CHECK(at[0].at->value == together[0].trials[0].crossings[0].at->value);
  CHECK(at[1].at->value == together[0].trials[0].crossings[1].at->value);
  CHECK(at[1].at->value < at[0].at->value);  // read less far than seen
  CHECK(at[0].at->error > 0);
  CHECK(at[0].at->value > 5);
  CHECK(at[0].at->value < 14);
}

TEST_CASE("claims on thresholds are judged by their rules", "[validate][experiments]") {
  Trial trial;
  trial.observed = Interval{8, 8};
  std::vector<Trial> trials(2, trial);
  trials[0].scene.target.luminance_cd_m2 = 1;
  trials[1].scene.target.luminance_cd_m2 = std::exp(1.0);
  const auto found = [](double seen, double read) {
    TrialResult out;
    out.crossings = {Crossing{Uncertain{seen, 0.01}, false},
                     Crossing{Uncertain{read, 0.01}, false}};
    return out;
  };
  const std::vector<TrialResult> results{found(8, 6), found(9, 7)};
  const auto judged = [&](const Claim& claim) {
    return judge_claim(claim, trials, results).agreement;
  };
  CHECK(judged({Rule::seen, {0}, ""}) == Agreement::kept);
  CHECK(judged({Rule::seen, {0, 1}, ""}) == Agreement::failing);
  CHECK(judged({Rule::read, {0, 1}, ""}) == Agreement::kept);
  CHECK(judged({Rule::slope, {0, 1}, "", {0.9, 1.1}}) == Agreement::kept);
  CHECK(judged({Rule::quotient, {1, 0}, "", {1.2, 2}}) == Agreement::failing);
  CHECK(judged({Rule::difference, {1, 0}, "", {0.5, 1.5}, 7}) == Agreement::kept);
  CHECK(judged({Rule::value, {1}, "", {6, 8}, 7}) == Agreement::kept);
  CHECK(judged({Rule::value, {1}, "", {6, 8}}) == Agreement::failing);
  CHECK(judged({Rule::beyond, {1, 0}, ""}) == Agreement::kept);
  CHECK(judged({Rule::much_beyond, {0, 1}, ""}) == Agreement::failing);
  CHECK(judged({Rule::about_equal, {0, 1}, ""}) == Agreement::failing);
  const std::vector<TrialResult> none(2);
  CHECK(judge_claim({Rule::seen, {0}, ""}, trials, none).agreement == Agreement::not_answered);
  CHECK(judge_claim({Rule::beyond, {0, 1}, ""}, trials, none).agreement == Agreement::not_answered);
}

TEST_CASE("an unsafe verdict and a thin margin are listed", "[validate][experiments]") {
  Trial trial;
  trial.name = "ring";
  trial.observed = Interval{8, 8};
  trial.of_reading = true;
  ExperimentResult result{of_trial(trial), {TrialResult{}}, {}};
  result.trials[0].crossings = {Crossing{Uncertain{9, 0.1}, false},
                                Crossing{Uncertain{7.6, 0.1}, false}};
  result.trials[0].at_observed = TargetSeen{};
  result.trials[0].at_observed->verdict = "visible but not legible";
  CHECK(summary_of({result}).unsafe.empty());
  CHECK(summary_of({result}).thin == std::vector<std::string>{"X1, ring: 0.40"});
  CHECK(summary_of({result}).passed());
  result.trials[0].at_observed->verdict = "legible";
  CHECK(summary_of({result}).unsafe == std::vector<std::string>{"X1, ring"});
  CHECK_FALSE(summary_of({result}).passed());
}

TEST_CASE("the files of experiments hold their thresholds, in lines of a document",
          "[validate][experiments]") {
  const test::TemporaryFolder folder;
  const auto results = run(experiments_named("T2"));
  REQUIRE(write_experiments(folder / "out", results, {}).ok());
  std::ifstream in(folder / "out" / "experiments.md");
  std::string line;
  while (std::getline(in, line)) {
    INFO(line);
    const auto continued = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
    CHECK((line.starts_with("|") || line.starts_with("#") ||
           line.size() - static_cast<size_t>(std::count_if(line.begin(), line.end(), continued)) <=
               100));
  }
  const Json json = experiments_json(results, {});
  CHECK(json["experiments"][0]["id"] == "T2");
  CHECK(json["experiments"][0]["trials"][0]["at_level_1"]["value"].get<double>() > 0);
  CHECK_THAT(experiments_text(results), Contains("T2  Threshold contrast"));
}

TEST_CASE("the page of experiments holds what those in clear air give, and the sources of all",
          "[validate][experiments]") {
  const std::string page = shipped_page();
  for (const char* id : {"T2", "T18", "T20"})
    CHECK_THAT(page, Contains(experiment_section(run(experiments_named(id))[0])));
  for (const Experiment& e : all_experiments())
    CHECK_THAT(page, Contains("### " + e.id + ": " + e.title));
}

TEST_CASE("the page of experiments is what all of them give", "[.long][validate]") {
  ExperimentRecord record;
  record.options.threads = 2;
  CHECK(experiments_page(run(all_experiments(), record.options), record) == shipped_page());
}

}  // namespace luxodus::light
