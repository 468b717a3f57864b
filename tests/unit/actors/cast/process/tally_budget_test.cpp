// Nodes whose tally may not hold all bins: they flush when it is full, and change no bit.
#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>

#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/process/in_process.hpp"
#include "tests/unit/actors/cast/process/equal_bits.hpp"
#include "tests/unit/actors/cast/process/library_scene.hpp"

using namespace luxodus;

TEST_CASE("a full tally flushes, stays within its budget, and changes no bit", "[nodes][tally]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = fine_tank();
  StopRule stop;
  stop.particles = 40'000;
  LocalRun plain(scene, 1, 2);
  plain.run(stop, nobody, ignore);
  NodesOptions options;
  options.nodes = 2;
  options.fibers = 3;
  options.tally_bytes = uint64_t{128} << 20;
  REQUIRE(options.tally_bytes < tally_need(*scene, 2).all());
  LocalRun run(scene, 1, 1);
  NodesReport report;
  const auto ended = run_on_nodes(run, options, stop, nobody, ignore, &report);
  INFO((ended.ok() ? "" : ended.problem().what));
  REQUIRE(ended.ok());
  CHECK(differences(plain, run) == 0);
  CHECK(report.flushes > 4);  // without a budget: one per round and node
  CHECK(report.workers.max_tally_bytes > 0);
  CHECK(report.workers.max_tally_bytes <= options.tally_bytes);
}

TEST_CASE("a single batch that exceeds the budget ends the run with the key to change",
          "[nodes][tally]") {
  spdlog::set_level(spdlog::level::off);
  const auto scene = fine_tank();
  StopRule stop;
  stop.particles = 40'000;
  NodesOptions options;
  options.nodes = 1;
  options.tally_bytes = min_tally_bytes(*scene) + (1 << 18);
  LocalRun run(scene, 1, 1);
  const auto ended = run_on_nodes(run, options, stop, nobody, ignore);
  REQUIRE_FALSE(ended.ok());
  CHECK(ended.problem().what.find("n0: ") == 0);
  CHECK(ended.problem().what.find("raise tally_bytes") != std::string::npos);
  CHECK(ended.problem().what.find("batch_particles") != std::string::npos);
}
