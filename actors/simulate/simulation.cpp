#include "actors/simulate/simulation.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <optional>

#include "actors/run/flux_store.hpp"
#include "actors/showing/display_work.hpp"
#include "actors/source/snapshot_journal.hpp"
#include "runtime/core/check.hpp"
#include "runtime/core/random.hpp"
#include "runtime/sim/swarm.hpp"
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

std::string SimScene::difference(const LocalRun& run) const {
  const Totals &ours = run.totals(), &theirs = reference_->totals();
  for (int g = 0; g < theirs.groups(); ++g) {
    if (ours.batches(g) != theirs.batches(g))
      return fmt::format("source group {} has {} batches, the plain loop {}", g, ours.batches(g),
                         theirs.batches(g));
    const auto &a = ours.state(g).totals, &b = theirs.state(g).totals;
    if (std::memcmp(a.data(), b.data(), b.size() * sizeof(Total)) != 0)
      return fmt::format("totals of source group {} differ from the plain loop's", g);
  }
  if (std::memcmp(&ours.balance(), &theirs.balance(), sizeof(EnergyBalance)) != 0)
    return "the ledger differs from the plain loop's";
  return "";
}

// ---- what nodes are like ----------------------------------------------------------------------

namespace {

/// Draws about nodes, in one order.
class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed, RandomStream::faults) { random_.start(1); }
  template <class T>
  T one_of(std::initializer_list<T> choices) {
    const auto at =
        static_cast<size_t>(random_.uniform_double() * static_cast<double>(choices.size()));
    return choices.begin()[std::min(at, choices.size() - 1)];
  }

 private:
  Random random_;
};

/// Room for the largest cell and one that is built, `more` times over.
size_t tight_budget(const CompiledScene& scene, size_t more) {
  const std::array holders{NodeId{0}};
  const SceneObjects objects(scene, holders, 1);
  return 2 * more * objects.largest_build_bytes();
}

NodesOptions drawn_nodes(Draw& draw, const CompiledScene& scene, const SimOptions& options) {
  NodesOptions nodes = options.fixed;
  nodes.nodes = options.nodes;
  nodes.links = options.links;
  nodes.fan_out = options.fan_out;
  nodes.profile_share = 0;
  nodes.sharing = false;  // each stands for a machine
  if (!options.draw_nodes) return nodes;
  nodes.pinned_share = 0;
  nodes.fibers = draw.one_of<size_t>({1, 2, 4, 16, 64});
  const auto room = draw.one_of<size_t>({0, 1, 1, 2, 8});
  if (in_parts(scene) && room > 0) nodes.object_bytes = tight_budget(scene, room);
  nodes.prefetch = draw.one_of<size_t>({0, 0, 1, 4});
  nodes.replicas = std::min(draw.one_of<uint32_t>({1, 2, 3}), static_cast<uint32_t>(options.nodes));
  nodes.tally_shards = std::min(draw.one_of<int>({1, 1, 2, 3}), options.nodes + 1);
  if (options.fan_out > 0) nodes.tally_shards = 1;  // there is one level with them
  return nodes;
}

/// Times and windows so small or so large that seldom ways are taken often.
void draw_habits(Draw& draw, NodeSetup& node) {
  node.net.small_chunk_bytes = draw.one_of<size_t>({256, 1024, 4096});
  node.net.bulk_chunk_bytes = draw.one_of<size_t>({1024, 8192, 65536});
  const auto chunks = draw.one_of<size_t>({1, 2, 4});
  node.net.small_window_bytes = chunks * (node.net.small_chunk_bytes + 128);
  node.net.bulk_window_bytes = chunks * (node.net.bulk_chunk_bytes + 128);
  node.net.outbox_messages = draw.one_of<size_t>({2, 8, 64});
  node.lease_time = draw.one_of<Nanoseconds>({seconds(3), seconds(10), seconds(60)});
  node.photons.leases = draw.one_of<size_t>({1, 2, 4});
  node.photons.open_batches = draw.one_of<size_t>({1, 2});
  node.fetch.tries = draw.one_of<uint8_t>({1, 2, 4});
  node.rejoin = draw.one_of<Nanoseconds>({seconds(3), seconds(10), seconds(60)});
}

uint64_t draw_life(uint64_t seed, NodeId node, uint32_t life) {
  Random random(seed, RandomStream::simulation);
  random.start(1 + (uint64_t{node.value} << 32) + life);
  return random.bits64() | 1;
}

/// A display's disk, which outlives it. It looks at the run every now and then.
class SimDisplay final : public DisplayWork {
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

  /// What is wrong with what it has; "" where it is the flux of the plain loop.
  std::string fault() const {
    if (!whole_) return "the display was shown a part of a flush";
    if (!flux_) return "the display has not kept the flux";
    const auto kept = scene_.fresh_run(false);
    if (auto ok = take_flux(*flux_, {}, *kept); !ok) return ok.problem().what;
    const std::string difference = scene_.difference(*kept);
    return difference.empty() ? "" : "what the display has kept: " + difference;
  }

 private:
  const SimScene& scene_;
  uint64_t looks_ = 0;
  bool whole_ = true;
  std::optional<FluxFile> flux_;
};

/// Of RandomStream::faults: the swarm, the nodes' habits and torn ends have those before.
constexpr uint64_t rare_ways_stream = uint64_t{1} << 32;
/// Behind those of all nodes.
constexpr uint64_t journal_stream = uint64_t{1} << 33;
constexpr uint64_t display_stream = journal_stream + 1;

/// Anywhere; where nodes are not drawn, at the controller's.
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
  void set_up(const PlannedNodes& nodes);
  FaultPlan fault_plan() const;
  std::unique_ptr<SimNode> make(NodeId node, uint32_t life);
  void begin_controller(uint32_t life);
  SnapshotJournal::Config drawn_journal() const;
  void go();
  std::string ended_well() const;
  NodeId controller() const { return {static_cast<uint16_t>(setups_.size() - 1)}; }
  void note_last(const SimController& controller);
  void note_left(NodeId node, const CheckedNode& left);
  bool sharded() const { return !setup_.shards.owners.empty(); }

  const SimScene& scene_;
  const SimOptions options_;
  const SimDisplay& display_;
  std::unique_ptr<LocalRun> run_;     // of the controller's present life
  std::vector<std::byte> disk_;       // of the controller: its journal,
  std::optional<FluxFile> snapshot_;  // and the snapshot, for which there is room, as on a real one
  std::unique_ptr<SnapshotJournal> journal_;
  const RunSetup& setup_;
  std::vector<NodeSetup> setups_;   // the controller's is the last
  std::vector<Buggify> rare_ways_;  // of each, of all its lives
  StopRule stop_;
  SimCosts costs_;
  SimReport report_;
  std::unique_ptr<SimWorld> world_;
  std::optional<StopReason> reason_;
  Nanoseconds let_go_ = never;       // when the controller let all nodes go
  std::vector<Nanoseconds> begins_;  // of each node's present life
};

Simulation::Simulation(const SimScene& scene, const SimOptions& options, PlannedNodes& nodes,
                       const SimDisplay& display)
    : scene_(scene), options_(options), display_(display), setup_(nodes.setup()) {
  stop_.particles = scene.particles();
  costs_.particle_ns = static_cast<double>(options.work) / static_cast<double>(scene.particles());
  set_up(nodes);
  SimSetup world;
  world.nodes = static_cast<uint16_t>(setups_.size());
  world.edges = edges_of(setup_.graph);
  world.plan = fault_plan();
  for (NodeSetup& node : setups_) node.faults = world.plan;  // of its stores
  world_ = std::make_unique<SimWorld>(world);
  begins_.resize(setups_.size());
}

void Simulation::set_up(const PlannedNodes& nodes) {
  setups_ = nodes.workers();
  setups_.push_back(nodes.controller());
  NodeSetup habits = nodes.controller();
  Draw draw(options_.seed);
  (void)drawn_nodes(draw, *scene_.scene(), options_);  // these draws come first
  if (options_.draw_nodes) draw_habits(draw, habits);
  // A turn shall be short against a beat.
  const auto portion = std::clamp<int64_t>(
      milliseconds(5) / std::max<Nanoseconds>(whole_ns(costs_.particle_ns), 1), 1, 128);
  for (NodeSetup& node : setups_) {
    const NetConfig own = node.net;
    node.net = habits.net;
    node.net.self = own.self;
    node.net.identity = own.identity;
    node.lease_time = habits.lease_time;
    node.rejoin = habits.rejoin;
    node.fetch.tries = habits.fetch.tries;
    node.photons.leases = habits.photons.leases;
    node.photons.open_batches = habits.photons.open_batches;
    node.photons.portion = std::min(node.photons.portion, portion);
    // Who waits so long sees the healing, and the world sees who has waited in vain.
    node.start = node.lost = options_.patience / 2;
    node.stall = seconds(3600);
  }
  if (!options_.draw_nodes && !options_.rare_ways) return;
  rare_ways_.reserve(setups_.size());
  for (NodeSetup& node : setups_) {
    rare_ways_.emplace_back(options_.seed, rare_ways_stream + node.net.self.value);
    node.buggify = node.net.buggify = &rare_ways_.back();
  }
}

FaultPlan Simulation::fault_plan() const {
  if (options_.plan) {
    FaultPlan plan = *options_.plan;
    plan.seed ^= options_.seed;  // the same faults, otherwise by chance
    return plan;
  }
  if (!options_.faults) {
    FaultPlan quiet;  // a rack's network
    quiet.seed = options_.seed;
    quiet.links.delay = microseconds(50);
    quiet.links.jitter = microseconds(20);
    quiet.links.bytes_per_second = 1e9;
    return quiet;
  }
  SwarmFrame frame;
  frame.edges = edges_of(setup_.graph);
  frame.nodes = static_cast<uint16_t>(setups_.size());
  frame.lasts = options_.faults_last;
  // A shard of the totals does not survive its node, nor a run in shards its controller.
  if (sharded()) {
    frame.spared = setup_.shards.owners;
    frame.spared.push_back(controller());
  }
  return swarm(options_.seed, frame);
}

std::unique_ptr<SimNode> Simulation::make(NodeId node, uint32_t life) {
  begins_[node.value] = world_->now();
  NodeSetup& setup = setups_[node.value];
  setup.net.incarnation = {draw_life(options_.seed, node, life)};
  if (node == controller()) {
    begin_controller(life);
    return std::make_unique<SimController>(setup_, setup, *run_, stop_, *world_, costs_,
                                           journal_.get());
  }
  return std::make_unique<SimWorker>(setup_, setup,
                                     charged_seams(*world_, node, costs_, setup.buggify),
                                     world_->clock(node), costs_, report_.caches);
}

/// Its totals are those of its journal, at the end of which may stand what a crash has torn.
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
                                             fault_plan(), world_->clock(controller()));
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

/// Some are so short that they become snapshots often.
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
  let_go_ = std::min(let_go_, world_->now());
}

/// A worker has heard of the end, however it was parted from the others. Who begins anew when all
/// have been let go finds nobody who could tell it; nor may who does so shortly before, when what
/// its former life said is still fresh.
void Simulation::note_left(NodeId node, const CheckedNode& left) {
  if (let_go_ != never &&
      begins_[node.value] >= let_go_ - Coordinator::word_is_fresh(CoordinatorConfig{}))
    return;
  if (auto why = left.regret(); !why.empty())
    report_.failure = fmt::format("{} has left with \"{}\"", setup_.name_of(node), why);
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
    if (auto fault = node->fault(); !fault.empty())
      report_.failure = fmt::format("{}: {}", setup_.name_of(last), fault);
    if (here == nullptr && report_.failure.empty()) note_left(last, *node);
    if (last == controller()) note_last(*static_cast<const SimController*>(node));
    if (world_->now() > end)
      report_.failure =
          fmt::format("it has not ended {} s after all was healed", options_.patience / seconds(1));
  }
  if (report_.failure.empty()) report_.failure = ended_well();
  if (journal_) report_.snapshots += journal_->snapshots();
  report_.virtual_time = world_->now();
  report_.trace_hash = world_->trace_hash();
  report_.world = world_->counters();
  world_.reset();  // its nodes add what they did
  for (const Buggify& ways : rare_ways_) report_.rare_ways += ways.taken();
}

std::string Simulation::ended_well() const {
  if (!reason_) return "nobody has anything to do, and the run has not ended";
  if (*reason_ != StopReason::particles)
    return fmt::format("the run ended by {}, not by its particles", name_of(*reason_));
  const std::string difference = scene_.difference(*run_);
  return difference.empty() ? display_.fault() : difference;
}

Result<SimReport> Simulation::run(const SimScene& scene, const SimOptions& options) {
  Draw draw(options.seed);
  NodesOptions wanted = drawn_nodes(draw, *scene.scene(), options);
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
