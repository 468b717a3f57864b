#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "actors/cast/process/in_process.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int cells = 8;
constexpr int nodes = 2;
constexpr int64_t batch_particles = 2048;
constexpr int64_t particles = 16 * batch_particles;

/// The furnished room, its air a data set of 160 x 120 x 24 cells, 0.02 to 0.18/m, albedo 0.8.
std::shared_ptr<const CompiledScene> smoky_room() {
  auto description =
      std::make_shared<SceneDescription>(*furnished_room(Air::clear, {})->description);
  description->run.batch_particles = batch_particles;
  Medium smoke;
  smoke.name = "smoke";
  smoke.kind = MediumKind::data_set;
  smoke.optics.albedo = Spectrum::constant(0.8);
  smoke.data.nx = 160;
  smoke.data.ny = 120;
  smoke.data.nz = 24;
  smoke.data.extent = {20, 15, 3};
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x)
        smoke.data.extinction.push_back(
            0.1f + 0.08f * static_cast<float>(std::sin(0.1 * x) * std::cos(0.07 * y + 0.2 * z)));
  description->media.push_back(smoke);
  auto scene = compile_scene(description, find_scenario(*description, "").value(), {cells});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  return std::move(scene).value();
}

StopRule rule() {
  StopRule stop;
  stop.particles = particles;
  return stop;
}

void print_row(const std::shared_ptr<const CompiledScene>& scene, size_t fibers, size_t budget,
               bool sharing) {
  NodesOptions options;
  options.nodes = nodes;
  options.fibers = fibers;
  options.portion = 1;
  options.object_bytes = budget;
  options.profile_share = 0;
  options.sharing = sharing;
  const std::atomic<bool> never{false};
  LocalRun run(scene, 1, 1);
  NodesReport report;
  const double began = wall_seconds();
  const auto ended = run_on_nodes(
      run, options, rule(), never, [](const Progress&) {}, &report);
  if (!ended.ok()) throw std::runtime_error(ended.problem().text());
  const double million = static_cast<double>(run.particles()) * 1e-6;
  const WorkerReport& all = report.workers;
  fmt::print("{:>8.1f} {:>6}  {:<7} {:>8.2f} {:>12.0f} {:>9.1f} {:>9} {:>9} {:>7.2f}\n",
             static_cast<double>(budget) * 1e-6, fibers, sharing ? "shared" : "apart",
             100 * all.hit_rate(), static_cast<double>(all.fetches) / million,
             static_cast<double>(all.fetched_bytes) * 1e-6 / million, all.builds, all.builds_saved,
             wall_seconds() - began);
  std::fflush(stdout);
}

}  // namespace

void print_smoke() {
  spdlog::set_level(spdlog::level::err);
  const auto scene = smoky_room();
  const SceneObjects objects(*scene, std::array{NodeId{0}}, 1);
  const uint64_t built = built_bytes_of(*scene);
  const std::atomic<bool> never{false};
  LocalRun plain(scene, 1, nodes);
  const double began = wall_seconds();
  plain.run(rule(), never, [](const Progress&) {});
  fmt::print(
      "\nSmoke fetched: {} cells and {} bricks, at most {:.1f} MB once built, {} nodes, {} "
      "particles;\nresident, {} threads: {:.2f} s\n",
      cells, objects.places().size() - cells, static_cast<double>(built) * 1e-6, nodes, particles,
      nodes, wall_seconds() - began);
  fmt::print("{:>8} {:>6}  {:<7} {:>8} {:>12} {:>9} {:>9} {:>9} {:>7}\n", "MB each", "fibers",
             "nodes", "hits %", "fetches/Mp", "MB/Mp", "builds", "saved", "s");
  for (const size_t part : {1u, 8u})
    for (const size_t fibers : {64u, 1024u})
      for (const bool sharing : {false, true}) print_row(scene, fibers, built / part, sharing);
}

}  // namespace luxodus::bench
