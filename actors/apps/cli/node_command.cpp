// luxodus node: runs the nodes of one process of a cluster on the machine where they belong.
#include <fmt/format.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "actors/apps/cli/assess_command.hpp"
#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/load_cluster.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/picture_choices.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/run_output_files.hpp"
#include "actors/apps/cli/serve_view.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/view/live_states.hpp"
#include "actors/cast/process/cluster_process.hpp"
#include "actors/cast/process/node_executor.hpp"
#include "actors/judge/assess/round_state.hpp"
#include "actors/results/files/result_files.hpp"
#include "actors/results/files/run_results.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "actors/results/pictures/picture_tiles.hpp"
#include "actors/results/run/flux_store.hpp"
#include "actors/results/run/run_in_pieces.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct NodeOptions {
  std::string config;
  std::vector<std::string> names;
};

/// The folder of the results, if this process writes them: locked until it ends.
Result<std::optional<OutputFolder>> claim_results(const ClusterConfig& cluster,
                                                  const ClusterProcessRun& process) {
  if (!process.shows()) return std::optional<OutputFolder>();
  const fs::path folder =
      cluster.run.out.empty() ? fs::path("out") / file_name_of(cluster.run.name) : cluster.run.out;
  OutputPlan plan = run_output(*process.local_run().scene().description, cluster.display.pictures);
  auto out = OutputFolder::claim(folder, plan);
  if (!out) return out.problem();
  if (auto ok = refuse_foreign_files(out->path(), plan); !ok) return ok.problem();
  return std::optional(std::move(out).value());
}

/// Files of the node that displays the run, as for `luxodus run`.
RunOutputOptions output_options(const ClusterConfig& cluster, const ClusterProcessRun& process,
                                const fs::path& folder) {
  constexpr int preview_paths = 4;
  RunOutputOptions options;
  options.folder = folder;
  options.record.scene_file = fs::absolute(cluster.run.scene).string();
  options.record.at_s = cluster.run.at_s;
  options.record.cells = process.cells();
  options.pictures = cluster.display.pictures;
  options.picture.interrupt = options.preview.interrupt = &interrupt_flag();
  options.preview.paths_per_pixel = preview_paths;
  options.preview_s = cluster.display.preview_s;
  options.preview_asked = &preview_flag();
  options.patient = true;
  options.make_room = [&process] { process.make_room(); };
  return options;
}

/// Adds a worker to a controller that traces.
void add_tracer(const ClusterConfig& cluster, std::vector<NodeId>& nodes) {
  const NodeId controller = cluster.controller();
  if (!cluster.node(controller).traces || std::count(nodes.begin(), nodes.end(), controller) == 0)
    return;
  const auto tracer = find_node(cluster, tracer_of(cluster.node(controller).name));
  if (tracer && std::count(nodes.begin(), nodes.end(), *tracer) == 0) nodes.push_back(*tracer);
}

/// Logs of several hosts are read side by side, so lines get a time in UTC.
void tell_the_time() {
  spdlog::set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %^%l%$ %v", spdlog::pattern_time_type::utc);
}

/// Workers of states that `states` makes, which outlives them.
NodeWork work_of_states(StateMaker& states) {
  NodeWork work;
  work.worker = [&states](const RunSetup& run, const Machine& machine, const NodeSetup& node,
                          const std::function<bool()>& stop) {
    RunSetup of_states = run;
    of_states.states = &states;
    return run_worker(of_states, machine, node, stop);
  };
  return work;
}

/// Runs the nodes of a cluster whose file has a table [view].
Result<ExitCode> view_on_nodes(const ClusterConfig& cluster, ClusterProcessRun& process) {
  const LocalRun& base = process.local_run();
  const auto& scene = base.scene().description;
  const SceneAtTime scene_at = times_of_view(cluster.run.scene.string(), *scene);
  LiveStates states(scene, scene_at);
  NodeWork work = work_of_states(states);
  work.controller = [&](const RunSetup& run, const Machine& machine,
                        const NodeSetup& node) -> Result<StopReason> {
    auto started = NodeExecutor::start(run, machine, node);
    if (!started) return started.problem();
    HubOptions hub{{}, {}, cluster.view.save_folder.empty() ? "." : cluster.view.save_folder};
    hub.live.scene_at = scene_at;
    hub.live.judged = FrameScenes::of(*scene, cluster.run.scene, cluster.run.at_s);
    hub.live.seed = base.seed();
    hub.live.threads = default_threads();
    if (cluster.run.particles) hub.live.particles = static_cast<int64_t>(*cluster.run.particles);
    if (cluster.run.relative_error) hub.live.relative_error = *cluster.run.relative_error;
    const std::shared_ptr<NodeExecutor> executor = std::move(started).value();
    hub.live.executor = executor;
    hub.first.scenario = cluster.run.scenario;
    auto people = people_of_view(*scene, cluster.run.scene.string());
    if (!people) return people.problem();
    hub.people = std::move(people).value();
    HttpAddress server{cluster.view.address, cluster.view.port, ""};
    if (!cluster.view.allow_host.empty()) server.allowed_hosts = {cluster.view.allow_host};
    const auto served = serve_view(scene, server, hub, [&] { return executor->goes_on(); });
    if (!served) return served.problem();
    return StopReason::interrupted;
  };
  const auto ended = process.run(interrupt_flag(), work);
  if (!ended) return ended.problem();
  return ExitCode::success;
}

/// Whether anybody will still trace for whoever waits for workers. Any thread.
class WorkerWatch {
 public:
  WorkerWatch(const ClusterConfig& cluster, const NodeExecutor& executor)
      : cluster_(cluster), executor_(executor), without_since_(clock_.now()) {}

  Result<void> goes_on() {
    // The executor asks while it holds its own lock, so it is asked before this lock is taken.
    if (auto ok = executor_.goes_on(); !ok) return ok.problem();
    const NodeExecutor::Counters counters = executor_.counters();
    const std::lock_guard lock(mutex_);
    const Nanoseconds now = clock_.now();
    const Timeouts& patience = cluster_.timeouts;
    if (counters.stuck == 0)
      stuck_since_.reset();
    else if (!stuck_since_)
      stuck_since_ = now;
    else if (now - *stuck_since_ > patience.start)  // a capable worker may take this long to come
      return problem_in(cluster_.file,
                        "no worker can trace what is asked for; their logs say why: raise what "
                        "they lack, and start anew",
                        ProblemKind::no_room);
    if (counters.workers > 0) {
      any_ = true;
      without_since_.reset();
      return {};
    }
    if (!without_since_) without_since_ = now;  // there may have been no question for a while
    if (now - *without_since_ <= (any_ ? patience.lost : patience.start)) return {};
    return problem_in(cluster_.file,
                      any_ ? "all workers were lost: see to them and start anew"
                           : "no worker has come within 'start_s' of [timeouts]: start them",
                      ProblemKind::lost_peer);
  }

 private:
  const ClusterConfig& cluster_;
  const NodeExecutor& executor_;
  const SystemClock clock_;
  std::mutex mutex_;  // guards all members below
  std::optional<Nanoseconds> without_since_, stuck_since_;
  bool any_ = false;
};

/// What a cluster's file asks for in its table [assess]. Without a scene after every problem was
/// told: `told` is their kind.
AssessmentJob assessment_of(const ClusterConfig& cluster, const LocalRun& base, ProblemKind& told) {
  std::vector<double> times;
  if (cluster.run.at_s) times.push_back(*cluster.run.at_s);
  const AssessedStates states = assessed_states(cluster.run.scene.string(), times);
  told = states.told;
  AssessmentJob job;
  job.scene = states.last;
  job.scene_file = cluster.run.scene.string();
  job.times = states.times;
  job.folder = cluster.run.out;
  job.options.scenario = cluster.run.scenario;
  job.options.rules = cluster.assess.rules;
  job.options.deviations = cluster.assess.deviations;
  job.options.seed = base.seed();
  job.options.threads = default_threads();
  job.options.rounds = cluster.assess.rounds;
  job.options.smoke_factors = cluster.assess.smoke_scale;
  return job;
}

/// Runs the nodes of a cluster whose file has a table [assess].
Result<ExitCode> assess_on_nodes(const ClusterConfig& cluster, ClusterProcessRun& process) {
  const auto& scene = process.local_run().scene().description;
  RoundStates states(scene,
                     reader_of_times(cluster.run.scene.string(), *scene, FireFrames::nearest));
  ExitCode code = ExitCode::success;
  NodeWork work = work_of_states(states);
  work.controller = [&](const RunSetup& run, const Machine& machine,
                        const NodeSetup& node) -> Result<StopReason> {
    ProblemKind told = ProblemKind::bad_input;
    AssessmentJob job = assessment_of(cluster, process.local_run(), told);
    if (!job.scene) {
      code = exit_code_of(told);
      return StopReason::interrupted;
    }
    auto started = NodeExecutor::start(run, machine, node);
    if (!started) return started.problem();
    NodeExecutor& executor = *started.value();
    WorkerWatch watch(cluster, executor);
    RunInPieces pieces(executor, [&] { return watch.goes_on(); });
    job.options.executor = &pieces;
    const auto assessed = assess_into(job);
    if (!assessed) return assessed.problem();
    const auto ok = watch.goes_on();
    code = ok ? assessed.value() : exit_code_of(ok.problem().kind);
    return StopReason::particles;
  };
  const auto ended = process.run(interrupt_flag(), work);
  if (!ended) return ended.problem();
  return code;
}

PictureOptions pictures_of(const RenderChoice& render) {
  PictureOptions picture;
  picture.max_seconds = render.time_s.value_or(0);
  picture.target_error = render.error.value_or(0);
  limit_paths(render.paths, picture);
  picture.progressive = true;
  picture.gather = !render.full_paths;
  picture.raw = render.raw;
  picture.interrupt = &interrupt_flag();
  return picture;
}

/// Runs the nodes of a cluster whose file has a table [render].
Result<ExitCode> render_on_nodes(const ClusterConfig& cluster, ClusterProcessRun& process) {
  const LocalRun& base = process.local_run();
  const SceneDescription& scene = *base.scene().description;
  PictureOptions picture = pictures_of(cluster.render);
  if (auto ok = check_views(scene, cluster.render.view, picture); !ok) return ok.problem();
  if (scene.cameras.empty()) return problem_in(scene.file, "the scene has no [[camera]] to render");
  PictureStates states(base);
  ExitCode code = ExitCode::success;
  NodeWork work = work_of_states(states);
  work.controller = [&](const RunSetup& run, const Machine& machine,
                        const NodeSetup& node) -> Result<StopReason> {
    const auto scenario = find_scenario(scene, cluster.run.scenario);
    if (!scenario) return scenario.problem();
    if (const auto refused =
            refused_by_inspection(base.scene().description, {scenario.value()}, default_threads()))
      return problem_in(scene.file, "the scene has errors, told above", *refused);
    const auto out = OutputFolder::claim(cluster.run.out, plan_of_views(scene));
    if (!out) return out.problem();
    LocalRun finished(base.shared_scene(), base.seed(), default_threads());
    if (auto ok = load_flux(out->path() / "flux.lux", finished); !ok) return ok.problem();
    auto started = NodeExecutor::start(run, machine, node);
    if (!started) return started.problem();
    WorkerWatch watch(cluster, *started.value());
    picture.executor = started.value().get();
    picture.gives_up = [&] { return !watch.goes_on(); };
    const auto rendered = render_aloud(out->path(), finished, cluster.render.view, picture);
    if (!rendered) return rendered.problem();
    if (auto ok = watch.goes_on(); !ok) return ok.problem();
    code = rendered.value();
    return StopReason::particles;
  };
  const auto ended = process.run(interrupt_flag(), work);
  if (!ended) return ended.problem();
  return code;
}

/// The nodes with these names. Errors: an unknown name; nodes of several processes.
Result<std::vector<NodeId>> nodes_of(const ClusterConfig& cluster, const NodeOptions& options) {
  std::vector<NodeId> nodes;
  for (const std::string& name : options.names) {
    const auto node = find_node(cluster, name);
    if (!node) return problem_in(options.config, "there is no node \"" + name + "\"");
    if (!nodes.empty() && cluster.node(*node).process != cluster.node(nodes.front()).process)
      return problem_in(options.config, "\"" + name + "\" belongs to another process than \"" +
                                            options.names.front() + "\"");
    nodes.push_back(*node);
  }
  return nodes;
}

/// The exit code of a run that ended for this reason. Errors: workers or scene parts were lost.
Result<ExitCode> end_of_run(StopReason reason, const std::string& config, const LocalRun& run) {
  if (reason == StopReason::workers_lost)
    return problem_in(config,
                      "all workers were lost; what they had counted was written: go on with "
                      "luxodus run --resume, or see to the workers and start anew",
                      ProblemKind::lost_peer);
  if (reason == StopReason::objects_lost) {
    const auto lost = static_cast<int64_t>(run.missing().size());
    return problem_in(
        config,
        fmt::format("{} particles are lost: {} batches need scene parts that no node "
                    "who is left has, and the results, which were written, lean away from what "
                    "these would have met; start anew with nodes that store the scene, or go on "
                    "with luxodus run --resume",
                    lost * run.scene().batch_particles, lost),
        ProblemKind::lost_peer);
  }
  return reason == StopReason::interrupted ? ExitCode::interrupted : ExitCode::success;
}

/// Traces the run of a cluster and writes its results into `out` if they are written here.
Result<ExitCode> trace_on_nodes(const ClusterConfig& cluster, ClusterProcessRun& process,
                                const fs::path& out, const std::string& config) {
  std::optional<RunOutputFiles> output;
  if (process.shows()) {
    install_preview_handler();
    output.emplace(process.local_run(), output_options(cluster, process, out));
  }
  ProgressLine line(cluster.run.name);
  const auto ended = process.run(
      interrupt_flag(), [&](const Progress& p) { line.show(p); }, output ? &*output : nullptr);
  if (!ended) return ended.problem();
  for (const std::string& text : process.residency_lines()) log_info("{}", text);
  if (output && !output->result().is_null())
    std::printf("%s in %s\n%s", cluster.run.name.c_str(), out.string().c_str(),
                summary_text(output->result()).c_str());
  if (!ended.value()) return ExitCode::success;  // the controller is in another process
  process.forget_journal();
  return end_of_run(*ended.value(), config, process.local_run());
}

Result<ExitCode> run_nodes(const NodeOptions& options) {
  tell_the_time();
  const auto [read, told] = load_cluster(options.config);
  if (!read) return exit_code_of(told);
  const ClusterConfig& cluster = *read;
  spdlog::set_level(spdlog::level::from_str(cluster.observe.log_level));
  auto nodes = nodes_of(cluster, options);
  if (!nodes) return nodes.problem();
  add_tracer(cluster, nodes.value());
  auto prepared = ClusterProcessRun::prepare(cluster, nodes.value());
  if (!prepared) return prepared.problem();
  ClusterProcessRun& process = *prepared.value();
  const auto out = claim_results(cluster, process);
  if (!out) return out.problem();
  install_interrupt_handler();
  if (cluster.view.live) return view_on_nodes(cluster, process);
  if (cluster.assess.asked) return assess_on_nodes(cluster, process);
  if (cluster.render.asked) return render_on_nodes(cluster, process);
  return trace_on_nodes(cluster, process, out.value()->path(), options.config);
}

}  // namespace

Command node_command() {
  const auto o = std::make_shared<NodeOptions>();
  return {
      .name = "node",
      .summary = "Run nodes of a cluster on this machine",
      .heading = "Cluster",
      .options = {{"--config", &o->config, "Cluster file", {.form = Form::file, .required = true}},
                  {"--name",
                   &o->names,
                   "Name of a node of the process; may be repeated",
                   {.form = Form::name, .required = true}}},
      .notes =
          "One call for each process of the cluster, in any order, on any machine; all wait "
          "for each other.\n"
          "  luxodus node --config cluster.toml --name n3\n"
          "  luxodus node --config cluster.toml --name n0 --name n1     two in a process\n"
          "The process of the display, by default the controller's, writes the results. `luxodus "
          "cluster up` starts all "
          "that belong to this machine, `luxodus deploy` writes what starts them on many.",
      .run = [o] { return exit_code_of(run_nodes(*o)); }};
}

}  // namespace luxodus::cli
