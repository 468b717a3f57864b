// luxodus run: trace a scene, write everything that came of it.
#include <array>
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/commands.hpp"
#include "actors/cli/findings.hpp"
#include "actors/cli/finished_run.hpp"
#include "actors/cli/load_scene.hpp"
#include "actors/cli/progress_line.hpp"
#include "actors/cli/quantities.hpp"
#include "actors/cli/report_aloud.hpp"
#include "actors/cli/run_folder.hpp"
#include "actors/cli/run_options.hpp"
#include "actors/cli/signals.hpp"
#include "actors/display/checkpoint.hpp"
#include "actors/display/preview.hpp"
#include "actors/display/report.hpp"
#include "actors/output/file_names.hpp"
#include "actors/run/adaptive_shares.hpp"
#include "actors/run/flux_store.hpp"
#include "actors/supervise/in_process.hpp"
#include "actors/supervise/out_of_core_for.hpp"
#include "actors/supervise/residency_setup.hpp"
#include "runtime/core/log.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

/// Of a pixel in a preview: grainy, and there in seconds.
constexpr int preview_paths = 4;

/// Everything that a run leaves; returns result.json.
Result<Json> write_all(const RunFolder& out, const LocalRun& run, const RunRecord& record,
                       const RunOptions& options) {
  const fs::path& folder = out.path();
  out.room->release();
  if (auto ok = save_flux(folder / "flux.lux", run); !ok) return ok.problem();
  auto result = write_report_aloud(folder, run, record);
  const bool pictures = !options.no_views && !run.scene().description->cameras.empty();
  if (!result || !pictures || record.stopped_by == "interrupted") return result;
  ProgressLine line("pictures");
  PictureOptions picture;
  picture.paths_per_pixel = options.picture_paths;
  picture.raw = options.raw;
  picture.interrupt = &interrupt_flag();
  const auto drawn =
      render_views(folder, run, "", picture, [&](double share) { line.show_share(share); });
  if (!drawn) return drawn.problem();
  return result;
}

Result<NodesOptions> nodes_options(const RunOptions& options, Nanoseconds link_delay,
                                   Observation* observation) {
  NodesOptions nodes;
  if (options.profile == "0") {
    nodes.profile_share = 0;
  } else if (auto share = parse_share(options.profile); share) {
    nodes.profile_share = share.value();
  } else {
    return Problem{
        {}, "--profile \"" + options.profile + "\" is no share: write 1% or 0.01, or 0 for none"};
  }
  nodes.nodes = options.nodes;
  nodes.fibers = options.fibers;
  nodes.object_bytes = options.part_cache_bytes();
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
  if (!delay) return delay.problem();
  if (options.nodes == 0) return run.run(rule, interrupt_flag(), show);
  ObserveOptions observe;
  observe.metrics_port = options.metrics_port;
  observe.trace_every = options.trace_every;
  auto seen = Observation::start(observe);
  if (!seen) return seen.problem();
  const auto port = seen.value()->port();
  if (port) log_info("metrics at http://{}:{}/metrics", observe.address, *port);
  Observation* const watched = seen.value()->watches() ? seen.value().get() : nullptr;
  const auto nodes = nodes_options(options, delay.value(), watched);
  if (!nodes) return nodes.problem();
  NodesReport report;
  auto reason = run_on_nodes(run, nodes.value(), rule, interrupt_flag(), show, &report);
  if (!reason) return reason;
  line.reset();
  if (report.residency && !options.json)
    for (const std::string& text : residency_table(*report.residency, report.by_node))
      std::printf("%s\n", text.c_str());
  if (auto ok = seen.value()->write_trace(folder / "trace.json"); !ok) return ok.problem();
  return reason;
}

/// What shows the run while it goes on; null where nobody asks.
Result<std::unique_ptr<Preview>> preview_of(LocalRun& run, const fs::path& folder,
                                            const RunOptions& options) {
  if (options.preview.empty()) return std::unique_ptr<Preview>();
  const auto every = parse_seconds(options.preview);
  if (!every) return every.problem();
  install_preview_handler();
  PictureOptions picture;
  picture.paths_per_pixel = preview_paths;
  picture.interrupt = &interrupt_flag();
  return std::make_unique<Preview>(folder, run, every.value(), preview_flag(), picture);
}

/// With a budget for scene parts, nothing else is to hold geometry either.
std::unique_ptr<LocalRun> prepare(std::shared_ptr<const CompiledScene> scene, uint64_t seed,
                                  const RunOptions& options) {
  if (options.nodes == 0 || options.part_cache_mib == 0)
    return std::make_unique<LocalRun>(std::move(scene), seed, options.threads);
  OutOfCoreConfig config;
  config.threads = options.threads;
  // The nodes have ended by then, and left room for as much again.
  config.object_bytes =
      options.part_cache_bytes() * static_cast<size_t>(std::max(options.threads, options.nodes));
  config.sharing = !options.no_sharing;
  auto rows = std::make_unique<OutOfCoreParallelFor>(scene, config);
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
    if (!preview) return preview.problem();
    watchers.preview_ = std::move(preview).value();
    if (options.checkpoint == "0") return watchers;
    const auto every = parse_seconds(options.checkpoint);
    if (!every) return every.problem();
    if (every.value() < 1)
      return problem("--checkpoint " + options.checkpoint + ": write 1s or more, or 0 for none");
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
    if (!before) return before.problem();
    return before->batch_shares;
  }
  if (!options.adaptive) return std::vector<double>();
  ProgressLine line(scene->scenario.name + ", first round");
  return find_adaptive_shares(scene, seed, options.threads, interrupt_flag(),
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
  if (!scene) return scene.problem();
  for (const Problem& w : scene.value()->warnings) warn(w);
  PreparedScenario prepared{scenario, scene.value(), std::nullopt};
  if (options.plan) return prepared;
  // Of several scenarios the later ones may not have been begun when the run was stopped.
  const bool begun = options.scenario != "all" || fs::exists(folder / "flux.lux");
  auto claimed =
      claim_run_folder(folder, *scene.value(),
                       {rule, options.resume && begun, options.overwrite, !options.no_views});
  if (!claimed) return claimed.problem();
  prepared.folder = std::move(claimed).value();
  return prepared;
}

/// With the shares of its batches where these are allocated adaptively.
Result<std::shared_ptr<const CompiledScene>> scene_to_trace(
    const std::shared_ptr<const SceneDescription>& description, const PreparedScenario& prepared,
    uint64_t seed, const RunOptions& options) {
  auto scene = prepared.scene ? Result(prepared.scene)
                              : compile_scene(description, prepared.scenario,
                                              {options.cells, options.error_of});
  if (!scene) return scene;
  const bool goes_on = prepared.folder && prepared.folder->goes_on;
  const auto shares =
      batch_shares(scene.value(), seed, prepared.folder ? prepared.folder->path() : fs::path(),
                   goes_on, options);
  if (!shares) return shares.problem();
  if (shares->empty()) return scene;
  return compile_scene(description, prepared.scenario,
                       {options.cells, options.error_of, shares.value()});
}

Result<Traced> print_plan(const LocalRun& run, const Scenario& scenario,
                          const RunOptions& options) {
  const auto nodes = nodes_options(options, 0, nullptr);
  if (!nodes) return nodes.problem();
  auto plan = plan_on_nodes(run, nodes.value());
  if (!plan) return plan.problem();
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
  if (!scene) return scene.problem();
  const auto made = prepare(scene.value(), seed, options);
  LocalRun& run = *made;
  if (options.plan) return print_plan(run, scenario, options);
  const RunFolder& folder = *prepared.folder;
  if (folder.goes_on) {
    if (auto ok = load_flux(folder.path() / "flux.lux", run); !ok) return ok.problem();
    // A flux file holds no time: the result beside it does, if it is of the same batches.
    const auto before = read_finished_run(folder.path());
    if (before && before->batches == run.traced() && before->seconds)
      run.add_earlier_seconds(*before->seconds);
  }
  RunRecord record;
  record.scene_file = fs::absolute(options.scene).string();
  record.at_s = time_asked(options.at);
  record.cells = options.cells;
  record.stop = rule;
  auto watchers = Watchers::start(run, folder, record, options);
  if (!watchers) return watchers.problem();
  auto reason = trace(run, scenario, folder.path(), options, rule);
  { const Watchers ended = std::move(watchers).value(); }
  if (!reason) return reason.problem();
  if (reason.value() == StopReason::interrupted && run.particles() <= folder.keep_particles) {
    log_warning("{} keeps the run of {} particles that it held: this one had {}",
                folder.output.named().string(),
                short_number(static_cast<double>(folder.keep_particles)),
                short_number(static_cast<double>(run.particles())));
    return Traced{StopReason::interrupted, {}};
  }
  record.stopped_by = name_of(reason.value());
  auto result = write_all(folder, run, record, options);
  if (!result) return result.problem();
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
    if (!prepared) return prepared.problem();
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
  if (!prepared) {
    tell(prepared.problem());
    return ExitCode::bad_input;
  }
  for (PreparedScenario& one : prepared.value()) {
    auto traced = run_scenario(description, one, options, rule);
    if (!traced) {
      tell(traced.problem());
      return ExitCode::bad_input;
    }
    one.folder.reset();
    if (!traced->result.is_null()) results.push_back(std::move(traced.value().result));
    if (traced.value().reason == StopReason::interrupted) {
      log_warning("interrupted; what there is was written; go on with --resume");
      return ExitCode::interrupted;
    }
  }
  return ExitCode::success;
}

int run_scene(const RunOptions& options) {
  if (auto ok = fit_together(options); !ok) return exit_code_of(ok);
  auto rule = stop_rule(options);
  if (!rule) {
    tell(rule.problem());
    return ExitCode::bad_input;
  }
  const auto description =
      load_scene(options.scene, ReadingWarnings::left_to_inspection, time_asked(options.at));
  if (!description) return ExitCode::bad_input;
  auto scenarios = chosen_scenarios(*description, options.scenario);
  if (!scenarios) {
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

}  // namespace

Command run_command() {
  const auto o = std::make_shared<RunOptions>();
  return {.name = "run",
          .summary = "Trace a scene and write flux, illuminance, signs and pictures",
          .heading = "Results",
          .options = options_of(*o),
          .notes = run_notes(),
          .run = [o] { return run_scene(*o); }};
}

}  // namespace luxodus::cli
