#include "actors/supervise/in_process.hpp"

#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "actors/source/controller.hpp"
#include "actors/supervise/node_metrics.hpp"
#include "actors/supervise/node_plan.hpp"
#include "actors/supervise/residency_setup.hpp"
#include "topology/shipped.hpp"

namespace luxodus {

namespace {

constexpr uint32_t controller_links_most = 4;

Result<Graph> graph_for(const NodesOptions& options) {
  AmpRequest request;
  request.nodes = static_cast<uint32_t>(options.nodes);
  request.links = static_cast<uint32_t>(options.links);
  request.controller_links = std::min(request.nodes, controller_links_most);
  return minimum_path_graph(request);
}

std::optional<std::string> fault_of(const NodesOptions& options, const CompiledScene& scene,
                                    bool resident) {
  if (options.object_bytes == 0) {
    if (resident) return std::nullopt;
    return "nodes that do not hold the whole scene need a budget for objects";
  }
  if (!in_parts(scene))
    return "nodes with a budget need a partition of the geometry: add --cells, or pack the scene "
           "with more than one";
  if (options.replicas < 1 || options.replicas > static_cast<uint32_t>(options.nodes) ||
      options.replicas > limits::holders)
    return "an object can be held by 1 to " + std::to_string(limits::holders) +
           " nodes, and by no more than there are";
  return std::nullopt;
}

/// In memory: every node listens under its own name.
Endpoints endpoints_of(NodeId node) {
  const std::string name = "inproc://node-" + std::to_string(node.value);
  return {name, name + "-bulk"};
}

/// `common` is what all nodes' networks have in common.
NodeSetup setup_of(const RunSetup& run, const NetConfig& common, NodeId self,
                   const NodesOptions& options, uint64_t run_id) {
  NodeSetup node;
  node.net = common;
  node.net.self = self;
  node.net.incarnation = {run_id + self.value + 1};
  node.net.identity.node = self;
  node.net.identity.run_id = run_id;
  node.links.listen.push_back(endpoints_of(self));
  for (const Vertex neighbour : run.graph.all().of(self.value)) {
    const NodeId other{static_cast<uint16_t>(neighbour)};
    if (other < self) node.links.connect.emplace_back(other, endpoints_of(other));
  }
  node.controller = {static_cast<uint16_t>(run.graph.controller())};
  node.photons.fibers = options.fibers;
  node.photons.portion = static_cast<int64_t>(options.portion);
  node.object_bytes = options.object_bytes;
  node.pinned_share = options.pinned_share;
  node.link_delay = options.link_delay;
  return node;
}

/// Particles of the profile: the share of those that the run will trace, as far as that is known.
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
  if (!profile.ok()) return profile.problem();
  const std::vector<size_t> budgets(static_cast<size_t>(options.nodes), options.object_bytes);
  return std::optional(residency_for(profile.value(), run.scene, *run.objects, run.graph,
                                     {budgets, options.pinned_share, options.replicas}));
}

}  // namespace

// ---- workers ---------------------------------------------------------------------------------

WorkerThreads::WorkerThreads(const RunSetup& run, const std::vector<NodeSetup>& nodes,
                             const std::function<bool()>& stop) {
  for (const NodeSetup& node : nodes)
    threads_.emplace_back([this, &run, &node, stop] { work(run, node, stop); });
}

void WorkerThreads::work(const RunSetup& run, const NodeSetup& node,
                         const std::function<bool()>& stop) {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // denormals to zero, as in the plain loop
  Problem wrong;
  try {
    Worker worker(run, node);
    auto done = worker.run(stop);
    const std::lock_guard lock(mutex_);
    if (done.ok()) return reports_.push_back(done.value());
    wrong = done.problem();
  } catch (const std::exception& e) {
    wrong = {{}, "node " + std::to_string(node.net.self.value) + ": " + e.what()};
  }
  const std::lock_guard lock(mutex_);
  if (!failed_) problem_ = wrong;
  failed_ = true;
}

void WorkerThreads::join() {
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
  std::sort(reports_.begin(), reports_.end(),
            [](const WorkerReport& a, const WorkerReport& b) { return a.node < b.node; });
}

WorkerReport WorkerThreads::report() const {
  WorkerReport all;
  for (const WorkerReport& one : reports_) all.add(one);
  return all;
}

Problem WorkerThreads::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

// ---- the controller --------------------------------------------------------------------------

Result<StopReason> run_controller(const RunSetup& setup, const NodeSetup& node, LocalRun& run,
                                  const StopRule& stop, const std::atomic<bool>& interrupt,
                                  const std::function<void(const Progress&)>& report,
                                  const std::function<bool()>& broken, NodesReport* counted) {
  NodeTransport transport(setup, node);
  const ShellConfig shell_config{node.net, controller_limits(node), ShellConfig{}.room_bytes_most,
                                 node.shutdown_phase};
  NodeShell shell(shell_config, setup.graph, setup.clock, transport.transport());
  ControllerConfig config;
  config.lease_time = node.lease_time;
  config.group_ranks = node.group_ranks;
  config.leases_most = static_cast<uint32_t>(node.photons.leases);
  config.farewell = node.shutdown_phase;
  config.start = node.start;
  config.lost = node.lost;
  config.names = setup.names;
  config.first_lease = node.net.incarnation.value;
  for (uint16_t i = 0; i < setup.graph.workers(); ++i) config.workers.push_back({i});
  Controller controller(config, run, stop, interrupt, report, shell.scheduler(), shell.network());
  shell.add([&](const Delivery& d) { return controller.deliver(d); });
  if (auto joined = join_links(transport.sockets(), node); !joined.ok()) return joined.problem();
  const Nanoseconds began = setup.clock.now();
  controller.start();
  std::optional<NodeMetrics> metrics;
  if (setup.observation != nullptr) {
    metrics.emplace(setup.names, node.net.self, "controller", shell.scheduler(), shell.network());
    controller.add_metrics(metrics->registry());
    metrics->add_rate({"particles_per_second", "", "Particles counted in a second.", ""},
                      controller.counters().particles);
    metrics->start(*setup.observation);
  }
  shell.run_until([&] { return controller.ended() || broken(); });
  run.add_seconds(static_cast<double>(setup.clock.now() - began) * 1e-9);
  if (controller.fault())
    return Problem{{},
                   setup.name_of(node.net.self) + ": " + controller.fault()->what +
                       meeting_trouble(transport.sockets(), setup.context, shell.network())};
  if (counted != nullptr) {
    const Controller::Counters& c = controller.counters();
    *counted = {c.flushes_taken,
                c.flush_bytes,
                c.leases,
                c.fenced,
                shell.network().counters().frames_received,
                {},
                {},
                std::nullopt};
  }
  return controller.reason();
}

namespace {

/// All that the nodes of such a run are made from.
class InProcess {
 public:
  /// Errors: no graph of so few links, options that contradict each other or the scene.
  static Result<std::unique_ptr<InProcess>> prepare(const LocalRun& run,
                                                    const NodesOptions& options,
                                                    const StopRule& stop) {
    if (auto fault = fault_of(options, run.scene(), run.resident())) return Problem{{}, *fault};
    auto graph = graph_for(options);
    if (!graph.ok()) return graph.problem();
    auto made = std::unique_ptr<InProcess>(new InProcess(run, options, std::move(graph).value()));
    if (auto planned = made->plan_residency(run, options, stop); !planned.ok())
      return planned.problem();
    for (const NodeSetup& node : made->workers)
      if (auto fault = budget_fault(made->setup, node)) return Problem{{}, *fault};
    return made;
  }

 private:
  InProcess(const LocalRun& run, const NodesOptions& options, Graph of_nodes)
      : graph(std::move(of_nodes)), setup{run.scene(), run.resident() ? &run.index() : nullptr,
                                          nullptr,     nullptr,
                                          run.seed(),  graph,
                                          clock,       context,
                                          {},          options.observation} {
    for (int i = 0; i < options.nodes; ++i) setup.names.push_back("n" + std::to_string(i));
    setup.names.push_back("controller");
    if (options.object_bytes > 0) {
      std::vector<NodeId> holders;
      for (uint16_t i = 0; i < options.nodes; ++i) holders.push_back({i});
      objects.emplace(run.scene(), holders, options.replicas);
      proxies.emplace(device, run.scene().cell_boxes);
      setup.objects = &*objects;
      setup.proxies = &*proxies;
      if (options.sharing) shared.emplace(objects->places().size());
      setup.shared = shared ? &*shared : nullptr;
    }
  }

  /// Who traces, holds and keeps what; then the nodes, whose handshake covers it.
  Result<bool> plan_residency(const LocalRun& run, const NodesOptions& options,
                              const StopRule& stop) {
    if (objects) {
      auto planned = planned_residency(setup, options, profile_size(run, stop, options));
      if (!planned.ok()) return planned.problem();
      residency = std::move(planned).value();
      if (residency) objects->place(residency->holders);
    }
    const uint64_t run_id = static_cast<uint64_t>(clock.now()) | 1;
    NetConfig common;
    complete(common, setup);
    for (uint16_t i = 0; i <= options.nodes; ++i) {
      workers.push_back(setup_of(setup, common, {i}, options, run_id));
      if (residency) settle(workers.back(), *residency);
    }
    controller = workers.back();
    workers.pop_back();
    return true;
  }

  const Graph graph;
  const SystemClock clock;
  ZmqContext context{{}};
  const EmbreeDevice device;
  std::optional<SceneObjects> objects;
  std::optional<ProxyScene> proxies;
  std::optional<SharedObjects> shared;

 public:
  RunSetup setup;
  std::vector<NodeSetup> workers;
  NodeSetup controller;
  std::optional<Residency> residency;
};

}  // namespace

Result<std::string> plan_on_nodes(const LocalRun& run, const NodesOptions& options) {
  NodesOptions unprofiled = options;
  unprofiled.profile_share = 0;
  auto made = InProcess::prepare(run, unprofiled, {});
  if (!made.ok()) return made.problem();
  const InProcess& nodes = *made.value();
  return plan_text(nodes.setup, nodes.workers, nodes.controller);
}

Result<StopReason> run_on_nodes(LocalRun& run, const NodesOptions& options, const StopRule& stop,
                                const std::atomic<bool>& interrupt,
                                const std::function<void(const Progress&)>& report,
                                NodesReport* counted) {
  auto made = InProcess::prepare(run, options, stop);
  if (!made.ok()) return made.problem();
  InProcess& nodes = *made.value();
  WorkerThreads workers(nodes.setup, nodes.workers, options.stop);
  auto reason = run_controller(
      nodes.setup, nodes.controller, run, stop, interrupt, report, [&] { return workers.failed(); },
      counted);
  workers.join();
  if (workers.failed()) return workers.problem();
  if (counted != nullptr) {
    counted->workers = workers.report();
    counted->by_node = workers.by_node();
    counted->residency = std::move(nodes.residency);
  }
  return reason;
}

}  // namespace luxodus
