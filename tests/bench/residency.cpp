#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>
#include <stdexcept>

#include "actors/supervise/in_process.hpp"
#include "scenes/format/scene_file.hpp"
#include "scenes/transport/compile.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int cells = 256;
constexpr int nodes = 2;
constexpr int64_t batch_particles = 2048;
constexpr int64_t particles = 16 * batch_particles;
constexpr double profile_share = 0.1;  // of so short a run; 1 % of a long one is more

struct Plan {
  const char* name;
  double profile_share;
  double pinned_share;
};
constexpr Plan plans[] = {
    {"none", 0, 0}, {"holders and leases", profile_share, 0}, {"and pins", profile_share, 0.5}};

std::shared_ptr<const CompiledScene> office() {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/office_floor.toml");
  if (!read.scene) throw std::runtime_error(read.problems.list().front().text());
  auto description = std::make_shared<SceneDescription>(std::move(*read.scene));
  description->run.batch_particles = batch_particles;
  auto scene =
      compile_scene(description, find_scenario(*description, "smoke_mains").value(), {cells});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  return std::move(scene).value();
}

/// What all cells take once they are built [bytes].
uint64_t built_bytes(const CompiledScene& scene) {
  const auto device = std::make_shared<BuildDevice>();
  uint64_t bytes = 0;
  for (const GeometryCell& cell : scene.cells) bytes += BuiltCell(device, cell).bytes();
  return bytes;
}

void print_row(const std::shared_ptr<const CompiledScene>& scene, size_t fibers, const Plan& plan,
               size_t budget) {
  NodesOptions options;
  options.nodes = nodes;
  options.fibers = fibers;
  options.portion = 1;  // so that two open batches are work for 4096 fibers
  options.object_bytes = budget;
  options.profile_share = plan.profile_share;
  options.pinned_share = plan.pinned_share;
  StopRule stop;
  stop.particles = particles;
  const std::atomic<bool> never{false};
  LocalRun run(scene, 1, 1);
  NodesReport report;
  const double began = wall_seconds();
  const auto ended = run_on_nodes(
      run, options, stop, never, [](const Progress&) {}, &report);
  if (!ended.ok()) throw std::runtime_error(ended.problem().text());
  const double million = static_cast<double>(run.particles()) * 1e-6;
  const WorkerReport& all = report.workers;
  const auto references = static_cast<double>(all.hits + all.misses + all.joined);
  fmt::print("{:>6}  {:<20} {:>9} {:>9.2f} {:>9.2f} {:>12.0f} {:>9.1f} {:>7.1f}\n", fibers,
             plan.name,
             report.residency ? fmt::format("{:.2f}", 100 * report.residency->expected_hit_rate)
                              : std::string("-"),
             100 * all.hit_rate(), 100 * static_cast<double>(all.joined) / references,
             static_cast<double>(all.fetches) / million,
             static_cast<double>(all.fetched_bytes) * 1e-6 / million, wall_seconds() - began);
  std::fflush(stdout);
}

}  // namespace

void print_residency() {
  spdlog::set_level(spdlog::level::err);
  const auto scene = office();
  const uint64_t built = built_bytes(*scene);
  const size_t budget = built / 4;
  fmt::print(
      "\nCells found resident: office floor, smoke_mains, {} cells of {:.1f} MB once built, {} "
      "nodes with\n{:.1f} MB each, {} particles; profile of {:.0f} %\n",
      scene->cells.size(), static_cast<double>(built) * 1e-6, nodes,
      static_cast<double>(budget) * 1e-6, particles, 100 * profile_share);
  fmt::print("{:>6}  {:<20} {:>9} {:>9} {:>9} {:>12} {:>9} {:>7}\n", "fibers", "plan", "expected %",
             "hits %", "joined %", "fetches/Mp", "MB/Mp", "s");
  for (const size_t fibers : {1u, 64u, 1024u, 4096u})
    for (const Plan& plan : plans) print_row(scene, fibers, plan, budget);
}

}  // namespace luxodus::bench
