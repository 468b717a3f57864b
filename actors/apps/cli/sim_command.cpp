// luxodus sim: runs on simulated nodes with faults, from seeds.
#include <spdlog/spdlog.h>

#include <charconv>
#include <chrono>
#include <functional>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/cast/process/planned_nodes.hpp"
#include "actors/lab/simulate/state_simulation.hpp"
#include "runtime/config/cluster_file.hpp"
#include "runtime/core/clock.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::cli {

namespace {

struct SimCommandOptions {
  std::string scene, scenario, seeds;
  uint64_t seed = 0;
  int nodes = 4;
  int links = 4;
  uint32_t fan_out = 0;
  int cells = 16;
  std::string particles = "4k";
  int batches = 40;
  std::string faults = "swarm";
  std::string faults_last = "30s";
  std::string work = "60s";
  bool states = false;
  bool twice = false;
  bool log = false;
};

/// A number of seeds from the first on; the last may be the largest representable number.
struct SeedRange {
  uint64_t first = 0, count = 1;
};

/// "0..200", or one number.
Result<SeedRange> parse_seeds(const SimCommandOptions& options) {
  if (options.seeds.empty()) return SeedRange{options.seed, 1};
  const std::string& text = options.seeds;
  SeedRange range;
  uint64_t after = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  const bool dots =
      first.ec == std::errc() && end - first.ptr > 2 && first.ptr[0] == '.' && first.ptr[1] == '.';
  const auto last = dots ? std::from_chars(first.ptr + 2, end, after) : first;
  if (!dots || last.ec != std::errc() || last.ptr != end || after <= range.first)
    return problem("--seeds \"" + text + "\" is no range: write 0..200, the last not included");
  range.count = after - range.first;
  return range;
}

Result<Nanoseconds> span_of(const std::string& text) {
  auto span_s = parse_seconds(text);
  if (!span_s) return span_s.problem();
  return static_cast<Nanoseconds>(span_s.value() * 1e9);
}

/// The fault plan of a file, for nodes n0, n1, ... and controller.
Result<FaultPlan> fault_plan_in(const SimCommandOptions& options) {
  std::vector<std::string> names;
  for (int i = 0; i < options.nodes; ++i) names.push_back("n" + std::to_string(i));
  names.push_back("controller");
  ReadFaults read = read_fault_file(options.faults, names);
  for (const Problem& problem : read.problems.list()) tell(problem);
  if (!read.plan)
    return problem_in(options.faults, "the faults have problems, told above", read.problems.kind());
  return std::move(*read.plan);
}

Result<SimOptions> sim_options(const SimCommandOptions& options) {
  SimOptions sim;
  sim.nodes = options.nodes;
  sim.links = options.links;
  auto graph = graph_of_process(sim.nodes, sim.links);  // made once, for all seeds
  if (!graph) return graph.problem();
  sim.fixed.graph = std::move(graph).value();
  sim.fan_out = options.fan_out;
  // Leases of each level last four times as long as those of the next.
  if (sim.fan_out > 0 ||
      usual_fan_out(static_cast<uint32_t>(sim.nodes)) < static_cast<uint32_t>(sim.nodes))
    sim.patience *= 4;
  sim.faults = options.faults == "swarm";
  if (!sim.faults && options.faults != "none") {
    auto plan = fault_plan_in(options);
    if (!plan) return plan.problem();
    sim.plan = std::move(plan).value();
  }
  const auto last = span_of(options.faults_last);
  if (!last) return last.problem();
  const auto work = span_of(options.work);
  if (!work) return work.problem();
  sim.faults_last = last.value();
  sim.work = work.value();
  return sim;
}

/// The scene with many small batches.
struct SimulatedScene {
  std::shared_ptr<const CompiledScene> scene;
  uint64_t seed = 0;
  int64_t particles = 0;
};
Result<SimulatedScene> sim_scene(const SimCommandOptions& options) {
  const auto particles = parse_count(options.particles);
  if (!particles) return particles.problem();
  const auto [loaded, told] = load_scene(options.scene);
  if (!loaded) return problem_in(options.scene, "the scene has problems, told above", told);
  const auto description = std::make_shared<SceneDescription>(*loaded);
  description->run.batch_particles = std::max<int64_t>(1, particles.value() / options.batches);
  const auto scenario = find_scenario(*description, options.scenario);
  if (!scenario) return scenario.problem();
  auto scene = compile_scene(description, scenario.value(), {options.cells});
  if (!scene) return scene.problem();
  return SimulatedScene{scene.value(), description->run.seed, particles.value()};
}

/// The command that repeats this run.
std::string command_of(const SimCommandOptions& options, uint64_t seed) {
  std::string text = "luxodus sim " + options.scene + " --seed " + std::to_string(seed);
  const auto add = [&](const char* option, const std::string& value, const std::string& usual) {
    if (value != usual) text += std::string(" ") + option + " " + value;
  };
  const SimCommandOptions usual;
  add("--scenario", options.scenario, usual.scenario);
  add("--nodes", std::to_string(options.nodes), std::to_string(usual.nodes));
  add("--links", std::to_string(options.links), std::to_string(usual.links));
  add("--fan-out", std::to_string(options.fan_out), std::to_string(usual.fan_out));
  add("--cells", std::to_string(options.cells), std::to_string(usual.cells));
  add("--particles", options.particles, usual.particles);
  add("--batches", std::to_string(options.batches), std::to_string(usual.batches));
  add("--faults", options.faults, usual.faults);
  add("--faults-last", options.faults_last, usual.faults_last);
  add("--work", options.work, usual.work);
  if (options.states) text += " --states";
  return text;
}

void print_run(uint64_t seed, const SimReport& report) {
  const SimWorld::Counters& w = report.world;
  std::printf(
      "seed %llu: %s\n", static_cast<unsigned long long>(seed),
      report.failure.empty() ? "ends as the plain loop, bit for bit" : report.failure.c_str());
  std::printf("  nodes    %s\n", report.nodes.c_str());
  std::printf("  time     %.3f s virtual, %llu events, trace %016llx\n",
              static_cast<double>(report.virtual_time) * 1e-9,
              static_cast<unsigned long long>(w.events),
              static_cast<unsigned long long>(report.trace_hash));
  std::printf(
      "  frames   %llu, of these lost %llu, doubled %llu, overtaken %llu, harmed %llu, late by "
      "seconds %llu\n",
      static_cast<unsigned long long>(w.frames), static_cast<unsigned long long>(w.lost),
      static_cast<unsigned long long>(w.duplicated), static_cast<unsigned long long>(w.reordered),
      static_cast<unsigned long long>(w.corrupted), static_cast<unsigned long long>(w.ghosts));
  std::printf("  faults   %llu, of these crashes %llu; rare ways taken on purpose %llu\n",
              static_cast<unsigned long long>(w.faults), static_cast<unsigned long long>(w.crashes),
              static_cast<unsigned long long>(report.rare_ways));
  std::printf(
      "  leases   %llu, fenced %llu; flushes refused %llu; batches back from journals %lld\n",
      static_cast<unsigned long long>(report.leases),
      static_cast<unsigned long long>(report.leases_fenced),
      static_cast<unsigned long long>(report.flushes_refused),
      static_cast<long long>(report.recovered));
  std::printf("  fetches  %llu, builds %llu\n",
              static_cast<unsigned long long>(report.caches.fetches),
              static_cast<unsigned long long>(report.caches.builds));
}

using Simulator = std::function<Result<SimReport>(const SimOptions&)>;

/// Simulates a run, or states of a scene that changes.
Simulator simulator_of(const SimulatedScene& of, bool states) {
  if (states) {
    const auto all = std::make_shared<SimStates>(of.scene, of.seed, of.particles);
    return [all](const SimOptions& options) { return simulate_states(*all, options); };
  }
  const auto run = std::make_shared<SimScene>(of.scene, of.seed, of.particles);
  return [run](const SimOptions& options) { return simulate(*run, options); };
}

/// Errors: as simulate; with `twice`, a second run with another result.
Result<SimReport> simulated(const Simulator& simulator, const SimOptions& options, bool twice) {
  auto report = simulator(options);
  if (!report || !twice || !report->failure.empty()) return report;
  const auto again = simulator(options);
  if (again && again->trace_hash != report->trace_hash)
    report->failure =
        "a second run of this seed takes another course: something beside the seed decides";
  return report;
}

Result<ExitCode> simulate_seeds(const SimCommandOptions& options) {
  const auto seeds = parse_seeds(options);
  if (!seeds) return seeds.problem();
  auto sim = sim_options(options);
  if (!sim) return sim.problem();
  const auto scene = sim_scene(options);
  if (!scene) return scene.problem();
  const Simulator simulator = simulator_of(scene.value(), options.states);
  install_interrupt_handler();
  if (!options.log) spdlog::set_level(spdlog::level::off);
  const SystemClock clock;
  const Nanoseconds began = clock.now();
  const bool single = seeds->count == 1;
  ProgressLine line("simulate");
  uint64_t done = 0, failed = 0, events = 0;
  double virtual_s = 0;
  for (; done < seeds->count && !interrupt_flag(); ++done) {
    const uint64_t seed = sim->seed = seeds->first + done;
    const auto report = simulated(simulator, sim.value(), options.twice);
    if (!report) return report.problem();
    events += report->world.events;
    virtual_s += static_cast<double>(report->virtual_time) * 1e-9;
    if (single || !report->failure.empty()) print_run(seed, report.value());
    if (!report->failure.empty()) {
      ++failed;
      std::printf("  again    %s\n", command_of(options, seed).c_str());
    }
    if (!single) line.show_share(static_cast<double>(done + 1) / static_cast<double>(seeds->count));
  }
  const double passed = static_cast<double>(clock.now() - began) * 1e-9;
  std::printf(
      "%llu seeds, %llu failed; %s events in %.1f s: %s events/s, %.0f virtual seconds a second\n",
      static_cast<unsigned long long>(done), static_cast<unsigned long long>(failed),
      short_number(static_cast<double>(events)).c_str(), passed,
      short_number(static_cast<double>(events) / passed).c_str(), virtual_s / passed);
  if (interrupt_flag()) return ExitCode::interrupted;
  return failed == 0 ? ExitCode::success : ExitCode::failure;
}

}  // namespace

Command sim_command() {
  const auto o = std::make_shared<SimCommandOptions>();
  return {
      .name = "sim",
      .summary = "Run a scene on simulated nodes, under faults drawn from a seed",
      .heading = "Study",
      .options =
          {{"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
           {"--scenario",
            &o->scenario,
            "Name of a scenario",
            {.form = Form::name, .otherwise = "the first"}},
           {"--seed", &o->seed, "Seed of faults and nodes"},
           {"--seeds", &o->seeds, "Range of seeds, as 0..200; the last is not included"},
           {"--nodes", &o->nodes, "Number of workers", {.range = Range{1, 1023}}},
           {"--links", &o->links, "Largest number of links of a node", {.range = Range{1, 16}}},
           {"--fan-out",
            &o->fan_out,
            "Number of nodes that a coordinator leads at most; 0: all below 64 nodes, else their "
            "square root",
            {.range = Range{0, 1023}}},
           {"--cells", &o->cells, "Number of geometry cells", {.range = Range{1, 100000}}},
           {"--particles", &o->particles, "Number of particles", {.form = Form::count}},
           {"--batches",
            &o->batches,
            "Number of batches of these particles",
            {.range = Range{1, 1000000}}},
           {"--faults",
            &o->faults,
            "Faults: swarm (drawn from the seed), none, or a TOML file with a table [faults]",
            {.form = Form::file}},
           {"--faults-last",
            &o->faults_last,
            "Virtual time until all faults have ended",
            {.form = Form::duration}},
           {"--work",
            &o->work,
            "Virtual time that one worker alone would trace for",
            {.form = Form::duration}},
           {"--states", &o->states,
            "States of a scene that changes, in place of a run: they are traced, left and traced "
            "on"},
           {"--twice", &o->twice, "Two runs of each seed, which must be the same"},
           {"--log", &o->log, "Log of the nodes"}},
      .notes =
          "All nodes run their real code in one thread, by virtual time, over links that delay, "
          "lose, duplicate, reorder and corrupt frames, between nodes that crash, pause and start "
          "again. Invariants are checked after every event; in the end the result must be the "
          "plain loop's, bit for bit. Equal seeds give equal runs. A seed that fails prints the "
          "command that repeats it.\n"
          "  luxodus sim scenes/library/empty_room.toml --seed 7\n"
          "  luxodus sim scenes/library/empty_room.toml --seeds 0..10000",
      .run = [o] { return exit_code_of(simulate_seeds(*o)); }};
}

}  // namespace luxodus::cli
