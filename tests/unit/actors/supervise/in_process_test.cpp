// Runs on nodes of this process against the plain loop: the same bits, whatever the nodes.
#include "actors/supervise/in_process.hpp"

#include <spdlog/spdlog.h>

#include <catch2/catch.hpp>

#include "scenes/format/scene_file.hpp"
#include "scenes/transport/compile.hpp"

using namespace luxodus;

namespace {

const std::atomic<bool> nobody{false};
void ignore(const Progress&) {}

std::shared_ptr<const CompiledScene> scene_of(const char* name, const char* scenario, int cells) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/" + name + ".toml");
  REQUIRE(read.scene);
  auto description = std::make_shared<SceneDescription>(*read.scene);
  description->run.batch_particles = 4096;
  auto compiled =
      compile_scene(description, find_scenario(*description, scenario).value(), {cells});
  REQUIRE(compiled.ok());
  return compiled.value();
}

/// Bins of the totals that differ in any bit; every one where batches do.
int64_t differences(const LocalRun& a, const LocalRun& b) {
  int64_t count = 0;
  for (int g = 0; g < a.totals().groups(); ++g) {
    const auto& x = a.totals().state(g);
    const auto& y = b.totals().state(g);
    CHECK(x.batches == y.batches);
    for (size_t i = 0; i < x.totals.size(); ++i) {
      count += x.totals[i].sum != y.totals[i].sum || x.totals[i].squares != y.totals[i].squares;
    }
  }
  CHECK(a.totals().ledger().rays == b.totals().ledger().rays);
  CHECK(b.totals().ledger().closes());
  return count;
}

void check_same_bits(const std::shared_ptr<const CompiledScene>& scene, const StopRule& stop,
                     const std::vector<NodesOptions>& cases) {
  spdlog::set_level(spdlog::level::err);
  LocalRun plain(scene, 1, 2);
  const StopReason reason = plain.run(stop, nobody, ignore);
  for (const NodesOptions& nodes : cases) {
    INFO(nodes.nodes << " nodes of " << nodes.fibers << " fibers");
    LocalRun run(scene, 1, 1);
    NodesReport report;
    const auto ended = run_on_nodes(run, nodes, stop, nobody, ignore, &report);
    REQUIRE(ended.ok());
    CHECK(ended.value() == reason);
    CHECK(run.batches() == plain.batches());
    CHECK(differences(plain, run) == 0);
    CHECK(report.flushes > 0);
  }
}

}  // namespace

TEST_CASE("1, 2, 8 and 32 nodes give the bits of the plain loop", "[nodes]") {
  StopRule stop;
  stop.particles = 200'000;
  check_same_bits(scene_of("smoke_tank", "", 1), stop, {{1}, {2, 4, 5}, {8}, {32, 4, 3, 50}});
}

TEST_CASE("a partitioned scene with signs, probes and bands is the same on nodes", "[nodes]") {
  StopRule stop;
  stop.particles = 60'000;
  check_same_bits(scene_of("office_floor", "smoke_emergency", 6), stop, {{3, 4, 7}});
}

TEST_CASE("nodes stop at the same round as the plain loop for an error", "[nodes]") {
  StopRule stop;
  stop.relative_error = 0.02;
  check_same_bits(scene_of("smoke_tank", "", 1), stop, {{2, 4, 2}});
}

TEST_CASE("a run on nodes goes on where another ended, as if it were one", "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("smoke_tank", "", 1);
  StopRule half, all;
  half.particles = 50'000;
  all.particles = 100'000;
  LocalRun plain(scene, 1, 1);
  plain.run(all, nobody, ignore);
  LocalRun run(scene, 1, 1);
  REQUIRE(run_on_nodes(run, {2}, half, nobody, ignore).ok());
  REQUIRE(run_on_nodes(run, {3}, all, nobody, ignore).ok());
  CHECK(differences(plain, run) == 0);
}

TEST_CASE("an interrupted run on nodes ends with whole batches that can be gone on from",
          "[nodes]") {
  spdlog::set_level(spdlog::level::err);
  const auto scene = scene_of("smoke_tank", "", 1);
  std::atomic<bool> interrupt{false};
  LocalRun run(scene, 1, 1);
  StopRule endless;
  endless.particles = int64_t{1} << 40;
  const auto ended =
      run_on_nodes(run, {2}, endless, interrupt, [&](const Progress&) { interrupt = true; });
  REQUIRE(ended.ok());
  CHECK(ended.value() == StopReason::interrupted);
  REQUIRE(run.batches() > 0);
  StopRule stop;
  stop.particles = run.batches() * scene->batch_particles;
  LocalRun plain(scene, 1, 1);
  plain.run(stop, nobody, ignore);
  CHECK(differences(plain, run) == 0);
}
