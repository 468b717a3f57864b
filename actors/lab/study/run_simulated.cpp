// A run in a simulated world. Unlike actors/lab/simulate/simulation.hpp, which searches for bugs
// under swarms of faults, this measures on a quiet network, and everything that takes time on a
// real node is charged here.
#include <fmt/format.h>

#include "actors/cast/node/graph_routes.hpp"
#include "actors/lab/simulate/recording.hpp"
#include "actors/lab/simulate/sim_nodes.hpp"
#include "actors/lab/study/runs.hpp"

namespace luxodus {

namespace {

/// Virtual time after which a run is taken to be stuck.
constexpr Nanoseconds longest_run = seconds(100'000);
/// Interval of checks for an interrupt [events].
constexpr uint64_t look_every = 4096;
/// Memory maps for stack guards of all fibers: half of what a process has.
constexpr size_t maps_of_all_nodes = 32'768;

/// Mean number of links between two workers.
double mean_path(const RunSetup& setup) {
  const auto workers = static_cast<double>(setup.graph.workers());
  double hops = 0;
  for (Vertex a = 0; a < setup.graph.workers(); ++a)
    for (Vertex b = 0; b < setup.graph.workers(); ++b)
      if (a != b) hops += setup.routes->hops(a, b);
  return workers > 1 ? hops / (workers * (workers - 1)) : 0;
}

class SimulatedRun {
 public:
  SimulatedRun(const StudyRun& run, const NodesOptions& options, PlannedNodes& nodes,
               const StopRule& stop)
      : run_(run),
        options_(options),
        setup_(nodes.setup()),
        stop_(stop),
        setups_(nodes.workers()),
        built_(setup_.objects == nullptr ? 0 : setup_.objects->places().size()) {
    setups_.push_back(nodes.controller());
    for (NodeSetup& node : setups_) settle_in(node);
    world_ = std::make_unique<SimWorld>(world_setup());
  }

  Result<StudyResult> go(const std::atomic<bool>& interrupt);

 private:
  void settle_in(NodeSetup& node);
  SimSetup world_setup() const;
  std::unique_ptr<SimNode> make(NodeId node, uint32_t life);
  NodeSeams seams(NodeId node);
  NodeId controller() const { return {static_cast<uint16_t>(setups_.size() - 1)}; }
  void look_at_controller();
  void note_world();

  const StudyRun& run_;
  const NodesOptions& options_;
  const RunSetup& setup_;
  const StopRule stop_;
  std::vector<NodeSetup> setups_;  // the controller's is the last
  BuiltOnce built_;
  std::unique_ptr<LocalRun> local_;
  StudyResult result_;
  std::unique_ptr<SimWorld> world_;
  std::optional<StopReason> reason_;
};

void SimulatedRun::settle_in(NodeSetup& node) {
  node.start = node.lost = longest_run;
  node.stall = seconds(3600);
  // However long a particle takes, messages of others must pass through the node meanwhile.
  const Nanoseconds particle = std::max<Nanoseconds>(whole_ns(run_.costs.particle_ns), 1);
  node.photons.portion = std::clamp<int64_t>(milliseconds(1) / particle, 1, node.photons.portion);
  node.fibers.max_maps = std::max<size_t>(2, maps_of_all_nodes / setups_.size());
  node.faults = {};  // the world's links inject them
}

SimSetup SimulatedRun::world_setup() const {
  const SimCosts& costs = run_.costs;
  SimSetup world;
  world.nodes = static_cast<uint16_t>(setups_.size());
  world.edges = edges_of(setup_.graph);
  world.plan.seed = run_.seed;
  world.plan.links.delay = options_.link_delay;
  world.plan.links.jitter = run_.study.jitter;
  world.plan.links.bytes_per_second = options_.link_bytes_per_second;
  world.turn_cost = whole_ns(costs.turn_ns);
  world.frame_cost = whole_ns(costs.receive_ns);
  world.send_cost = whole_ns(costs.send_ns);
  world.byte_cost_ns = costs.frame_byte_ns;
  world.wake_cost = whole_ns(costs.wake_ns);
  world.rest_cost = whole_ns(costs.rest_ns);
  world.cores = run_.study.cores;
  if (world.cores > 0) world.hosts.assign(world.nodes, 0);
  if (const double at_s = run_.study.number(run_.point, "crash_s"); at_s > 0) {
    Fault crash;
    crash.kind = Fault::Kind::crash;
    crash.at = static_cast<Nanoseconds>(1e9 * at_s);
    crash.lasts = run_.study.crash_for;
    world.plan.faults.push_back(crash);
  }
  return world;
}

std::unique_ptr<SimNode> SimulatedRun::make(NodeId node, uint32_t life) {
  NodeSetup& setup = setups_[node.value];
  setup.net.incarnation = {(run_.seed + 1) * 0x10000 + node.value + uint64_t{life} * 0x100000000};
  if (node == controller()) {
    local_ = std::make_unique<LocalRun>(run_.scene, run_.seed, 1, nullptr);
    return std::make_unique<SimController>(setup_, setup, *local_, stop_, *world_, run_.costs,
                                           nullptr);
  }
  return std::make_unique<SimWorker>(setup_, setup, seams(node), world_->clock(node), run_.costs,
                                     result_.workers);
}

NodeSeams SimulatedRun::seams(NodeId node) {
  SimClock& clock = world_->clock(node);
  NodeSeams seams = charged_seams(*world_, node, run_.costs, built_.builders());
  if (run_.recording != nullptr)
    seams.make_tracer = replaying_tracers(*run_.recording, clock, run_.costs);
  return seams;
}

void SimulatedRun::look_at_controller() {
  const auto* node = static_cast<const SimController*>(world_->node(controller()));
  if (node == nullptr || node->coordinator().took() == 0) return;
  const RunCoordinator& ended = node->coordinator();
  reason_ = ended.reason();
  result_.seconds = 1e-9 * static_cast<double>(ended.took());
  result_.leases = static_cast<double>(ended.counters().leases);
  result_.fenced = static_cast<double>(ended.counters().fenced);
  result_.flush_bytes = static_cast<double>(ended.counters().flush_bytes);
  result_.longest_turn_s = 1e-9 * static_cast<double>(node->longest_turn());
}

void SimulatedRun::note_world() {
  for (const NodeSetup& node : setups_) {
    const SimClock& clock = world_->clock(node.net.self);
    const double busy_s = 1e-9 * static_cast<double>(clock.busy());
    const bool leads = node.net.self == controller();
    (leads ? result_.controller_s : result_.busy_s) += busy_s;
    if (!leads) {
      const auto of = [&](Spent what) { return 1e-9 * static_cast<double>(clock.busy(what)); };
      result_.tracing_s += of(Spent::tracing);
      result_.building_s += of(Spent::building);
      result_.frames_s += of(Spent::frames);
      result_.resting_s += of(Spent::resting);
    }
    if (leads || setup_.coordinates(node.net.self))
      result_.busiest_s = std::max(result_.busiest_s, busy_s);
  }
  result_.particles = static_cast<double>(local_->totals().balance().particles);
  result_.nodes = options_.nodes;
  result_.flux_hash = flux_hash_of(local_->totals());
  result_.frames = static_cast<double>(world_->counters().frames);
  result_.link_bytes = static_cast<double>(world_->counters().bytes);
  if (run_.recording != nullptr) {
    std::vector<NodeId> holders;
    for (const ObjectPlace& place : setup_.objects->places())
      holders.push_back(place.holders.front());
    result_.moves = run_.recording->moves_per_particle(holders) * result_.particles;
    result_.mean_path = mean_path(setup_);
  }
}

Result<StudyResult> SimulatedRun::go(const std::atomic<bool>& interrupt) {
  world_->start([this](NodeId node, uint32_t life) { return make(node, life); });
  // Nothing is measured after the last count; the release of a thousand nodes would take as long
  // again.
  while (!reason_ && world_->step()) {
    if (world_->last() == controller()) look_at_controller();
    if (world_->now() > longest_run) return problem("a simulated run does not end");
    if (world_->counters().events % look_every == 0 && interrupt.load())
      return problem("interrupted");
  }
  if (!reason_) return problem("nobody has anything to do, and the run has not ended");
  if (*reason_ != StopReason::particles)
    return problem(fmt::format("the run ended by {}, not by its particles", name_of(*reason_)));
  note_world();
  world_.reset();  // its workers add their statistics
  return result_;
}

}  // namespace

Result<StudyResult> run_simulated(const StudyRun& run, const std::atomic<bool>& interrupt) {
  auto options = nodes_of(run);
  if (!options) return options.problem();
  if (run.recording != nullptr && (options->object_bytes == 0 || options->prefetch > 0))
    return problem(
        "a replay needs a cache, and knows nothing of what a ray enters next: take "
        "cache > 0 and prefetch = 0");
  const bool resident = options->object_bytes == 0;
  const LocalRun planned =
      resident ? LocalRun(run.scene, run.seed, 1) : LocalRun(run.scene, run.seed, 1, nullptr);
  StopRule stop;
  stop.particles = particles_of(run.study, run.point);
  auto nodes = PlannedNodes::make(planned, options.value(), stop, run.seed | 1);
  if (!nodes) return nodes.problem();
  return SimulatedRun(run, options.value(), *nodes.value(), stop).go(interrupt);
}

}  // namespace luxodus
