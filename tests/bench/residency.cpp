#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>
#include <span>
#include <stdexcept>

#include "actors/cast/parts/scene_objects.hpp"
#include "actors/cast/process/in_process.hpp"
#include "scenes/formats/pack/scene_pack.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int nodes = 2;
constexpr double profile_share = 0.1;  // for so short a run; 1 % of a long run is more

struct Plan {
  const char* name;
  double profile_share;
  double pinned_share;
};
constexpr Plan plans[] = {
    {"none", 0, 0}, {"holders and leases", profile_share, 0}, {"and pins", profile_share, 0.5}};

/// Work of a row. A single fiber waits for every missing part: it gets few particles.
struct Size {
  size_t fibers;
  int64_t batch_particles;
  int64_t particles;
};
constexpr Size of_the_office[] = {
    {1, 2048, 32'768}, {64, 2048, 32'768}, {1024, 2048, 32'768}, {4096, 2048, 32'768}};
constexpr Size of_a_pack[] = {
    {1, 128, 512}, {64, 512, 2048}, {1024, 2048, 8192}, {4096, 8192, 32'768}};

using Scene = std::shared_ptr<const CompiledScene>;

Scene compiled(SceneDescription description, const char* scenario, int cells,
               int64_t batch_particles) {
  description.run.batch_particles = batch_particles;
  const auto shared = std::make_shared<SceneDescription>(std::move(description));
  auto scene = compile_scene(shared, find_scenario(*shared, scenario).value(), {cells});
  if (!scene.ok()) throw std::runtime_error(scene.problem().text());
  return std::move(scene).value();
}

Scene office(int64_t batch_particles) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/office_floor.toml");
  if (!read.scene) throw std::runtime_error(read.problems.list().front().text());
  return compiled(std::move(*read.scene), "smoke_mains", 256, batch_particles);
}

Scene packed(const std::string& file, int64_t batch_particles) {
  auto read = read_pack(file);
  if (!read.ok()) throw std::runtime_error(read.problem().text());
  return compiled(*read.value(), "", 1, batch_particles);
}

void print_row(const Scene& scene, const Size& size, const Plan& plan, size_t budget) {
  NodesOptions options;
  options.nodes = nodes;
  options.fibers = size.fibers;
  options.sharing = false;
  options.portion = 1;  // so that two open batches are enough work for 4096 fibers
  options.object_bytes = budget;
  options.profile_share = plan.profile_share;
  options.pinned_share = plan.pinned_share;
  StopRule stop;
  stop.particles = size.particles;
  const std::atomic<bool> never{false};
  LocalRun run(scene, 1, 1, nullptr);  // no node holds all of it
  NodesReport report;
  const double began = wall_seconds();
  const auto ended = run_on_nodes(
      run, options, stop, never, [](const Progress&) {}, &report);
  if (!ended.ok()) throw std::runtime_error(ended.problem().text());
  const double million = static_cast<double>(run.particles()) * 1e-6;
  const WorkerReport& all = report.workers;
  const auto references = static_cast<double>(all.hits + all.misses + all.joined);
  fmt::print("{:>6}  {:<20} {:>9} {:>9.2f} {:>9.2f} {:>12.0f} {:>9.1f} {:>8.2f} {:>7.1f}\n",
             size.fibers, plan.name,
             report.residency ? fmt::format("{:.2f}", 100 * report.residency->expected_hit_rate)
                              : std::string("-"),
             100 * all.hit_rate(), 100 * static_cast<double>(all.joined) / references,
             static_cast<double>(all.fetches) / million,
             static_cast<double>(all.fetched_bytes) * 1e-6 / million,
             static_cast<double>(all.builds) * 1e-6 / million, wall_seconds() - began);
  std::fflush(stdout);
}

template <class Make>
void print_rows(const char* of, std::span<const Size> sizes, size_t share, const Make& make) {
  const Scene first = make(sizes.front().batch_particles);
  const uint64_t built = built_bytes_of(*first);
  const size_t budget = built / share;
  fmt::print(
      "\nParts found resident: {}, {} triangles in {} cells, {:.0f} MB once built; {} nodes with "
      "{:.0f} MB each, which build\ntheir own; profile of {:.0f} %\n",
      of, first->triangles, first->cell_boxes.size(), static_cast<double>(built) * 1e-6, nodes,
      static_cast<double>(budget) * 1e-6, 100 * profile_share);
  fmt::print("{:>6}  {:<20} {:>9} {:>9} {:>9} {:>12} {:>9} {:>8} {:>7}\n", "fibers", "plan",
             "expected %", "hits %", "joined %", "fetches/Mp", "MB/Mp", "builds/p", "s");
  for (const Size& size : sizes) {
    const Scene scene = make(size.batch_particles);
    for (const Plan& plan : plans) print_row(scene, size, plan, budget);
  }
}

}  // namespace

void print_residency(const std::string& pack) {
  spdlog::set_level(spdlog::level::err);
  if (pack.empty()) return print_rows("office floor, smoke_mains", of_the_office, 4, office);
  print_rows(pack.c_str(), of_a_pack, 10, [&](int64_t batch) { return packed(pack, batch); });
}

}  // namespace luxodus::bench
