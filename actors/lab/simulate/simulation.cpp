#include "actors/lab/simulate/simulation.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <optional>

#include "actors/cast/display/run_output.hpp"
#include "actors/cast/journal/snapshot_journal.hpp"
#include "actors/cast/node/graph_routes.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/check.hpp"
#include "runtime/core/random.hpp"
#include "runtime/storage/faulty_store.hpp"
#include "runtime/storage/memory_store.hpp"

namespace luxodus {

// ---- the scene ---------------------------------------------------------------------------------

SimScene::SimScene(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int64_t particles)
    : scene_(std::move(scene)), seed_(seed), particles_(particles), reference_(fresh_run(true)) {
  StopRule stop;
  stop.particles = particles;
  reference_->run(stop, std::atomic<bool>{false}, [](const Progress&) {});
}

std::unique_ptr<LocalRun> SimScene::fresh_run(bool resident) const {
  if (resident) return std::make_unique<LocalRun>(scene_, seed_, 1);
  return std::make_unique<LocalRun>(scene_, seed_, 1, nullptr);
}

Result<void> SimScene::compare(const LocalRun& run) const {
  const Totals &ours = run.totals(), &theirs = reference_->totals();
  for (int g = 0; g < theirs.groups(); ++g) {
    if (ours.batches(g) != theirs.batches(g))
      return problem(fmt::format("source group {} has {} batches, the plain loop {}", g,
                                 ours.batches(g), theirs.batches(g)),
                     ProblemKind::bug);
    const auto &a = ours.state(g).totals, &b = theirs.state(g).totals;
    if (std::memcmp(a.data(), b.data(), b.size() * sizeof(Total)) != 0)
      return problem(fmt::format("totals of source group {} differ from the plain loop's", g),
                     ProblemKind::bug);
  }
  if (std::memcmp(&ours.balance(), &theirs.balance(), sizeof(EnergyBalance)) != 0)
    return problem("the ledger differs from the plain loop's", ProblemKind::bug);
  return {};
}

namespace {

/// A display's disk, which outlives the display. It asks for the run's totals now and then.
class SimDisplay final : public RunOutput {
 public:
  explicit SimDisplay(const SimScene& scene) : scene_(scene) {}
  std::unique_ptr<LocalRun> fresh_run() override { return scene_.fresh_run(false); }
  uint64_t picture_bytes() const override { return 0; }
  bool wants_show() override { return ++looks_ % 8 == 0; }
  void show(const LocalRun& run) override { whole_ = whole_ && run.totals().balance().closes(); }
  Result<void> keep_flux(const LocalRun& run, StopReason) override {
    flux_ = flux_of(run);
    return {};
  }
  Result<void> write_results(const LocalRun&, StopReason) override { return {}; }

  /// Errors: what it has is not the flux of the plain loop.
  Result<void> check() const {
    if (!whole_) return problem("the display was shown a part of a flush", ProblemKind::bug);
    if (!flux_) return problem("the display has not kept the flux", ProblemKind::bug);
    const auto kept = scene_.fresh_run(false);
    if (auto ok = take_flux(*flux_, {}, *kept); !ok) return ok.problem();
    if (auto ok = scene_.compare(*kept); !ok)
      return problem("what the display has kept: " + ok.problem().what, ProblemKind::bug);
    return {};
  }

 private:
  const SimScene& scene_;
  uint64_t looks_ = 0;
  bool whole_ = true;
  std::optional<FluxFile> flux_;
};

/// In RandomStream::faults, after those of drawn_nodes.cpp.
constexpr uint64_t journal_stream = uint64_t{1} << 33;
constexpr uint64_t display_stream = journal_stream + 1;

/// At any node; at the controller's if nodes are not drawn.
NodeId drawn_display(const SimOptions& options) {
  const auto nodes = static_cast<uint16_t>(options.nodes);
  if (!options.draw_nodes) return options.fixed.display_node.value_or(NodeId{nodes});
  Random random(options.seed, RandomStream::faults);
  random.start(display_stream);
  return {static_cast<uint16_t>(random.bits() % (nodes + 1u))};
}

// ---- a run ------------------------------------------------------------------------------------

class Simulation {
 public:
  static Result<SimReport> run(const SimScene& scene, const SimOptions& options);

 private:
  Simulation(const SimScene& scene, const SimOptions& options, PlannedNodes& nodes,
             const SimDisplay& display);
  std::vector<NodeId> spared() const;
  std::unique_ptr<SimNode> make(NodeId node, uint32_t life);
  void begin_controller(uint32_t life);
  SnapshotJournal::Config drawn_journal() const;
  void go();
  Result<void> ended_well() const;
  NodeId controller() const { return setups_.controller(); }
  void note_last(const SimController& controller);
  Nanoseconds longest_word_below();
  void note_left(NodeId node, const CheckedNode& left);
  bool sharded() const { return !setup_.shards.owners.empty(); }

  const SimScene& scene_;
  const SimOptions options_;
  const SimDisplay& display_;
  std::unique_ptr<LocalRun> run_;  // of the controller's present life
  std::vector<std::byte> disk_;    // the controller's disk: its journal,
  // and the snapshot, for which there is space, as on a real one
  std::optional<FluxFile> snapshot_;
  std::unique_ptr<SnapshotJournal> journal_;
  const RunSetup& setup_;
  const SimCosts costs_;
  const BuilderMaker builders_ = builders_on_one_device();
  const FaultPlan faults_;
  DrawnSetups setups_;
  StopRule stop_;
  SimReport report_;
  std::unique_ptr<SimWorld> world_;
  std::optional<StopReason> reason_;
  Nanoseconds let_go_ = never;       // when the controller released all nodes
  Nanoseconds fresh_ = 0;            // how long confirmations counted then
  std::vector<Nanoseconds> begins_;  // start of each node's present life
};

Simulation::Simulation(const SimScene& scene, const SimOptions& options, PlannedNodes& nodes,
                       const SimDisplay& display)
    : scene_(scene),
      options_(options),
      display_(display),
      setup_(nodes.setup()),
      costs_(costs_of(options, scene.particles())),
      faults_(faults_of(options, setup_, spared())),
      setups_(nodes, *scene.scene(), options, costs_, faults_),
      begins_(setups_.count()) {
  stop_.particles = scene.particles();
  SimSetup world;
  world.nodes = static_cast<uint16_t>(setups_.count());
  world.edges = edges_of(setup_.graph);
  world.plan = faults_;
  world_ = std::make_unique<SimWorld>(world);
}

/// A shard of the totals does not survive its node, nor a sharded run its controller.
std::vector<NodeId> Simulation::spared() const {
  if (!sharded()) return {};
  std::vector<NodeId> out = setup_.shards.owners;
  out.push_back({static_cast<uint16_t>(setup_.graph.workers())});
  return out;
}

std::unique_ptr<SimNode> Simulation::make(NodeId node, uint32_t life) {
  begins_[node.value] = world_->now();
  NodeSetup& setup = setups_.of_life(node, life);
  if (node == controller()) {
    begin_controller(life);
    return std::make_unique<SimController>(setup_, setup, *run_, stop_, *world_, costs_,
                                           journal_.get());
  }
  return std::make_unique<SimWorker>(setup_, setup,
                                     charged_seams(*world_, node, costs_, builders_, setup.buggify),
                                     world_->clock(node), costs_, report_.caches);
}

/// Restores its totals from its journal, which may end in a torn record.
void Simulation::begin_controller(uint32_t life) {
  if (life > 0) {
    Random random(options_.seed, RandomStream::faults);
    random.start(2 + life);
    for (uint32_t torn = random.bits() % 64; torn > 0; --torn)
      disk_.push_back(static_cast<std::byte>(random.bits()));
  }
  if (journal_) report_.snapshots += journal_->snapshots();
  journal_.reset();
  run_ = scene_.fresh_run(false);
  if (sharded()) return;
  const int64_t before = run_->traced();
  if (snapshot_)
    LUX_CHECK(take_flux(*snapshot_, {}, *run_).ok(), "a simulated disk gives back a snapshot");
  auto store = std::make_unique<FaultyStore>(std::make_unique<MemoryStore>(disk_), controller(),
                                             faults_, world_->clock(controller()));
  auto journal = FluxJournal::open(std::move(store), *run_);
  LUX_CHECK(journal.ok(), "a simulated disk gives back what was kept");
  const auto make_snapshot = [this]() -> Result<void> {
    snapshot_ = flux_of(*run_);
    return {};
  };
  journal_ = std::make_unique<SnapshotJournal>(std::move(journal).value(), drawn_journal(),
                                               make_snapshot, world_->clock(controller()));
  report_.recovered += run_->traced() - before;
}

/// Some limits are so low that snapshots are frequent.
SnapshotJournal::Config Simulation::drawn_journal() const {
  SnapshotJournal::Config config;
  if (!options_.draw_nodes) return config;
  Random random(options_.seed, RandomStream::faults);
  random.start(journal_stream);
  constexpr std::array<uint64_t, 3> lengths{4 << 10, 64 << 10, 256 << 20};
  config.max_bytes = lengths[random.bits() % lengths.size()];
  return config;
}

void Simulation::note_last(const SimController& controller) {
  const Coordinator::Counters& c = controller.coordinator().counters();
  report_.leases = c.leases;
  report_.leases_fenced = c.fenced;
  report_.flushes_refused = c.flushes_refused;
  report_.took = controller.coordinator().took();
  if (!controller.coordinator().ended()) return;
  reason_ = controller.coordinator().reason();
  if (let_go_ != never) return;
  let_go_ = world_->now();
  fresh_ = controller.word_is_fresh() + longest_word_below();
}

/// Confirmations are passed up when they may be this old, level by level.
Nanoseconds Simulation::longest_word_below() {
  Nanoseconds longest = 0;
  for (uint16_t node = 0; node < setup_.graph.workers(); ++node)
    if (const SimNode* const here = world_->node({node}))
      longest = std::max(longest, static_cast<const CheckedNode*>(here)->word_is_fresh());
  return longest * (setup_.tree->height(setup_.tree->root()) - 1);
}

/// A worker has left: checks that it has heard of the end, however it was cut off. Exempt is a node
/// that restarts after all were released, since none is left to tell it; and one that restarts
/// shortly before, while confirmations of its earlier life still count.
void Simulation::note_left(NodeId node, const CheckedNode& left) {
  if (let_go_ != never && begins_[node.value] >= let_go_ - fresh_) return;
  if (auto ok = left.outcome(); !ok)
    report_.failure =
        fmt::format("{} has left with \"{}\"", setup_.name_of(node), ok.problem().what);
}

void Simulation::go() {
  world_->start([this](NodeId node, uint32_t life) { return make(node, life); });
  const Nanoseconds end = options_.work + options_.faults_last + options_.patience;
  while (report_.failure.empty() && world_->step()) {
    const NodeId last = world_->last();
    if (last == no_node) continue;
    const SimNode* const here = world_->node(last);
    const auto* node = static_cast<const CheckedNode*>(here != nullptr ? here : world_->departed());
    if (node == nullptr) continue;
    if (auto ok = node->check(); !ok)
      report_.failure = fmt::format("{}: {}", setup_.name_of(last), ok.problem().what);
    if (here == nullptr && report_.failure.empty()) note_left(last, *node);
    if (last == controller()) note_last(*static_cast<const SimController*>(node));
    if (world_->now() > end)
      report_.failure =
          fmt::format("it has not ended {} s after all was healed", options_.patience / seconds(1));
  }
  if (report_.failure.empty())
    if (auto ok = ended_well(); !ok) report_.failure = ok.problem().what;
  if (journal_) report_.snapshots += journal_->snapshots();
  report_.virtual_time = world_->now();
  report_.trace_hash = world_->trace_hash();
  report_.world = world_->counters();
  world_.reset();  // its nodes add their statistics
  report_.rare_ways = setups_.rare_ways_taken();
}

Result<void> Simulation::ended_well() const {
  if (!reason_)
    return problem("nobody has anything to do, and the run has not ended", ProblemKind::bug);
  if (*reason_ != StopReason::particles)
    return problem(fmt::format("the run ended by {}, not by its particles", name_of(*reason_)),
                   ProblemKind::bug);
  if (auto ok = scene_.compare(*run_); !ok) return ok.problem();
  return display_.check();
}

Result<SimReport> Simulation::run(const SimScene& scene, const SimOptions& options) {
  NodesOptions wanted = drawn_nodes(*scene.scene(), options);
  SimDisplay display(scene);
  wanted.display = &display;
  wanted.display_node = drawn_display(options);
  const std::unique_ptr<LocalRun> run = scene.fresh_run(wanted.object_bytes == 0);
  StopRule stop;
  stop.particles = scene.particles();
  auto nodes = PlannedNodes::make(*run, wanted, stop, options.seed | 1);
  if (!nodes) return nodes.problem();
  Simulation simulation(scene, options, *nodes.value(), display);
  simulation.go();
  simulation.report_.nodes =
      fmt::format("{} nodes, {} fibers, {} replicas, {} shards, objects {} KiB, display {}",
                  wanted.nodes, wanted.fibers, wanted.replicas, wanted.tally_shards,
                  wanted.object_bytes >> 10, wanted.display_node->value);
  return std::move(simulation.report_);
}

}  // namespace

Result<SimReport> simulate(const SimScene& scene, const SimOptions& options) {
  return Simulation::run(scene, options);
}

}  // namespace luxodus
