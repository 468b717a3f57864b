#include "actors/cast/process/planned_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/node/residency_setup.hpp"
#include "topology/shipped.hpp"

namespace luxodus {

namespace {

constexpr uint32_t max_controller_links = 4;

Result<void> check_options(const NodesOptions& options, const CompiledScene& scene, bool resident) {
  if (auto fault = coordination_fault(options.nodes, options.fan_out, options.tally_shards))
    return problem(std::move(fault->what));
  if (options.object_bytes == 0) {
    if (resident) return {};
    return problem("nodes that do not hold the whole scene need a budget for scene parts");
  }
  if (!in_parts(scene))
    return problem(
        "nodes with a budget need a partition of the geometry: add --cells, or pack the scene "
        "with more than one");
  if (options.replicas < 1 || options.replicas > static_cast<uint32_t>(options.nodes) ||
      options.replicas > limits::holders)
    return problem("a scene part can be held by 1 to " + std::to_string(limits::holders) +
                   " nodes, and by no more than there are");
  return {};
}

/// Every node listens under its own name: in memory, or in a folder.
Endpoints endpoints_of(NodeId node, const std::string& sockets) {
  const std::string name = (sockets.empty() ? "inproc://" : "ipc://" + sockets + "/") + "node-" +
                           std::to_string(node.value);
  return {name, name + "-bulk"};
}

/// `common` is the network configuration that all nodes share.
NodeSetup setup_of(const RunSetup& run, const NetConfig& common, NodeId self,
                   const NodesOptions& options, uint64_t run_id) {
  NodeSetup node;
  node.net = common;
  node.net.self = self;
  node.net.incarnation = {run_id + self.value + 1};
  node.net.identity.node = self;
  node.net.identity.run_id = run_id;
  node.links.listen.push_back(endpoints_of(self, options.sockets));
  for (const Vertex neighbour : run.graph.all().of(self.value)) {
    const NodeId other{static_cast<uint16_t>(neighbour)};
    if (other < self) node.links.connect.emplace_back(other, endpoints_of(other, options.sockets));
  }
  node.controller = {static_cast<uint16_t>(run.graph.controller())};
  node.photons.fibers = options.fibers;
  node.photons.portion = static_cast<int64_t>(options.portion);
  node.object_bytes = options.object_bytes;
  node.pinned_share = options.pinned_share;
  node.prefetch = options.prefetch;
  node.tally_bytes = options.tally_bytes;
  node.faults.links.delay = options.link_delay;
  node.faults.links.bytes_per_second = options.link_bytes_per_second;
  node.faults.faults = options.faults;
  node.lease_time = options.lease_time;
  node.lost = options.lost;
  return node;
}

/// Particles of the profile: a share of those that the run will trace, as far as that is known.
int64_t profile_size(const LocalRun& run, const StopRule& stop, const NodesOptions& options) {
  const int64_t left =
      stop.particles ? std::max<int64_t>(0, *stop.particles - run.particles()) : usual_particles;
  return std::llround(options.profile_share * static_cast<double>(left));
}

Result<std::optional<Residency>> planned_residency(const RunSetup& run, const NodesOptions& options,
                                                   int64_t particles) {
  if (options.profile_share <= 0) return std::optional<Residency>();
  const auto size = profile_particles(BatchPlan(run.scene).shares(), particles);
  auto profile = count_references(run.scene, *run.objects, *run.proxies, run.seed, size,
                                  static_cast<uint64_t>(options.nodes) * options.object_bytes);
  if (!profile) return profile.problem();
  const std::vector<size_t> budgets(static_cast<size_t>(options.nodes), options.object_bytes);
  return std::optional(residency_for(profile.value(), run.scene, *run.objects, run.graph,
                                     {budgets, options.pinned_share, options.replicas}));
}

}  // namespace

std::optional<CoordinationFault> coordination_fault(int nodes, uint32_t fan_out, int tally_shards) {
  if (tally_shards < 1 || tally_shards > nodes + 1 ||
      tally_shards > static_cast<int>(limits::tally_shards))
    return CoordinationFault{"tally_shards",
                             "the totals can have 1 to " + std::to_string(nodes + 1) +
                                 " shards: one of the controller, and one of each node"};
  if (fan_out == 1)
    return CoordinationFault{"fan_out", "a coordinator leads at least 2 nodes (fan_out)"};
  if (tally_shards > 1 && fan_out > 0 && fan_out < static_cast<uint32_t>(nodes))
    return CoordinationFault{"tally_shards",
                             "totals in shards need one coordinator for all nodes: leave out the "
                             "shards or the fan-out"};
  return std::nullopt;
}

Result<Graph> graph_of_process(int nodes, int links) {
  AmpRequest request;
  request.nodes = static_cast<uint32_t>(nodes);
  request.links = static_cast<uint32_t>(links);
  request.controller_links = std::min(request.nodes, max_controller_links);
  return minimum_path_graph(request);
}

Result<std::unique_ptr<PlannedNodes>> PlannedNodes::make(const LocalRun& run,
                                                         const NodesOptions& options,
                                                         const StopRule& stop, uint64_t run_id) {
  if (auto ok = check_options(options, run.scene(), run.resident()); !ok) return ok.problem();
  auto graph = options.graph ? Result<Graph>(*options.graph)
                             : graph_of_process(options.nodes, options.links);
  if (!graph) return graph.problem();
  std::unique_ptr<PlannedNodes> made(new PlannedNodes(run, options, std::move(graph).value()));
  if (const uint32_t longest = made->routes_.longest(); longest > limits::hops)
    return problem("the longest way between nodes has " + std::to_string(longest) +
                   " links, and messages pass " + std::to_string(limits::hops) +
                   " at most: take another graph, or fewer nodes");
  if (auto planned = made->plan_residency(run, options, stop); !planned) return planned.problem();
  made->set_up(options, run_id);
  for (const NodeSetup& node : made->workers_)
    if (auto ok = check_budget(made->setup_, node); !ok) return ok.problem();
  return made;
}

PlannedNodes::PlannedNodes(const LocalRun& run, const NodesOptions& options, Graph graph)
    : graph_(std::move(graph)),
      tree_(graph_, chosen_fan_out(options.fan_out, graph_.workers(), options.tally_shards > 1)),
      routes_(balanced_routes(graph_)),
      setup_{run.scene(), run.resident() ? &run.index() : nullptr,
             nullptr,     nullptr,
             run.seed(),  graph_,
             {},          options.observation} {
  for (int i = 0; i < options.nodes; ++i) setup_.names.push_back("n" + std::to_string(i));
  setup_.names.push_back("controller");
  setup_.routes = &routes_;
  if (options.display != nullptr)
    setup_.display = options.display_node.value_or(NodeId{static_cast<uint16_t>(options.nodes)});
  setup_.tree = &tree_;
  for (uint16_t i = 0; i + 1 < options.tally_shards; ++i) setup_.shards.owners.push_back({i});
  if (options.object_bytes == 0) return;
  std::vector<NodeId> holders;
  for (uint16_t i = 0; i < options.nodes; ++i) holders.push_back({i});
  objects_.emplace(run.scene(), holders, options.replicas);
  proxies_.emplace(device_, run.scene().cell_boxes);
  setup_.objects = &*objects_;
  setup_.proxies = &*proxies_;
  if (options.sharing) setup_.shared = &shared_.emplace(objects_->places().size());
}

/// Made before the nodes are set up, since their handshake covers the plan.
Result<void> PlannedNodes::plan_residency(const LocalRun& run, const NodesOptions& options,
                                          const StopRule& stop) {
  if (!objects_) return {};
  auto planned = planned_residency(setup_, options, profile_size(run, stop, options));
  if (!planned) return planned.problem();
  residency_ = std::move(planned).value();
  if (residency_) objects_->place(residency_->holders);
  return {};
}

void PlannedNodes::set_up(const NodesOptions& options, uint64_t run_id) {
  NetConfig common;
  complete(common, setup_);
  for (uint16_t i = 0; i <= options.nodes; ++i) {
    workers_.push_back(setup_of(setup_, common, {i}, options, run_id));
    if (setup_.display == NodeId{i}) workers_.back().display = options.display;
    if (residency_) settle(workers_.back(), *residency_);
  }
  controller_ = workers_.back();
  workers_.pop_back();
}

}  // namespace luxodus
