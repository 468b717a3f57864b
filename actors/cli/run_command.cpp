// luxodus run: trace a scene, write everything that came of it.
#include <spdlog/spdlog.h>

#include <array>
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/findings.hpp"
#include "actors/cli/finished_run.hpp"
#include "actors/cli/run_folder.hpp"
#include "actors/display/checkpoint.hpp"
#include "actors/display/preview.hpp"
#include "actors/display/report.hpp"
#include "actors/source/flux_store.hpp"
#include "actors/source/need.hpp"
#include "actors/supervise/in_process.hpp"
#include "actors/supervise/residency_setup.hpp"
#include "actors/supervise/stored_rows.hpp"
#include "scenes/format/file_names.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string scene;
  std::string out;
  std::string scenario;
  std::string particles, error, time;
  std::vector<std::string> error_of;
  std::string preview;
  std::optional<uint64_t> seed;
  int threads = default_threads();
  int cells = 1;
  int nodes = 0;  // 0: the plain loop
  size_t fibers = 1;
  double object_mib = 0;
  double tally_mib = 0;
  int tally_shards = 1;
  std::string profile = "1%";
  bool no_sharing = false;
  size_t prefetch = 0;
  std::string link_delay;
  std::optional<uint16_t> metrics_port;
  uint64_t trace_every = 0;
  bool plan = false;
  std::string checkpoint = "5m";
  bool resume = false;
  bool overwrite = false;
  bool by_need = false;
  bool no_views = false;
  bool json = false;
  bool verbose = false;
  int picture_paths = 32;

  size_t object_bytes() const { return static_cast<size_t>(object_mib * 1024 * 1024); }
};

constexpr int64_t default_particles = 4'000'000;
/// Of a pixel in a preview: grainy, and there in seconds.
constexpr int preview_paths = 4;

Result<StopRule> stop_rule(const RunOptions& o) {
  StopRule rule;
  if (!o.particles.empty()) {
    auto n = parse_count(o.particles);
    if (!n.ok()) return n.problem();
    rule.particles = n.value();
  }
  if (!o.error.empty()) {
    auto e = parse_share(o.error);
    if (!e.ok()) return e.problem();
    rule.relative_error = e.value();
  }
  if (!o.time.empty()) {
    auto t = parse_seconds(o.time);
    if (!t.ok()) return t.problem();
    rule.seconds = t.value();
  }
  if (!rule.particles && !rule.relative_error && !rule.seconds) rule.particles = default_particles;
  return rule;
}

/// Errors: no span of time, longer than links can bear, or no links.
Result<Nanoseconds> link_delay_of(const RunOptions& options) {
  if (options.link_delay.empty()) return Nanoseconds{0};
  auto delay_s = parse_seconds(options.link_delay);
  if (!delay_s.ok()) return delay_s.problem();
  if (options.nodes == 0) return Problem{{}, "--link-delay requires --nodes"};
  const double most_s = static_cast<double>(limits::link_delay) * 1e-9;
  if (delay_s.value() > most_s)
    return Problem{{}, "a link's delay must not be longer than 100 ms: beats count time"};
  return static_cast<Nanoseconds>(delay_s.value() * 1e9);
}

/// Everything that a run leaves; returns result.json.
Result<Json> write_all(const RunFolder& out, const LocalRun& run, const RunRecord& record,
                       const RunOptions& options) {
  const fs::path& folder = out.path();
  out.room->release();
  if (auto ok = save_flux(folder / "flux.lux", run); !ok.ok()) return ok.problem();
  auto result = write_report_aloud(folder, run, record);
  const bool pictures = !options.no_views && !run.scene().description->cameras.empty();
  if (!result.ok() || !pictures || record.stopped_by == "interrupted") return result;
  ProgressLine line("pictures");
  PictureOptions picture;
  picture.paths_per_pixel = options.picture_paths;
  picture.interrupt = &interrupt_flag();
  const auto drawn =
      render_views(folder, run, "", picture, [&](double share) { line.show_share(share); });
  if (!drawn.ok()) return drawn.problem();
  return result;
}

Result<NodesOptions> nodes_options(const RunOptions& options, Nanoseconds link_delay,
                                   Observation* observation) {
  NodesOptions nodes;
  if (options.profile == "0") {
    nodes.profile_share = 0;
  } else if (auto share = parse_share(options.profile); share.ok()) {
    nodes.profile_share = share.value();
  } else {
    return Problem{
        {}, "--profile \"" + options.profile + "\" is no share: write 1% or 0.01, or 0 for none"};
  }
  nodes.nodes = options.nodes;
  nodes.fibers = options.fibers;
  nodes.object_bytes = options.object_bytes();
  if (options.tally_mib > 0)
    nodes.tally_bytes = static_cast<uint64_t>(options.tally_mib * 1024 * 1024);
  nodes.tally_shards = options.tally_shards;
  nodes.sharing = !options.no_sharing;
  nodes.prefetch = options.prefetch;
  nodes.link_delay = link_delay;
  nodes.observation = observation;
  return nodes;
}

/// Traces with the plain loop, or on nodes.
Result<StopReason> trace(LocalRun& run, const Scenario& scenario, const fs::path& folder,
                         const RunOptions& options, const StopRule& rule) {
  std::optional<ProgressLine> line(scenario.name);
  const auto show = [&](const Progress& p) { line->show(p); };
  const auto delay = link_delay_of(options);
  if (!delay.ok()) return delay.problem();
  if (options.nodes == 0) return run.run(rule, interrupt_flag(), show);
  ObserveOptions observe;
  observe.metrics_port = options.metrics_port;
  observe.trace_every = options.trace_every;
  auto seen = Observation::start(observe);
  if (!seen.ok()) return seen.problem();
  const auto port = seen.value()->port();
  if (port) spdlog::info("metrics at http://{}:{}/metrics", observe.address, *port);
  Observation* const watched = seen.value()->watches() ? seen.value().get() : nullptr;
  const auto nodes = nodes_options(options, delay.value(), watched);
  if (!nodes.ok()) return nodes.problem();
  NodesReport report;
  auto reason = run_on_nodes(run, nodes.value(), rule, interrupt_flag(), show, &report);
  if (!reason.ok()) return reason;
  line.reset();
  if (report.residency && !options.json)
    for (const std::string& text : residency_table(*report.residency, report.by_node))
      std::printf("%s\n", text.c_str());
  if (auto ok = seen.value()->write_trace(folder / "trace.json"); !ok.ok()) return ok.problem();
  return reason;
}

/// What shows the run while it goes on; null where nobody asks.
Result<std::unique_ptr<Preview>> preview_of(LocalRun& run, const fs::path& folder,
                                            const RunOptions& options) {
  if (options.preview.empty()) return std::unique_ptr<Preview>();
  const auto every = parse_seconds(options.preview);
  if (!every.ok()) return every.problem();
  install_preview_handler();
  PictureOptions picture;
  picture.paths_per_pixel = preview_paths;
  picture.interrupt = &interrupt_flag();
  return std::make_unique<Preview>(folder, run, every.value(), preview_flag(), picture);
}

/// With a budget for objects, nothing else is to hold geometry either.
std::unique_ptr<LocalRun> prepare(std::shared_ptr<const CompiledScene> scene, uint64_t seed,
                                  const RunOptions& options) {
  if (options.nodes == 0 || options.object_mib == 0)
    return std::make_unique<LocalRun>(std::move(scene), seed, options.threads);
  StoredRowsConfig config;
  config.threads = options.threads;
  // The nodes have ended by then, and left room for as much again.
  config.object_bytes =
      options.object_bytes() * static_cast<size_t>(std::max(options.threads, options.nodes));
  config.sharing = !options.no_sharing;
  auto rows = std::make_unique<StoredRows>(scene, config);
  return std::make_unique<LocalRun>(std::move(scene), seed, options.threads, std::move(rows));
}

/// What shows or saves the run while it goes on.
class Watchers {
 public:
  /// Errors: spans of time that are none.
  static Result<Watchers> start(LocalRun& run, const RunFolder& folder, const RunRecord& record,
                                const RunOptions& options) {
    Watchers watchers;
    auto preview = preview_of(run, folder.path(), options);
    if (!preview.ok()) return preview.problem();
    watchers.preview_ = std::move(preview).value();
    if (options.checkpoint == "0") return watchers;
    const auto every = parse_seconds(options.checkpoint);
    if (!every.ok()) return every.problem();
    if (every.value() < 1)
      return Problem{{},
                     "--checkpoint " + options.checkpoint + ": write 1s or more, or 0 for none"};
    watchers.checkpoint_ = std::make_unique<Checkpoint>(folder.path(), run, record, every.value(),
                                                        folder.keep_particles);
    return watchers;
  }

 private:
  std::unique_ptr<Preview> preview_;
  std::unique_ptr<Checkpoint> checkpoint_;
};

struct Traced {
  StopReason reason;
  Json result;  // null where the folder keeps a longer run
};

/// Of the run that is to go on, or found by a first round. Empty: dealt as usual.
Result<std::vector<double>> batch_shares(const std::shared_ptr<const CompiledScene>& scene,
                                         uint64_t seed, const fs::path& folder, bool goes_on,
                                         const RunOptions& options) {
  if (goes_on && fs::exists(folder / "result.json")) {
    auto before = read_finished_run(folder);
    if (!before.ok()) return before.problem();
    return before->batch_shares;
  }
  if (!options.by_need) return std::vector<double>();
  ProgressLine line(scene->scenario.name + ", first round");
  return find_shares_by_need(scene, seed, options.threads, interrupt_flag(),
                             [&](const Progress& p) { line.show(p); });
}

/// One scenario, and the folder that is held for it.
struct PreparedScenario {
  Scenario scenario;
  std::shared_ptr<const CompiledScene> scene;  // of several scenarios compiled when it is its turn
  std::optional<RunFolder> folder;             // none where nothing is to be written
};

/// Checks that the scenario can be computed and written, before anything is traced.
Result<PreparedScenario> prepare_scenario(
    const std::shared_ptr<const SceneDescription>& description, const Scenario& scenario,
    const fs::path& folder, const RunOptions& options, const StopRule& rule) {
  auto scene = compile_scene(description, scenario, {options.cells, options.error_of});
  if (!scene.ok()) return scene.problem();
  for (const Problem& w : scene.value()->warnings) spdlog::warn("{}", w.text());
  PreparedScenario prepared{scenario, scene.value(), std::nullopt};
  if (options.plan) return prepared;
  // Of several scenarios the later ones may not have been begun when the run was stopped.
  const bool begun = options.scenario != "all" || fs::exists(folder / "flux.lux");
  auto claimed =
      claim_run_folder(folder, *scene.value(),
                       {rule, options.resume && begun, options.overwrite, !options.no_views});
  if (!claimed.ok()) return claimed.problem();
  prepared.folder = std::move(claimed).value();
  return prepared;
}

/// With the shares of its batches where these are dealt by need.
Result<std::shared_ptr<const CompiledScene>> scene_to_trace(
    const std::shared_ptr<const SceneDescription>& description, const PreparedScenario& prepared,
    uint64_t seed, const RunOptions& options) {
  auto scene = prepared.scene ? Result(prepared.scene)
                              : compile_scene(description, prepared.scenario,
                                              {options.cells, options.error_of});
  if (!scene.ok()) return scene;
  const bool goes_on = prepared.folder && prepared.folder->goes_on;
  const auto shares =
      batch_shares(scene.value(), seed, prepared.folder ? prepared.folder->path() : fs::path(),
                   goes_on, options);
  if (!shares.ok()) return shares.problem();
  if (shares->empty()) return scene;
  return compile_scene(description, prepared.scenario,
                       {options.cells, options.error_of, shares.value()});
}

Result<Traced> print_plan(const LocalRun& run, const Scenario& scenario,
                          const RunOptions& options) {
  const auto nodes = nodes_options(options, 0, nullptr);
  if (!nodes.ok()) return nodes.problem();
  auto plan = plan_on_nodes(run, nodes.value());
  if (!plan.ok()) return plan.problem();
  std::printf("%s\n%s", scenario.name.c_str(), plan.value().c_str());
  return Traced{StopReason::particles, {}};
}

/// One scenario into one folder.
Result<Traced> run_scenario(const std::shared_ptr<const SceneDescription>& description,
                            const PreparedScenario& prepared, const RunOptions& options,
                            const StopRule& rule) {
  const Scenario& scenario = prepared.scenario;
  const uint64_t seed = options.seed.value_or(description->run.seed);
  const auto scene = scene_to_trace(description, prepared, seed, options);
  if (!scene.ok()) return scene.problem();
  const auto made = prepare(scene.value(), seed, options);
  LocalRun& run = *made;
  if (options.plan) return print_plan(run, scenario, options);
  const RunFolder& folder = *prepared.folder;
  if (folder.goes_on) {
    if (auto ok = load_flux(folder.path() / "flux.lux", run); !ok.ok()) return ok.problem();
    // A flux file holds no time: the result beside it does, if it is of the same batches.
    const auto before = read_finished_run(folder.path());
    if (before.ok() && before->batches == run.traced() && before->seconds)
      run.add_earlier_seconds(*before->seconds);
  }
  RunRecord record;
  record.scene_file = fs::absolute(options.scene).string();
  record.cells = options.cells;
  record.stop = rule;
  auto watchers = Watchers::start(run, folder, record, options);
  if (!watchers.ok()) return watchers.problem();
  auto reason = trace(run, scenario, folder.path(), options, rule);
  { const Watchers ended = std::move(watchers).value(); }
  if (!reason.ok()) return reason.problem();
  if (reason.value() == StopReason::interrupted && run.particles() <= folder.keep_particles) {
    spdlog::warn("{} keeps the run of {} particles that it held: this one had {}",
                 folder.output.named().string(),
                 short_number(static_cast<double>(folder.keep_particles)),
                 short_number(static_cast<double>(run.particles())));
    return Traced{StopReason::interrupted, {}};
  }
  record.stopped_by = name_of(reason.value());
  auto result = write_all(folder, run, record, options);
  if (!result.ok()) return result.problem();
  if (!options.json) {
    std::printf("%s, in %s\n%s", description->name.c_str(), folder.output.named().string().c_str(),
                summary_text(result.value(), options.verbose).c_str());
  }
  // Pictures may have been interrupted; what was traced is written.
  if (interrupt_flag()) reason = StopReason::interrupted;
  return Traced{reason.value(), std::move(result).value()};
}

/// Folders of all scenarios are held before the first begins: who waits for hours is not to learn
/// then that the second cannot be written.
Result<std::vector<PreparedScenario>> prepare_scenarios(
    const std::shared_ptr<const SceneDescription>& description,
    const std::vector<Scenario>& scenarios, const RunOptions& options, const StopRule& rule) {
  const fs::path out = options.out.empty()
                           ? fs::path("out") / file_name_of(fs::path(options.scene).stem().string())
                           : fs::path(options.out);
  const bool several = options.scenario == "all" && !description->scenarios.empty();
  std::vector<std::string> names;
  for (const Scenario& scenario : scenarios) names.push_back(scenario.name);
  names = file_names_of(names, std::array{""});
  std::vector<PreparedScenario> all;
  for (size_t i = 0; i < scenarios.size(); ++i) {
    const fs::path folder = several ? out / names[i] : out;
    auto prepared = prepare_scenario(description, scenarios[i], folder, options, rule);
    if (!prepared.ok()) return prepared.problem();
    all.push_back(std::move(prepared).value());
    if (scenarios.size() > 1) all.back().scene.reset();
  }
  return all;
}

/// The scenarios one after another, their results appended to `results`; an exit code.
int run_scenarios(const std::shared_ptr<const SceneDescription>& description,
                  const std::vector<Scenario>& scenarios, const RunOptions& options,
                  const StopRule& rule, Json& results) {
  auto prepared = prepare_scenarios(description, scenarios, options, rule);
  if (!prepared.ok()) {
    tell(prepared.problem());
    return ExitCode::bad_input;
  }
  for (PreparedScenario& one : prepared.value()) {
    auto traced = run_scenario(description, one, options, rule);
    if (!traced.ok()) {
      tell(traced.problem());
      return ExitCode::bad_input;
    }
    one.folder.reset();
    if (!traced->result.is_null()) results.push_back(std::move(traced.value().result));
    if (traced.value().reason == StopReason::interrupted) {
      spdlog::warn("interrupted; what there is was written; go on with --resume");
      return ExitCode::interrupted;
    }
  }
  return ExitCode::success;
}

int run_scene(const RunOptions& options) {
  if (options.nodes == 0 && (options.plan || options.metrics_port || options.trace_every != 0)) {
    tell({{}, "--plan, --metrics and --trace-every are about nodes: say how many, --nodes N"});
    return ExitCode::bad_input;
  }
  if (options.nodes == 0 && (options.tally_mib > 0 || options.tally_shards > 1)) {
    tell({{}, "--tally-mib and --tally-shards are about nodes: say how many, --nodes N"});
    return ExitCode::bad_input;
  }
  if (options.by_need && (options.object_mib > 0 || options.plan)) {
    tell({{},
          "--by-need traces a first round with all geometry at hand, not with --object-mib or "
          "--plan"});
    return ExitCode::bad_input;
  }
  auto rule = stop_rule(options);
  if (!rule.ok()) {
    tell(rule.problem());
    return ExitCode::bad_input;
  }
  const auto description = load_scene(options.scene);
  if (!description) return ExitCode::bad_input;
  auto scenarios = chosen_scenarios(*description, options.scenario);
  if (!scenarios.ok()) {
    tell(scenarios.problem());
    return ExitCode::bad_input;
  }
  if (!passes_inspection(description, scenarios.value(), options.threads))
    return ExitCode::bad_input;
  install_interrupt_handler();
  Json results = Json::array();
  const int code = run_scenarios(description, scenarios.value(), options, rule.value(), results);
  if (options.plan) return code;
  if (options.json && options.scenario == "all")
    std::fputs(json_text(results).c_str(), stdout);
  else if (options.json && !results.empty())
    std::fputs(json_text(results.front()).c_str(), stdout);
  return code;
}

void add_node_options(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  command
      .add_option("--nodes", options->nodes,
                  "trace on so many nodes, a thread each, linked as a minimum-path graph [0: the "
                  "plain loop]")
      ->check(CLI::Range(0, limits::nodes_in_process));
  command.add_option("--metrics", options->metrics_port,
                     "serve the nodes' numbers on this port of 127.0.0.1 while they run, for "
                     "`luxodus status` and Prometheus; 0: any that is free");
  command
      .add_option("--trace-every", options->trace_every,
                  "write what becomes of each N-th particle on the nodes into trace.json, for "
                  "ui.perfetto.dev [0: nothing]")
      ->check(CLI::Range(uint64_t{0}, uint64_t{1'000'000'000'000}));
  command.add_flag("--plan", options->plan,
                   "print what each of the nodes may take in memory, and trace nothing");
  command.add_option("--fibers", options->fibers, "photon-threads of a node [1]")
      ->check(CLI::Range(size_t{1}, size_t{16384}));
  command
      .add_option("--object-mib", options->object_mib,
                  "budget of a node for geometry cells, bricks of smoke data and tiles of "
                  "pictures; what does not fit is fetched from others "
                  "[0: everything is resident]")
      ->check(CLI::Range(0.0, 1048576.0));
  command
      .add_option("--tally-mib", options->tally_mib,
                  "budget of a node for scores, totals and flushes; a tally that is full flushes "
                  "[0: what all bins take]")
      ->check(CLI::Range(0.0, 1048576.0));
  command
      .add_option("--tally-shards", options->tally_shards,
                  "shares of the totals: one stays with the controller, the others are held by so "
                  "many of the nodes [1]")
      ->check(CLI::Range(1, limits::nodes_in_process + 1));
  command
      .add_option(
          "--prefetch", options->prefetch,
          "with --object-mib: cells that a ray enters next, asked for ahead of the one that is "
          "waited for [0]")
      ->check(CLI::Range(0, 64));
  command.add_flag("--no-sharing", options->no_sharing,
                   "with --object-mib: each node builds its own copy of what it needs, as if the "
                   "nodes were processes");
  command.add_option("--profile", options->profile,
                     "with --object-mib: share of the particles that is traced beforehand, to plan "
                     "which node traces, holds and keeps what; 0: none [1%]");
  command.add_option("--link-delay", options->link_delay,
                     "hold back what nodes send each other for so long on every link, to see what "
                     "a distance costs and how many fibers hide it, e.g. 1ms [0]");
}

void add_folder_options(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  command.add_option("--checkpoint", options->checkpoint,
                     "save flux.lux while the run goes on, so often: a run that is killed goes on "
                     "from there with --resume; 0: at the end only [5m]");
  auto* resume =
      command.add_flag("--resume", options->resume,
                       "go on from DIR's flux file; with --scenario all those not begun start");
  command
      .add_flag("--overwrite", options->overwrite,
                "replace files in DIR that no run has written, and a longer run of the same scene")
      ->excludes(resume);
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("run", "Trace a scene and write flux, lux, signs and pictures");
  command->footer(
      "Examples:\n"
      "  luxodus run scenes/library/empty_room.toml --out out/room --particles 10M\n"
      "  luxodus run scenes/library/office_floor.toml --scenario all --particles 4M\n"
      "  luxodus run scenes/library/empty_room.toml --error 1%\n"
      "  luxodus run scenes/library/office_floor.toml --error 2% "
      "--error-of \"plane corridor floor\"\n"
      "  luxodus run scene.toml --out out/x --time 60s     then: ... --time 60s --resume\n\n"
      "Stops at the first of --particles, --error and --time that holds (4M particles if none is "
      "given).\n"
      "The error is the worst relative standard error of plane means, probes and signs at the "
      "eye,\n"
      "or of what --error-of names, and paths go there: a sign that thick smoke hides from a far\n"
      "observer takes very long.\n"
      "Ctrl-C stops at a batch's end and writes what there is. Equal scene, seed, particles and "
      "cells give\n"
      "the same flux file, bit for bit, for any number of threads.\n\n"
      "DIR then holds result.json, flux.lux, planes/, views/, patches.vtp and volume.vti. A run "
      "there of\n"
      "the same scene is replaced by one that is as long or longer; by a shorter one, and files "
      "that no\n"
      "run has written, with --overwrite only. One process at a time writes into DIR.");
  command
      ->add_option("scene", options->scene,
                   "scene file (TOML; see scenes/format/README.md), or a pack")
      ->required();
  command->add_option("--out", options->out, "folder for the results [out/NAME]");
  command->add_option("--scenario", options->scenario, "name of a scenario, or 'all' [the first]");
  command->add_option("--particles", options->particles,
                      "how many, e.g. 1e6, 250k, 10M (whole batches)");
  command->add_option("--error", options->error, "relative standard error to reach, e.g. 1%");
  command->add_option(
      "--error-of", options->error_of,
      "what --error is of, the worst of all that are given: planes, probes, signs, "
      "surfaces, cells of planes and patches (95 % of them), \"plane NAME\", \"cells NAME\", "
      "\"probe NAME\", \"sign NAME\" [the scene's error_of, or planes, probes and signs]");
  command->add_flag(
      "--by-need", options->by_need,
      "deal particles to source groups ([run] groups: circuit or emitter) as planes, "
      "cells, surfaces or patches of --error-of need them, by a first round that is not "
      "kept");
  command->add_option("--time", options->time, "how long, e.g. 60s, 5m");
  command->add_option("--seed", options->seed, "of the random numbers [the scene's]")
      ->transform(seed_number());
  command->add_option("--threads", options->threads, "[all cores]")->check(CLI::Range(1, 1024));
  command->add_option("--cells", options->cells, "geometry cells; 1 is one merged scene [1]")
      ->check(CLI::Range(1, 1'000'000));
  add_node_options(*command, options);
  command
      ->add_option("--picture-paths", options->picture_paths, "paths per pixel of the views [32]")
      ->check(CLI::Range(1, 100'000));
  command->add_option("--preview", options->preview,
                      "pictures of the run while it goes on, into DIR/preview, so often: 60s; and "
                      "whenever the process gets SIGUSR1");
  add_folder_options(*command, options);
  command->add_flag("--no-views", options->no_views, "make no pictures");
  command->add_flag("--json", options->json,
                    "print result.json instead of a summary; an array of them with --scenario all");
  command->add_flag("--verbose", options->verbose,
                    "how it was computed, too: kernel, energy balance");
  command->callback([options, &exit_code] { exit_code = run_scene(*options); });
}

}  // namespace luxodus::cli
