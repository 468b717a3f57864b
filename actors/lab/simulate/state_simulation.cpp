#include "actors/lab/simulate/state_simulation.hpp"

#include <fmt/format.h>

#include <optional>

#include "actors/cast/node/graph_routes.hpp"
#include "actors/cast/node/state_node.hpp"
#include "actors/lab/simulate/drawn_nodes.hpp"
#include "actors/results/run/run_in_pieces.hpp"
#include "runtime/core/log.hpp"
#include "runtime/core/random.hpp"

namespace luxodus {

SimStates::SimStates(const std::shared_ptr<const CompiledScene>& scene, uint64_t seed,
                     int64_t particles) {
  constexpr uint64_t different = 3;
  for (uint64_t i = 0; i < different; ++i)
    states_.push_back(std::make_unique<SimScene>(scene, seed + i, particles));
}

namespace {

/// In RandomStream::faults, after those of the nodes and the display.
constexpr uint64_t viewer_stream = (uint64_t{1} << 33) + 2;

const std::string no_state = "a state that nobody can make";

/// All states are the same scene, traced with the state's own seed.
class OneScene final : public StateMaker {
 public:
  explicit OneScene(std::shared_ptr<const CompiledScene> scene)
      : state_(std::make_shared<ParticleState>(std::move(scene), BatchNumbers::of_run)) {}
  Result<std::shared_ptr<const TracedState>> make(const std::string& text) override {
    if (text == no_state) return problem("it is refused on purpose");
    return state_;
  }

 private:
  std::shared_ptr<const TracedState> state_;
};

StateObject object_of(const SimScene& state) {
  return {state.seed(), "state"};
}

/// Has states traced: goes from one to the next, drawn from the seed, and finally through all that
/// are not done.
class Viewer {
 public:
  Viewer(const SimStates& states, const SimOptions& options);

  /// Called once in every turn of the coordinator's node.
  void look(StateCoordinator& coordinator, Nanoseconds now);
  /// A work is done, or has ended after stop().
  void work_is_done();
  /// Errors: what differs from the plain loops.
  Result<void> compare() const;

 private:
  bool is_done(size_t state) const { return runs_[state]->traced() == batches_[state]; }
  size_t next_state();
  void begin(StateCoordinator& coordinator, Nanoseconds now);
  void foresee(StateCoordinator& coordinator);

  const SimStates& states_;
  const Nanoseconds ends_after_;  // time at which all faults have ended
  const Nanoseconds looks_for_;   // longest stay in one state before that time
  Random random_;
  std::vector<std::unique_ptr<LocalRun>> runs_;
  std::vector<int64_t> batches_;  // of each state that is done
  size_t state_ = 0;
  std::optional<PiecesOfRun> pieces_;  // the current work
  Nanoseconds leaves_ = never;         // when to leave the current state
};

Viewer::Viewer(const SimStates& states, const SimOptions& options)
    : states_(states),
      ends_after_(options.faults_last + seconds(5)),
      looks_for_(options.faults_last / 4),
      random_(options.seed, RandomStream::faults) {
  random_.start(viewer_stream);
  for (size_t i = 0; i < states.count(); ++i) {
    runs_.push_back(states.of(i).fresh_run(true));
    const int64_t batch = runs_.back()->scene().batch_particles;
    batches_.push_back((states.of(i).particles() + batch - 1) / batch);
  }
}

void Viewer::look(StateCoordinator& coordinator, Nanoseconds now) {
  if (pieces_) {
    if (now < leaves_) return;
    leaves_ = never;
    log_info("viewer=leaves state={} at_ms={}", state_, now / milliseconds(1));
    coordinator.stop();
    return;
  }
  state_ = next_state();
  if (!is_done(state_)) return begin(coordinator, now);
  if (now >= ends_after_) coordinator.end();
}

/// Any state that is not done; the last if all are.
size_t Viewer::next_state() {
  const size_t first = random_.bits() % states_.count();
  for (size_t i = 0; i < states_.count(); ++i)
    if (const size_t state = (first + i) % states_.count(); !is_done(state)) return state;
  return state_;
}

void Viewer::begin(StateCoordinator& coordinator, Nanoseconds now) {
  if (now < ends_after_)
    leaves_ =
        now + static_cast<Nanoseconds>(random_.uniform_double() * static_cast<double>(looks_for_));
  log_info("viewer=enters state={} at_ms={}", state_, now / milliseconds(1));
  foresee(coordinator);
  coordinator.enter(object_of(states_.of(state_)));
  pieces_.emplace(
      *runs_[state_], batches_[state_], [] { return false; }, [](int64_t) {});
  coordinator.begin(*pieces_);
}

/// Sometimes one that is never entered, or that cannot be built.
void Viewer::foresee(StateCoordinator& coordinator) {
  switch (random_.bits() % 4) {
    case 0:
      return coordinator.foresee({1, no_state});
    case 1:
      return coordinator.foresee(object_of(states_.of(random_.bits() % states_.count())));
    default:
      return;
  }
}

void Viewer::work_is_done() {
  log_info("viewer=done state={} traced={}", state_, runs_[state_]->traced());
  pieces_->settle();
  pieces_.reset();
  leaves_ = never;
}

Result<void> Viewer::compare() const {
  for (size_t i = 0; i < states_.count(); ++i) {
    if (!is_done(i)) return problem(fmt::format("state {} is not done", i), ProblemKind::bug);
    if (auto ok = states_.of(i).compare(*runs_[i]); !ok)
      return problem(fmt::format("state {}: {}", i, ok.problem().what), ProblemKind::bug);
  }
  return {};
}

/// The coordinator's node in the simulated world.
class SimStateNode final : public CheckedNode {
 public:
  /// Requires: all references outlive this.
  SimStateNode(const RunSetup& run, const NodeSetup& node, SimWorld& world, Viewer& viewer)
      : node_(run, node, NodeSeams{world.clock(node.net.self), world.transport(node.net.self)},
              [&viewer] { viewer.work_is_done(); }) {
    node_.start([this, &viewer, &clock = world.clock(node.net.self)] {
      viewer.look(node_.coordinator(), clock.now());
    });
  }

  Nanoseconds turn() override { return node_.shell().turn(); }
  bool finished() const override { return node_.shell().finished(); }
  void die() override { end_fibers(node_.shell().scheduler().fibers()); }
  Result<void> check() const override {
    return check_fibers(node_.shell(), node_.shell().scheduler().fibers());
  }
  Result<void> outcome() const override { return {}; }
  const StateCoordinator& coordinator() const { return node_.coordinator(); }

 private:
  StateNode node_;
};

class StateSimulation {
 public:
  StateSimulation(const SimStates& states, const SimOptions& options, PlannedNodes& nodes,
                  StateMaker& maker);
  SimReport run();

 private:
  std::unique_ptr<SimNode> make(NodeId node, uint32_t life);
  void look_at_last();
  void note_left(NodeId node, const CheckedNode& left);
  Result<void> ended_well() const;

  const SimOptions options_;
  RunSetup setup_;
  const SimCosts costs_;
  const BuilderMaker builders_ = builders_on_one_device();
  const FaultPlan faults_;
  DrawnSetups setups_;
  Viewer viewer_;
  SimReport report_;
  std::unique_ptr<SimWorld> world_;
  bool ended_ = false;
  Nanoseconds let_go_ = never;       // when all nodes were released
  Nanoseconds fresh_ = 0;            // how long confirmations counted then
  std::vector<Nanoseconds> begins_;  // start of each node's present life
};

/// The requester of states is on the coordinator's node, which therefore never crashes.
StateSimulation::StateSimulation(const SimStates& states, const SimOptions& options,
                                 PlannedNodes& nodes, StateMaker& maker)
    : options_(options),
      setup_(nodes.setup()),
      costs_(costs_of(options, states.of(0).particles())),
      faults_(faults_of(options, setup_, {nodes.controller().net.self})),
      setups_(nodes, *states.of(0).scene(), options, costs_, faults_),
      viewer_(states, options),
      begins_(setups_.count()) {
  setup_.states = &maker;
  SimSetup world;
  world.nodes = static_cast<uint16_t>(setups_.count());
  world.edges = edges_of(setup_.graph);
  world.plan = faults_;
  world_ = std::make_unique<SimWorld>(world);
}

std::unique_ptr<SimNode> StateSimulation::make(NodeId node, uint32_t life) {
  begins_[node.value] = world_->now();
  const NodeSetup& setup = setups_.of_life(node, life);
  if (node == setups_.controller())
    return std::make_unique<SimStateNode>(setup_, setup, *world_, viewer_);
  return std::make_unique<SimWorker>(setup_, setup,
                                     charged_seams(*world_, node, costs_, builders_, setup.buggify),
                                     world_->clock(node), costs_, report_.caches);
}

/// As for a run: a node that restarts after all were released finds none that could tell it.
void StateSimulation::note_left(NodeId node, const CheckedNode& left) {
  if (let_go_ != never && begins_[node.value] >= let_go_ - fresh_) return;
  if (auto ok = left.outcome(); !ok)
    report_.failure =
        fmt::format("{} has left with \"{}\"", setup_.name_of(node), ok.problem().what);
}

void StateSimulation::look_at_last() {
  const NodeId last = world_->last();
  if (last == no_node) return;
  const SimNode* const here = world_->node(last);
  const auto* node = static_cast<const CheckedNode*>(here != nullptr ? here : world_->departed());
  if (node == nullptr) return;
  if (auto ok = node->check(); !ok)
    report_.failure = fmt::format("{}: {}", setup_.name_of(last), ok.problem().what);
  if (here == nullptr && report_.failure.empty()) note_left(last, *node);
  if (last != setups_.controller()) return;
  const StateCoordinator& coordinator = static_cast<const SimStateNode*>(node)->coordinator();
  const Coordinator::Counters& c = coordinator.counters();
  report_.leases = c.leases;
  report_.leases_fenced = c.fenced;
  report_.flushes_refused = c.flushes_refused;
  ended_ = ended_ || coordinator.ended();
  if (!coordinator.ended() || let_go_ != never) return;
  let_go_ = world_->now();
  fresh_ = coordinator.word_is_fresh();
}

SimReport StateSimulation::run() {
  world_->start([this](NodeId node, uint32_t life) { return make(node, life); });
  const Nanoseconds end = 3 * options_.work + options_.faults_last + options_.patience;
  while (report_.failure.empty() && world_->step()) {
    look_at_last();
    if (world_->now() > end)
      report_.failure =
          fmt::format("it has not ended {} s after all was healed", options_.patience / seconds(1));
  }
  if (report_.failure.empty())
    if (auto ok = ended_well(); !ok) report_.failure = ok.problem().what;
  report_.virtual_time = world_->now();
  report_.trace_hash = world_->trace_hash();
  report_.world = world_->counters();
  world_.reset();  // its nodes add their statistics
  report_.rare_ways = setups_.rare_ways_taken();
  return std::move(report_);
}

Result<void> StateSimulation::ended_well() const {
  if (!ended_)
    return problem("nobody has anything to do, and not all states are traced", ProblemKind::bug);
  return viewer_.compare();
}

}  // namespace

Result<SimReport> simulate_states(const SimStates& states, const SimOptions& options) {
  const SimScene& first = states.of(0);
  NodesOptions wanted = drawn_nodes(*first.scene(), options);
  wanted.object_bytes = 0;  // all hold the whole scene, and one coordinator leads all
  wanted.tally_shards = 1;
  wanted.fan_out = static_cast<uint32_t>(std::max(options.nodes, 2));
  const std::unique_ptr<LocalRun> run = first.fresh_run(true);
  auto nodes = PlannedNodes::make(*run, wanted, {}, options.seed | 1);
  if (!nodes) return nodes.problem();
  OneScene maker(first.scene());
  StateSimulation simulation(states, options, *nodes.value(), maker);
  SimReport report = simulation.run();
  report.nodes = fmt::format("{} nodes", wanted.nodes);
  return report;
}

}  // namespace luxodus
