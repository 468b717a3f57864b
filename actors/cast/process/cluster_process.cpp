#include "actors/cast/process/cluster_process.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>

#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/node/residency_setup.hpp"
#include "actors/cast/parts/profile_file.hpp"
#include "actors/cast/process/out_of_core_for.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/run/open_scene.hpp"
#include "runtime/config/cluster_file.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/log.hpp"
#include "runtime/core/output_path.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/fiber/sanitizers.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/packed_scene.hpp"
#include "topology/graph_file.hpp"
#include "topology/shipped.hpp"

namespace luxodus {

namespace {

/// A cell is at most this fraction of a budget, so that a cache holds several and a build fits.
constexpr uint64_t cells_of_a_budget = 16;
/// Largest share of a budget that a plan may pin.
constexpr double pinned_share = CacheConfig{}.pinned_share;

Incarnation fresh_incarnation() {
  Incarnation life{};
  while (life.value == 0) {
    if (::getrandom(&life.value, sizeof life.value, 0) != sizeof life.value)
      throw std::runtime_error("the system gives no random number for a node's incarnation");
  }
  return life;
}

Result<Graph> found_graph(const ClusterConfig& cluster) {
  const TopologyChoice& choice = cluster.topology;
  AmpRequest request;
  request.nodes = static_cast<uint32_t>(cluster.workers());
  request.links = choice.max_links;
  request.controller_links = std::min(choice.max_controller_links, request.nodes);
  request.controller_forwards = choice.controller == TopologyChoice::Controller::forwards;
  auto graph = minimum_path_graph(request);
  if (!graph) return problem_in(cluster.file, graph.problem());
  return graph;
}

Result<Graph> listed_graph(const ClusterConfig& cluster) {
  GraphPlan plan;
  plan.workers = static_cast<uint32_t>(cluster.workers());
  plan.max_links = cluster.topology.max_links;
  plan.controller = cluster.topology.controller == TopologyChoice::Controller::forwards
                        ? ControllerRole::forwards
                        : ControllerRole::endpoint;
  for (const Edge& edge : cluster.topology.edges)
    plan.links.push_back({edge.a.value, edge.b.value});
  std::sort(plan.links.begin(), plan.links.end());
  if (auto fault = fault_of(plan)) return problem_in(cluster.file, fault->what);
  return Graph(std::move(plan));
}

Result<Graph> graph_in_file(const ClusterConfig& cluster) {
  auto text = read_whole_file(cluster.topology.file, limits::cluster_file_bytes);
  if (!text) return text.problem();
  const auto& bytes = text.value();
  return parse_graph({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                     cluster.topology.file.string());
}

/// Identifies a run of a file; unchanged when its controller restarts.
std::string where_results_go(const ClusterConfig& cluster) {
  const std::string text =
      cluster.view.live ? "a live view of " + cluster.file.string()
                        : std::filesystem::absolute(cluster.run.out).lexically_normal().string();
  // The end of a long path is distinctive. A refusal has room for two such names.
  constexpr size_t max_chars = 180;
  return text.size() <= max_chars ? text : "..." + text.substr(text.size() - max_chars);
}

}  // namespace

Result<Graph> graph_of(const ClusterConfig& cluster) {
  if (cluster.topology.controller == TopologyChoice::Controller::node)
    return problem_in(cluster.file,
                      "a controller that is a vertex as all others is not supported: say "
                      "controller = \"forwards\" or \"endpoint\"");
  auto graph = cluster.topology.kind == TopologyChoice::Kind::amp     ? found_graph(cluster)
               : cluster.topology.kind == TopologyChoice::Kind::links ? listed_graph(cluster)
                                                                      : graph_in_file(cluster);
  if (graph && (graph.value().workers() != cluster.workers() || !graph.value().has_controller())) {
    return problem_in(cluster.file,
                      "the graph has " + std::to_string(graph.value().workers()) + " workers" +
                          (graph.value().has_controller() ? "" : " and no controller") +
                          ", the cluster " + std::to_string(cluster.workers()) + " and one");
  }
  return graph;
}

uint64_t smallest_object_bytes(const ClusterConfig& cluster) {
  uint64_t smallest = UINT64_MAX;
  for (const ClusterNode& node : cluster.nodes) {
    if (node.role == NodeRole::worker) smallest = std::min(smallest, node.budget.object_bytes);
  }
  return smallest;
}

int cells_for(const ClusterConfig& cluster, uint64_t built_geometry_bytes) {
  const uint64_t most = std::max<uint64_t>(smallest_object_bytes(cluster) / cells_of_a_budget, 1);
  return static_cast<int>(std::min<uint64_t>(built_geometry_bytes / most + 1, 1'000'000));
}

std::vector<NodeId> holders_of(const ClusterConfig& cluster) {
  std::vector<NodeId> holders;
  for (uint16_t i = 0; i < cluster.workers(); ++i)
    if (cluster.node({i}).stores) holders.push_back({i});
  return holders;
}

ClusterProcessRun::~ClusterProcessRun() = default;

Result<std::unique_ptr<ClusterProcessRun>> ClusterProcessRun::prepare(
    const ClusterConfig& cluster, const std::vector<NodeId>& nodes) {
  auto graph = graph_of(cluster);
  if (!graph) return graph.problem();
  std::unique_ptr<ClusterProcessRun> process(
      new ClusterProcessRun(cluster, std::move(graph).value()));
  process->nodes_ = nodes;
  if (auto ok = process->load_keys(nodes); !ok) return ok.problem();
  if (auto ok = process->load_scene(); !ok) return ok.problem();
  if (auto ok = process->check_stored_objects(); !ok) return ok.problem();
  return process;
}

Result<void> ClusterProcessRun::load_keys(const std::vector<NodeId>& nodes) {
  if (cluster_.keys.folder.empty()) return {};
  for (const NodeId node : nodes) {
    auto keys = read_keys(key_path(cluster_.keys.folder, cluster_.node(node).name));
    if (!keys) return keys.problem();
    keys_.emplace(node, std::move(keys).value());
  }
  for (uint16_t i = 0; i < cluster_.nodes.size(); ++i) {
    auto key = read_public_key(public_key_path(cluster_.keys.folder, cluster_.node({i}).name));
    if (!key) return key.problem();
    public_keys_.emplace(NodeId{i}, std::move(key).value());
  }
  return {};
}

namespace {

/// Assessments use frames of simulations; everything else interpolates between them.
Result<std::shared_ptr<const SceneDescription>> described(const ClusterConfig& cluster) {
  const FireFrames frames = cluster.assess.asked ? FireFrames::nearest : FireFrames::between;
  OpenedScene opened = open_scene(cluster.run.scene, cluster.run.at_s, {}, frames);
  if (!opened.scene) return opened.problems.list().front();
  return std::move(opened.scene);
}

}  // namespace

Result<void> ClusterProcessRun::load_scene() {
  auto description = described(cluster_);
  if (!description) return description.problem();
  auto scenario = find_scenario(*description.value(), cluster_.run.scenario);
  if (!scenario) return scenario.problem();
  auto scene = compile_scene(description.value(), scenario.value(), {1});
  if (!scene) return scene.problem();
  const uint64_t geometry = built_bytes_of(scene.value()->triangles * sizeof(TriangleRecord));
  const uint64_t beside = built_bytes_beside_cells(*scene.value());
  fetches_ = geometry + beside > smallest_object_bytes(cluster_);
  const int wanted = fetches_ ? cells_for(cluster_, geometry) : 1;
  const PackedScene* packed = description.value()->packed.get();
  cells_ = packed != nullptr ? packed->partition : wanted;
  if (packed == nullptr && wanted > 1)
    scene = compile_scene(description.value(), scenario.value(), {cells_});
  if (!scene) return scene.problem();
  const uint64_t seed = description.value()->run.seed;
  if (!fetches_) {
    run_ = std::make_unique<LocalRun>(scene.value(), seed, 1);
    return {};
  }
  if (!in_parts(*scene.value())) {
    return problem_in(
        cluster_.run.scene,
        "this pack is of one cell, which is more than a node's object_bytes: pack the "
        "scene with a smaller --cell-kib");
  }
  OutOfCoreConfig rows;
  rows.object_bytes = cluster_.node(cluster_.display.node).budget.object_bytes;
  rows.sharing = cluster_.run.sharing;
  run_ = std::make_unique<LocalRun>(scene.value(), seed, 1,
                                    std::make_unique<OutOfCoreParallelFor>(scene.value(), rows));
  return {};
}

Result<void> ClusterProcessRun::check_stored_objects() const {
  const PackedScene* packed = run_->scene().description->packed.get();
  if (!fetches_ || packed == nullptr) return {};
  // A host may have only the skeleton: its workers say stores = false, its controller need not.
  const bool here = std::any_of(nodes_.begin(), nodes_.end(), [&](NodeId node) {
    return node == cluster_.controller() ? !packed->file->object(0).empty()
                                         : cluster_.node(node).stores;
  });
  if (shows() && packed->file->object(0).empty())
    return problem_in(cluster_.run.scene,
                      "this is the skeleton of a pack, and the results are written here: give the "
                      "whole pack, or name another node in [display]");
  return here ? check_objects(run_->scene()) : Result<void>{};
}

Result<ReferenceProfile> ClusterProcessRun::profile(double share) const {
  if (!fetches_)
    return problem_in(
        cluster_.file,
        "every worker's budget holds the whole scene: nothing is fetched, and a profile "
        "would change nothing");
  uint64_t budget = 0;
  for (const ClusterNode& node : cluster_.nodes)
    budget = std::max(budget, node.budget.object_bytes);
  const CompiledScene& scene = run_->scene();
  const SceneObjects objects(scene, std::array{NodeId{0}}, 1);
  const EmbreeDevice device;
  const ProxyScene proxies(device, scene.cell_boxes);
  const auto of_run = static_cast<double>(cluster_.run.particles.value_or(usual_particles));
  const auto particles = static_cast<int64_t>(share * of_run);
  return count_references(scene, objects, proxies, run_->seed(),
                          profile_particles(BatchPlan(scene).shares(), particles), budget);
}

Result<std::optional<Residency>> ClusterProcessRun::planned_residency(const RunSetup& run) const {
  if (cluster_.run.profile.empty()) return std::optional<Residency>();
  auto profile = read_profile(cluster_.run.profile, run.scene, run.objects->places().size());
  if (!profile) return profile.problem();
  ResidencyBudgets budgets{{}, pinned_share, replicas()};
  for (const ClusterNode& node : cluster_.nodes)
    if (node.role == NodeRole::worker) budgets.object_bytes.push_back(node.budget.object_bytes);
  return std::optional(residency_for(profile.value(), run.scene, *run.objects, graph_, budgets));
}

Result<NodeSetup> ClusterProcessRun::setup_of(NodeId self, const RunSetup& run) const {
  NodeSetup node;
  node.net = net_config(cluster_, self);
  node.net.incarnation = fresh_incarnation();
  complete(node.net, run);
  if (self == cluster_.controller()) node.net.identity.results = where_results_go(cluster_);
  node.links = links_of(cluster_, self, node.net.edges);
  if (const auto own = keys_.find(self); own != keys_.end()) node.keys = own->second;
  node.public_keys = public_keys_;
  node.insecure = cluster_.keys.insecure;
  node.controller = cluster_.controller();
  const NodeBudget& budget = cluster_.node(self).budget;
  node.photons.fibers = fetches_ ? budget.fibers : 1;
  node.object_bytes = budget.object_bytes;
  node.prefetch = budget.prefetch;
  node.pinned_share = cluster_.run.profile.empty() ? 0 : pinned_share;
  node.fibers.stack_bytes = budget.stack_bytes * sanitizers::stack_factor;
  if (budget.max_maps > 0) node.fibers.max_maps = budget.max_maps;
  node.stall = cluster_.timeouts.stall;
  node.start = cluster_.timeouts.start;
  node.lost = node.rejoin = cluster_.timeouts.lost;
  node.lease_time = cluster_.lease.duration;
  node.photons.leases = cluster_.lease.batches;
  node.tally_bytes = budget.tally_bytes;
  node.shutdown_phase = cluster_.timeouts.shutdown_phase;
  node.faults = cluster_.faults;
  node.one_clock = cluster_.hosts.size() == 1;
  node.fetch.tries = static_cast<uint8_t>(cluster_.timeouts.fetch_attempts);
  node.fetch.flights = std::min(cluster_.links.assemblies, limits::part_answers / 2);
  node.fetch.timeouts.floor = cluster_.timeouts.fetch_floor;
  return node;
}

ObserveOptions ClusterProcessRun::observe_options() const {
  ObserveOptions options;
  options.address = cluster_.observe.metrics_address;
  const ClusterProcess& process = cluster_.processes[cluster_.node(nodes_.front()).process];
  if (process.metrics_port != 0) options.metrics_port = process.metrics_port;
  // As `luxodus status` requests it; behind address translation the host itself has another
  // address.
  options.allowed_hosts = {cluster_.hosts[process.host].address};
  if (!cluster_.observe.allow_host.empty())
    options.allowed_hosts.push_back(cluster_.observe.allow_host);
  options.trace_every = cluster_.observe.trace_every;
  return options;
}

bool ClusterProcessRun::shows() const {
  return cluster_.is_run() && std::count(nodes_.begin(), nodes_.end(), cluster_.display.node) > 0;
}

Result<void> ClusterProcessRun::open_journal(const Clock& clock) {
  RunJournalConfig config;
  config.folder = cluster_.run.out;
  config.self = cluster_.controller();
  config.faults = cluster_.faults;
  auto journal = RunJournal::open(config, *run_, clock);
  if (!journal) return journal.problem();
  journal_ = std::move(journal).value();
  if (journal_->torn_bytes() > 0)
    log_warning("journal=torn bytes={} text=\"the end of it was cut: a crash tore it\"",
                journal_->torn_bytes());
  if (journal_->recovered() > 0)
    log_warning("run=recovered batches={} text=\"an earlier life of this node has counted them\"",
                journal_->recovered());
  return {};
}

void ClusterProcessRun::forget_journal() const {
  if (journal_) journal_->remove();
}

void ClusterProcessRun::make_room() const {
  if (journal_) journal_->make_room();
}

/// Beside the results, named after the process: several may share the folder.
Result<void> ClusterProcessRun::write_trace(const Observation& seen) const {
  if (!seen.traces()) return {};
  std::error_code failed;
  std::filesystem::create_directories(cluster_.run.out, failed);
  if (failed)
    return system_problem(cluster_.run.out, "cannot make this folder for the trace",
                          failed.value());
  const size_t process = cluster_.node(nodes_.front()).process;
  return seen.write_trace(behind_links(
      cluster_.run.out / ("trace-" + file_name_of(cluster_.processes[process].name) + ".json")));
}

/// Setup of the process's nodes, which refer to it.
struct ClusterProcessRun::Prepared {
  Prepared(const LocalRun& run, const Graph& graph, uint32_t fan_out,
           std::span<const Admitted> admitted, const SceneIndex* index)
      : context({admitted.begin(), admitted.end()}),
        tree(graph, fan_out),
        routes(balanced_routes(graph)),
        setup{run.scene(), index, nullptr, nullptr, run.seed(), graph, {}, nullptr} {
    setup.routes = &routes;
    setup.tree = &tree;
  }
  SystemClock clock;
  ZmqContext context;
  Machine machine{clock, context};
  EmbreeDevice device;
  std::optional<SceneObjects> objects;
  std::optional<ProxyScene> proxies;
  std::optional<SharedObjects> shared;
  std::optional<Residency> residency;
  std::unique_ptr<Observation> seen;
  CoordinationTree tree;
  Routes routes;
  RunSetup setup;
  std::vector<NodeSetup> workers;
  std::optional<NodeSetup> controller;
};

Result<std::unique_ptr<ClusterProcessRun::Prepared>> ClusterProcessRun::prepare_nodes(
    RunOutput* display) {
  std::vector<Admitted> admitted;
  for (const auto& [node, key] : public_keys_) admitted.push_back({node, key});
  const bool one_level = !cluster_.tally.shards.empty() || !cluster_.is_run();
  const uint32_t fan_out = chosen_fan_out(cluster_.lease.fan_out, graph_.workers(), one_level);
  auto out = std::make_unique<Prepared>(*run_, graph_, fan_out, admitted,
                                        fetches_ ? nullptr : &run_->index());
  RunSetup& setup = out->setup;
  for (const ClusterNode& node : cluster_.nodes) setup.names.push_back(node.name);
  setup.shards.owners = cluster_.tally.shards;
  if (cluster_.is_run()) setup.display = cluster_.display.node;
  if (fetches_) {
    const std::vector<NodeId> holders = holders_of(cluster_);
    out->objects.emplace(run_->scene(), holders, std::min<size_t>(replicas(), holders.size()));
    out->proxies.emplace(out->device, run_->scene().cell_boxes);
    setup.objects = &*out->objects;
    setup.proxies = &*out->proxies;
    if (cluster_.run.sharing) setup.shared = &out->shared.emplace(out->objects->places().size());
    auto planned = planned_residency(setup);
    if (!planned) return planned.problem();
    out->residency = std::move(planned).value();
    // If some workers have no storage, the plan's holders might not have the objects.
    if (out->residency && holders_of(cluster_).size() == cluster_.workers())
      out->objects->place(out->residency->holders);
  }
  auto seen = Observation::start(observe_options());
  if (!seen) return seen.problem();
  out->seen = std::move(seen).value();
  if (out->seen->watches()) setup.observation = out->seen.get();
  for (const NodeId node : nodes_) {
    auto own = setup_of(node, setup);
    if (!own) return own.problem();
    if (node == cluster_.display.node) own.value().display = display;
    if (out->residency) settle(own.value(), *out->residency);
    if (node == cluster_.controller())
      out->controller = std::move(own).value();
    else
      out->workers.push_back(std::move(own).value());
  }
  for (const NodeSetup& node : out->workers)
    if (auto ok = check_budget(setup, node); !ok) return problem_in(cluster_.file, ok.problem());
  log_info("memory plan\n{}", plan_text(setup, out->workers, out->controller));
  return out;
}

Result<std::optional<StopReason>> ClusterProcessRun::run(
    const std::atomic<bool>& interrupt, const std::function<void(const Progress&)>& report,
    RunOutput* display) {
  auto prepared = prepare_nodes(display);
  if (!prepared) return prepared.problem();
  Prepared& nodes = *prepared.value();
  // With shards the journal would hold only a part of the totals.
  if (nodes.controller && nodes.setup.shards.owners.empty())
    if (auto ok = open_journal(nodes.clock); !ok) return ok.problem();
  WorkerThreads threads(nodes.setup, nodes.machine, nodes.workers,
                        [&] { return !nodes.controller && interrupt.load(); });
  std::optional<StopReason> reason;
  if (nodes.controller) {
    StopRule stop;
    if (cluster_.run.particles) stop.particles = static_cast<int64_t>(*cluster_.run.particles);
    stop.relative_error = cluster_.run.relative_error;
    stop.seconds = cluster_.run.time_s;
    auto ended = run_controller(nodes.setup, nodes.machine, *nodes.controller,
                                {*run_, stop, interrupt, report, journal_.get()},
                                [&] { return threads.failed(); });
    if (!ended) {
      if (journal_) journal_->leave_no_trace();
      return ended.problem();
    }
    reason = ended.value();
  }
  threads.join();
  if (threads.failed()) return threads.problem();
  if (!nodes.controller && threads.lost()) return *threads.lost();
  if (nodes.residency) residency_lines_ = residency_table(*nodes.residency, threads.by_node());
  if (auto ok = write_trace(*nodes.seen); !ok) return ok.problem();
  return reason;
}

Result<std::optional<StopReason>> ClusterProcessRun::run(const std::atomic<bool>& interrupt,
                                                         const NodeWork& work) {
  if (fetches_)
    return problem_in(
        cluster_.file,
        "[view], [assess] and [render] need nodes that hold the whole scene: raise object_bytes in "
        "[budget]");
  auto prepared = prepare_nodes(nullptr);
  if (!prepared) return prepared.problem();
  const Prepared& nodes = *prepared.value();
  WorkerThreads threads(
      nodes.setup, nodes.machine, nodes.workers, [&] { return interrupt.load(); }, work.worker);
  std::optional<StopReason> reason;
  if (nodes.controller) {
    auto ended = work.controller(nodes.setup, nodes.machine, *nodes.controller);
    threads.join();
    if (!ended) return ended.problem();
    reason = ended.value();
  }
  threads.join();
  if (threads.failed()) return threads.problem();
  return reason;
}

}  // namespace luxodus
