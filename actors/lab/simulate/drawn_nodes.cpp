#include "actors/lab/simulate/drawn_nodes.hpp"

#include <array>

#include "actors/cast/node/graph_routes.hpp"
#include "runtime/core/random.hpp"
#include "runtime/sim/swarm.hpp"

namespace luxodus {

namespace {

/// Random draws about nodes, in a fixed order.
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

/// Room for the largest cell and one build, `more` times over.
size_t tight_budget(const CompiledScene& scene, size_t more) {
  const std::array holders{NodeId{0}};
  const SceneObjects objects(scene, holders, 1);
  return 2 * more * objects.largest_build_bytes();
}

NodesOptions draw_nodes(Draw& draw, const CompiledScene& scene, const SimOptions& options) {
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
  if (options.fan_out > 0) nodes.tally_shards = 1;  // shards require a single level
  return nodes;
}

/// Draws extreme times and windows, so that rare paths are taken often.
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

/// Memory maps for stack guards of all nodes together: they share one process, for which the kernel
/// allows 65 530, and a thousand nodes take most of them otherwise.
constexpr size_t all_maps = 8'192;
/// In RandomStream::faults, after those of the swarm, the nodes' habits and torn ends.
constexpr uint64_t rare_ways_stream = uint64_t{1} << 32;

}  // namespace

NodesOptions drawn_nodes(const CompiledScene& scene, const SimOptions& options) {
  Draw draw(options.seed);
  return draw_nodes(draw, scene, options);
}

FaultPlan faults_of(const SimOptions& options, const RunSetup& run,
                    const std::vector<NodeId>& spared) {
  if (options.plan) {
    FaultPlan plan = *options.plan;
    plan.seed ^= options.seed;  // the same faults with other random numbers
    return plan;
  }
  if (!options.faults) {
    FaultPlan quiet;  // a rack's network
    quiet.seed = options.seed;
    quiet.links.delay = microseconds(50);
    quiet.links.jitter = microseconds(20);
    quiet.links.bytes_per_second = 1e9;
    return quiet;
  }
  SwarmFrame frame;
  frame.edges = edges_of(run.graph);
  frame.nodes = static_cast<uint16_t>(run.graph.workers() + 1);
  frame.lasts = options.faults_last;
  frame.spared = spared;
  return swarm(options.seed, frame);
}

DrawnSetups::DrawnSetups(const PlannedNodes& nodes, const CompiledScene& scene,
                         const SimOptions& options, const SimCosts& costs, const FaultPlan& faults)
    : seed_(options.seed) {
  setups_ = nodes.workers();
  setups_.push_back(nodes.controller());
  NodeSetup habits = nodes.controller();
  Draw draw(options.seed);
  (void)draw_nodes(draw, scene, options);  // these draws come first
  if (options.draw_nodes) draw_habits(draw, habits);
  // A turn should be short against a heartbeat.
  const auto portion = std::clamp<int64_t>(
      milliseconds(5) / std::max<Nanoseconds>(whole_ns(costs.particle_ns), 1), 1, 128);
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
    // A node that waits this long sees the end of all faults, and the world notices whether it
    // waited in vain.
    node.start = node.lost = options.patience / 2;
    node.stall = seconds(3600);
    node.fibers.max_maps =
        std::max<size_t>(2, std::min(node.fibers.max_maps, all_maps / setups_.size()));
    node.faults = faults;  // for its stores
  }
  if (!options.draw_nodes && !options.rare_ways) return;
  rare_ways_.reserve(setups_.size());
  for (NodeSetup& node : setups_) {
    rare_ways_.emplace_back(options.seed, rare_ways_stream + node.net.self.value);
    node.buggify = node.net.buggify = &rare_ways_.back();
  }
}

NodeSetup& DrawnSetups::of_life(NodeId node, uint32_t life) {
  NodeSetup& setup = setups_[node.value];
  setup.net.incarnation = {draw_life(seed_, node, life)};
  return setup;
}

uint64_t DrawnSetups::rare_ways_taken() const {
  uint64_t taken = 0;
  for (const Buggify& ways : rare_ways_) taken += ways.taken();
  return taken;
}

}  // namespace luxodus
