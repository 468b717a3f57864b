// Whole runs on nodes of this process against the plain loop, and the cost of link delays. Pairs
// alternate in one process. On a shared machine use CPU time and the nodes' idle time, which other
// load does not affect, unlike wall time.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>
#include <stdexcept>

#include "actors/cast/process/in_process.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/tables.hpp"

namespace luxodus::bench {

namespace {

constexpr uint64_t seed = 1;
// of one thread: longer than the interval between two flushes
constexpr double seconds_of_a_run = 8;
const std::atomic<bool> nobody{false};
void ignore(const Progress&) {}

std::shared_ptr<const CompiledScene> office_floor(const char* scenario, int cells,
                                                  int64_t batch_particles) {
  auto read = read_scene(LUX_SOURCE_DIR "/scenes/library/office_floor.toml");
  if (!read.scene) throw std::runtime_error("scenes/library/office_floor.toml cannot be read");
  auto description = std::make_shared<SceneDescription>(*read.scene);
  if (batch_particles > 0) description->run.batch_particles = batch_particles;
  const auto chosen = find_scenario(*description, scenario);
  auto compiled = compile_scene(description, chosen.value(), {cells});
  if (!compiled.ok()) throw std::runtime_error(compiled.problem().text());
  return compiled.value();
}

/// Cost of one run.
struct Taken {
  double particles = 0;
  double wall_s = 0;
  double processor_s = 0;   // of the process
  double controller_s = 0;  // part of it, of the controller's thread
  double idle_s = 0;        // of all workers
  double nodes = 1;
  WorkerReport workers;

  double idle_share() const { return idle_s / (wall_s * nodes); }
  /// The difference to `begun`, the same run ended earlier.
  Taken beyond(const Taken& begun) const {
    return {particles - begun.particles,
            wall_s - begun.wall_s,
            processor_s - begun.processor_s,
            controller_s - begun.controller_s,
            idle_s - begun.idle_s,
            nodes,
            workers};
  }

  double per_second() const { return particles / wall_s; }
  double per_processor_second() const { return particles / processor_s; }
};

StopRule until(int64_t particles) {
  StopRule stop;
  stop.particles = particles;
  return stop;
}

Taken plain_run(const std::shared_ptr<const CompiledScene>& scene, int threads, int64_t particles) {
  LocalRun run(scene, seed, threads);
  const double wall = wall_seconds(), processor = process_seconds();
  run.run(until(particles), nobody, ignore);
  return {static_cast<double>(run.particles()),
          wall_seconds() - wall,
          process_seconds() - processor,
          0,
          0,
          static_cast<double>(threads),
          {}};
}

Taken nodes_run(const std::shared_ptr<const CompiledScene>& scene, const NodesOptions& nodes,
                int64_t particles) {
  LocalRun run(scene, seed, 1);
  NodesReport report;
  const double wall = wall_seconds(), processor = process_seconds(), mine = thread_seconds();
  const auto ended = run_on_nodes(run, nodes, until(particles), nobody, ignore, &report);
  if (!ended.ok()) throw std::runtime_error(ended.problem().text());
  const Taken taken{static_cast<double>(run.particles()),
                    wall_seconds() - wall,
                    process_seconds() - processor,
                    thread_seconds() - mine,
                    1e-9 * static_cast<double>(report.workers.waited),
                    static_cast<double>(nodes.nodes),
                    report.workers};
  return taken;
}

NodesOptions nodes_of(int nodes) {
  NodesOptions options;
  options.nodes = nodes;
  return options;
}

Summary over(const std::vector<Taken>& of, const std::vector<Taken>& to,
             double (Taken::*value)() const) {
  std::vector<double> ratios;
  for (size_t i = 0; i < of.size(); ++i) ratios.push_back((of[i].*value)() / (to[i].*value)());
  return summarise(ratios);
}

template <class Value>
double median(const std::vector<Taken>& of, Value&& value) {
  std::vector<double> values;
  for (const Taken& t : of) values.push_back(value(t));
  return summarise(values).median;
}

/// Estimated ratio of two nodes on two cores of their own to one on one: particles per second of
/// CPU time, less idle time.
Summary two_over_one(const std::vector<Taken>& two, const std::vector<Taken>& one) {
  std::vector<double> ratios;
  for (size_t i = 0; i < two.size(); ++i)
    ratios.push_back(2 * two[i].per_processor_second() * (1 - two[i].idle_share()) /
                     (one[i].per_processor_second() * (1 - one[i].idle_share())));
  return summarise(ratios);
}

void print_row(const char* name, const std::vector<Taken>& rows, const std::vector<Taken>& to) {
  const Summary s = over(rows, to, &Taken::per_processor_second);
  fmt::print("{:<14} {:>9.1f} {:>9.1f} {:>9.3f} {:>7.3f}-{:.3f} {:>7.2f} {:>9.2f}\n", name,
             1e-3 * median(rows, [](const Taken& t) { return t.per_second(); }),
             1e-3 * median(rows, [](const Taken& t) { return t.per_processor_second(); }), s.median,
             s.low, s.high, 100 * median(rows, [](const Taken& t) { return t.idle_share(); }),
             100 * median(rows, [](const Taken& t) { return t.controller_s / t.processor_s; }));
}

}  // namespace

void print_nodes(int repeats) {
  spdlog::set_level(spdlog::level::err);
  const auto scene = office_floor("smoke_emergency", 1, 0);
  const int64_t batch = scene->batch_particles;
  const Taken first = plain_run(scene, 1, batch);
  const auto particles = static_cast<int64_t>(first.per_processor_second() * seconds_of_a_run);
  std::vector<Taken> one_thread, one_node, two_threads, two_nodes, begun;
  for (int i = 0; i < repeats; ++i) {
    const Taken thread = plain_run(scene, 1, batch), node = nodes_run(scene, nodes_of(1), batch);
    const Taken nodes = nodes_run(scene, nodes_of(2), 2 * batch);
    begun.push_back(node.beyond(thread));
    one_thread.push_back(plain_run(scene, 1, particles).beyond(thread));
    one_node.push_back(nodes_run(scene, nodes_of(1), particles).beyond(node));
    two_threads.push_back(
        plain_run(scene, 2, 2 * particles).beyond(plain_run(scene, 2, 2 * batch)));
    two_nodes.push_back(nodes_run(scene, nodes_of(2), 2 * particles).beyond(nodes));
  }
  fmt::print(
      "\nOffice floor, everything resident, {:.1f} M particles a thread or node beyond its first\n"
      "batch; {} rounds\n"
      "{:<14} {:>9} {:>9} {:>9} {:>13} {:>7} {:>9}\n"
      "{:<14} {:>9} {:>9} {:>9} {:>13} {:>7} {:>9}\n",
      1e-6 * static_cast<double>(particles - batch), repeats, "", "wall", "processor", "over the",
      "", "idle", "of it the", "", "[kp/s]", "[kp/s]", "loop", "spread", "[%]", "contr. [%]");
  print_row("plain loop", one_thread, one_thread);
  print_row("one node", one_node, one_thread);
  print_row("two threads", two_threads, one_thread);
  print_row("two nodes", two_nodes, one_thread);
  const Summary wall = over(two_nodes, one_node, &Taken::per_second);
  const Summary threads = over(two_threads, one_thread, &Taken::per_second);
  const Summary own = two_over_one(two_nodes, one_node);
  fmt::print("two nodes over one: {:.2f} ({:.2f}-{:.2f}) by processor time and idleness, ",
             own.median, own.low, own.high);
  fmt::print("{:.2f} ({:.2f}-{:.2f}) by wall time; two threads over one: {:.2f} ({:.2f}-{:.2f})\n",
             wall.median, wall.low, wall.high, threads.median, threads.low, threads.high);
  fmt::print("a run of one batch on a node takes {:.2f} s more of processor, {:.2f} s idle\n",
             median(begun, [](const Taken& t) { return t.processor_s; }),
             median(begun, [](const Taken& t) { return t.idle_s; }));
}

// ---- delay -----------------------------------------------------------------------------------

namespace {

constexpr int delay_cells = 64;
constexpr Nanoseconds delay = milliseconds(1);

/// A batch size that gives every fiber several portions, and the particles for a stable speed.
struct DelayRow {
  size_t fibers;
  int64_t batch_particles;
  int64_t particles;
  int64_t delayed_particles;
};
constexpr DelayRow delay_rows[] = {
    {1, 1024, 65'536, 2'048},
    {16, 1024, 65'536, 16'384},
    {256, 8192, 131'072, 65'536},
    {4096, 32768, 262'144, 262'144},
};

void print_delay_row(const DelayRow& row, int repeats) {
  const auto scene = office_floor("smoke_emergency", delay_cells, row.batch_particles);
  NodesOptions resident = nodes_of(2);
  resident.fibers = row.fibers;
  NodesOptions near = resident;
  near.object_bytes = built_bytes_of(*scene) / 4;
  NodesOptions far = near;
  far.link_delay = delay;
  std::vector<Taken> all, without, with;
  for (int i = 0; i < repeats; ++i) {
    all.push_back(nodes_run(scene, resident, row.particles));
    without.push_back(nodes_run(scene, near, row.particles));
    with.push_back(nodes_run(scene, far, row.delayed_particles));
  }
  const WorkerReport& w = with.back().workers;
  const auto per_kilo = [&](uint64_t n) {
    return 1e3 * static_cast<double>(n) / with.back().particles;
  };
  const auto looked = static_cast<double>(w.hits + w.joined + w.builds);
  fmt::print(
      "{:>6} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.3f} {:>7.3f} {:>7.1f} {:>7.1f} {:>9.1f} {:>9.4f}\n",
      row.fibers, 1e-3 * median(all, [](const Taken& t) { return t.per_second(); }),
      1e-3 * median(without, [](const Taken& t) { return t.per_second(); }),
      1e-3 * median(with, [](const Taken& t) { return t.per_second(); }),
      over(with, without, &Taken::per_second).median, over(with, all, &Taken::per_second).median,
      100 * median(without, [](const Taken& t) { return t.idle_share(); }),
      100 * median(with, [](const Taken& t) { return t.idle_share(); }), per_kilo(w.builds),
      static_cast<double>(w.hits) / looked);
  std::fflush(stdout);
}

}  // namespace

void print_delay(int repeats) {
  spdlog::set_level(spdlog::level::err);
  fmt::print(
      "\nOffice floor in {} cells, two nodes, each with a cache of a quarter of the scene, and\n"
      "1 ms added to every hop; {} rounds\n"
      "{:>6} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9}\n"
      "{:>6} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9}\n",
      delay_cells, repeats, "fibers", "resident", "no delay", "delay", "of no", "of res-", "idle",
      "idle", "builds", "hits", "", "[kp/s]", "[kp/s]", "[kp/s]", "delay", "ident", "near %",
      "far %", "/ 1000 p.", "");
  for (const DelayRow& row : delay_rows) print_delay_row(row, repeats);
}

}  // namespace luxodus::bench
