// Studies: mistakes in a file are reported with their line; a study is reproducible, writes its
// files, and its virtual time follows the costs.
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "actors/lab/study/calibrate.hpp"
#include "actors/lab/study/runs.hpp"
#include "actors/lab/study/scenes.hpp"
#include "actors/lab/study/study_report.hpp"
#include "actors/lab/study/study_schema.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

const std::string scene_file = std::string(LUX_SOURCE_DIR) + "/scenes/library/empty_room.toml";
const std::atomic<bool> nobody{false};

constexpr const char* plot_text =
    "[[plot]]\nname = \"p\"\ntitle = \"P\"\nx = \"fibers\"\ny = \"seconds\"\nexplain = \"e\"\n";

/// A study of the empty room with the given top and sweep.
std::string text_of(const std::string& top, const std::string& sweep) {
  return "title = \"T\"\nscene = \"" + scene_file + "\"\ncosts = \"c.toml\"\n" + top +
         "[sweep]\nfibers = [1, 8]\n" + sweep + plot_text;
}

Study good(const std::string& top, const std::string& sweep) {
  ReadStudy read = parse_study(text_of(top, sweep), "s.toml");
  INFO((read.problems.list().empty() ? "" : read.problems.list().front().text()));
  REQUIRE(read.study);
  return std::move(*read.study);
}

std::string first_problem(const std::string& text) {
  const ReadStudy read = parse_study(text, "s.toml");
  REQUIRE_FALSE(read.study);
  return read.problems.list().front().text();
}

SimCosts some_costs() {
  SimCosts costs;
  costs.particle_ns = 500;
  costs.ray_ns = 300;
  costs.collision_ns = 200;
  costs.reference_ns = 250;
  costs.switch_ns = 60;
  costs.build_ns = 20'000;
  costs.build_byte_ns = 1;
  costs.lease_ns = 3000;
  costs.send_ns = 1500;
  return costs;
}

StudyOutcome outcome_of(const Study& study, const SimCosts& costs) {
  spdlog::set_level(spdlog::level::off);
  auto read = read_scene(scene_file);
  REQUIRE(read.scene);
  StudyScenes scenes(study, *read.scene);
  StudyOutcome outcome{study, {costs, "a machine", "empty_room"}, {}};
  for (const StudyPoint& point : study.points())
    for (int i = 0; i < study.seeds; ++i) {
      const uint64_t seed = study.first_seed + static_cast<uint64_t>(i);
      auto scene = scenes.get(static_cast<int>(study.whole(point, "cells")),
                              study.whole(point, "lease_particles"));
      REQUIRE(scene.ok());
      StudyRun run{study, point, scene.value(), seed, costs, nullptr};
      std::shared_ptr<const Recording> recording;
      if (study.word(point, "on") == "replay") {
        recording = Recording::make(*run.scene, seed, particles_of(study, point), costs).value();
        run.recording = recording.get();
      }
      auto result =
          is_real(study.word(point, "on")) ? run_real(run, nobody) : run_simulated(run, nobody);
      INFO((result.ok() ? "" : result.problem().what));
      REQUIRE(result.ok());
      outcome.rows.push_back({point, seed, std::move(result).value(), ""});
    }
  return outcome;
}

const std::string small =
    "nodes = 3\ncells = 24\nparticles = 512\nlease_particles = 32\n"
    "cache = 0.5\n";

}  // namespace

TEST_CASE("a mistake in a study is reported with its line and what to do", "[study]") {
  CHECK(first_problem(text_of("", "fibres = 3\n")).find("did you mean 'fibers'?") !=
        std::string::npos);
  CHECK(first_problem(text_of("", "nodes = [4, 5000]\n")).rfind("s.toml:6:", 0) == 0);
  CHECK(first_problem(text_of("", "nodes = [4, 4]\n")).find("twice") != std::string::npos);
  CHECK(first_problem(text_of("", "topology = \"tours\"\n")).find("torus") != std::string::npos);
  CHECK(first_problem(text_of("seeds = 0\n", "")).find("'seeds'") != std::string::npos);
  CHECK(first_problem("title = \"T\"\n").find("scene") != std::string::npos);
  CHECK(first_problem("title = ").find("not TOML") != std::string::npos);
  const std::string wrong_column = text_of("", "") +
                                   "[[plot]]\nname = \"q\"\ntitle = \"Q\"\nx = \"fibers\"\n"
                                   "y = \"secnods\"\nexplain = \"e\"\n";
  CHECK(first_problem(wrong_column).find("did you mean \"seconds\"?") != std::string::npos);
  const std::string many =
      "delay_ms = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\ncells = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11]\n"
      "nodes = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\nlinks = [2, 3, 4, 5, 6, 7, 8, 9]\n";
  CHECK(first_problem(text_of("", many)).find("at most 10000") != std::string::npos);
}

TEST_CASE("a simulated study needs costs, one on real nodes does not", "[study]") {
  const std::string without = "title = \"T\"\nscene = \"s\"\n[sweep]\nfibers = [1, 8]\n";
  CHECK(first_problem(without + plot_text).find("costs") != std::string::npos);
  CHECK(parse_study(without + "on = \"nodes\"\n" + plot_text, "s.toml").study.has_value());
}

TEST_CASE("points that can never run are reported before the first of them runs", "[study]") {
  // Line 6 is the first one after `fibers`.
  const std::string shards = first_problem(text_of("", "nodes = [8, 3]\ntally_shards = [1, 5]\n"));
  CHECK(shards.rfind("s.toml:7:", 0) == 0);
  CHECK(shards.find("nodes = 3, fan_out = 0 and tally_shards = 5") != std::string::npos);
  CHECK(shards.find("1 to 4 shards") != std::string::npos);
  const std::string levels =
      first_problem(text_of("", "tally_shards = 2\nfan_out = [0, 4]\nnodes = [4, 8]\n"));
  CHECK(levels.rfind("s.toml:6:", 0) == 0);
  CHECK(levels.find("one coordinator") != std::string::npos);
  CHECK(first_problem(text_of("", "nodes = 4\nfan_out = 1\n")).rfind("s.toml:7:", 0) == 0);
  CHECK(good("", "nodes = [4, 8]\nfan_out = [0, 8]\ntally_shards = [1, 5]\n").points().size() ==
        16);
}

TEST_CASE("the points of a study are all combinations of its values", "[study]") {
  const Study study = good("", "nodes = [2, 4, 8]\ntopology = [\"amp\", \"ring\"]\n");
  CHECK(study.points().size() == 12);
  CHECK(study.varied().size() == 3);
}

TEST_CASE("costs are read back from the file that they were written to", "[study]") {
  const test::TemporaryFolder folder;
  const auto path = folder / "costs.toml";
  const MeasuredCosts measured{some_costs(), "a machine", "a scene"};
  REQUIRE(write_file_atomically(path, costs_text(measured)).ok());
  const ReadCosts read = read_costs(path);
  REQUIRE(read.measured);
  CHECK(read.measured->costs == measured.costs);
  CHECK(read.measured->machine == "a machine");
}

TEST_CASE("the README of studies ends with every table and key of the schema", "[study]") {
  std::ifstream in(std::string(LUX_SOURCE_DIR) + "/actors/lab/study/README.md");
  std::stringstream text;
  text << in.rdbuf();
  const size_t from = text.str().find("### ");
  REQUIRE(from != std::string::npos);
  CHECK(text.str().substr(from) + "\n" == toml::schema_markdown(study_schema()));
}

TEST_CASE("a fit recovers the costs behind measured times, without disturbed rows", "[study]") {
  std::vector<std::vector<double>> rows;
  std::vector<double> values;
  for (int i = 1; i < 200; ++i) {
    rows.push_back({static_cast<double>(8 * (1 + i % 4)), static_cast<double>(30 + i * 7 % 101),
                    static_cast<double>(i * 13 % 57)});
    const auto& row = rows.back();
    values.push_back((500 * row[0] + 300 * row[1]) * (i % 20 == 0 ? 9 : 1));
  }
  const auto x = fitted_costs(rows, values);
  CHECK(x[0] == Approx(500).epsilon(0.01));
  CHECK(x[1] == Approx(300).epsilon(0.01));
  CHECK(x[2] == Approx(0).margin(3));
}

TEST_CASE("a simulated study run twice has the same results, bit for bit", "[study]") {
  const Study study = good("seeds = 2\n", small);
  const StudyOutcome once = outcome_of(study, some_costs());
  const StudyOutcome twice = outcome_of(study, some_costs());
  CHECK(study_table(once).text() == study_table(twice).text());
  CHECK(once.rows[0].result->seconds != once.rows[1].result->seconds);
  CHECK(once.rows[0].result->workers.fetches > 0);
}

TEST_CASE("a study leaves a table, JSON, a drawing for each plot and a page", "[study]") {
  const test::TemporaryFolder folder;
  const Study study = good("seeds = 1\n", small);
  REQUIRE(write_study(folder.path(), outcome_of(study, some_costs())).ok());
  for (const char* name : {"results.csv", "results.json", "p.svg", "index.html"})
    CHECK(std::filesystem::file_size(folder / name) > 100);
  std::ifstream in(folder / "index.html");
  std::stringstream page;
  page << in.rdbuf();
  CHECK(page.str().find("<svg") != std::string::npos);
  CHECK(page.str().find("http") == page.str().find("http://www.w3.org/2000/svg"));
}

TEST_CASE("builds take virtual time in proportion to their number", "[study]") {
  const Study study = good("seeds = 1\njitter_ms = 0\n", small);
  SimCosts dear = some_costs();
  dear.build_ns += 1'000'000;
  const StudyResult cheap_run = *outcome_of(study, some_costs()).rows.front().result;
  const StudyResult dear_run = *outcome_of(study, dear).rows.front().result;
  CHECK(dear_run.flux_hash == cheap_run.flux_hash);
  const double builds = static_cast<double>(dear_run.workers.builds);
  REQUIRE(builds > 0);
  CHECK(dear_run.busy_s > builds * 1e-3);
  CHECK(dear_run.seconds > cheap_run.seconds);
}

TEST_CASE("the last flush of a run is sent at once, and not at the next beat", "[study]") {
  const StudyOutcome outcome = outcome_of(good("seeds = 1\n", small), some_costs());
  for (const StudyRow& row : outcome.rows) CHECK(row.result->seconds < 0.2);
}

TEST_CASE("nodes that share the cores of a machine take as long as the cores allow", "[study]") {
  const std::string resident = "nodes = 4\nparticles = 16384\nlease_particles = 64\ncache = 0\n";
  const StudyResult own = *outcome_of(good("seeds = 1\n", resident), some_costs()).rows[0].result;
  const StudyResult one =
      *outcome_of(good("seeds = 1\ncores = 1\n", resident), some_costs()).rows[0].result;
  CHECK(one.flux_hash == own.flux_hash);
  CHECK(one.seconds > 2 * own.seconds);
}

TEST_CASE("a replay gives the flux of tracing and takes its time", "[study]") {
  const Study study = good("seeds = 1\n", small + "on = [\"replay\", \"simulation\"]\n");
  const StudyOutcome outcome = outcome_of(study, some_costs());
  REQUIRE(outcome.rows.size() == 4);
  CHECK(outcome.rows[0].result->flux_hash == outcome.rows[2].result->flux_hash);
  const auto comparisons = comparisons_of(outcome);
  REQUIRE(comparisons.size() == 1);
  for (const auto& error : comparisons.front().errors()) {
    INFO(error.column);
    if (error.column == "particles_per_s") CHECK(error.most < 0.1);
    if (error.column == "fetches_per_particle") CHECK(error.most < 0.1);
  }
}

TEST_CASE("real nodes give the flux of simulated ones", "[study]") {
  const Study study =
      good("seeds = 1\n", small + "on = [\"simulation\", \"nodes\", \"processes\"]\n");
  const StudyOutcome outcome = outcome_of(study, some_costs());
  for (const StudyRow& row : outcome.rows) {
    CHECK(row.result->flux_hash == outcome.rows.front().result->flux_hash);
    CHECK(row.result->workers.fetch_delay.count() > 0);
    CHECK(row.result->busy_s > 0);
  }
}
