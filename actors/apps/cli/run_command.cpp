// luxodus run: traces a scene, and writes all results.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/finished_run.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/run_folder.hpp"
#include "actors/apps/cli/run_options.hpp"
#include "actors/apps/cli/run_output_files.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/cast/node/residency_setup.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/cast/process/out_of_core_for.hpp"
#include "actors/results/files/checkpoint.hpp"
#include "actors/results/files/run_results.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/pictures/preview.hpp"
#include "actors/results/run/adaptive_shares.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/log.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

/// Paths of a pixel in a preview: grainy, and done in seconds.
constexpr int preview_paths = 4;

Result<NodesOptions> nodes_options(const RunOptions& options, Nanoseconds link_delay,
                                   Observation* observation, RunOutput* output) {
  NodesOptions nodes;
  if (options.profile == "0") {
    nodes.profile_share = 0;
  } else if (auto share = parse_share(options.profile); share) {
    nodes.profile_share = share.value();
  } else {
    return problem("--profile \"" + options.profile +
                   "\" is no share: write 1% or 0.01, or 0 for none");
  }
  nodes.nodes = options.nodes;
  nodes.fibers = options.fibers;
  nodes.object_bytes = options.part_cache_bytes();
  if (options.tally_mib > 0)
    nodes.tally_bytes = static_cast<uint64_t>(options.tally_mib * 1024 * 1024);
  nodes.tally_shards = options.tally_shards;
  nodes.fan_out = options.fan_out;
  nodes.sharing = !options.no_sharing;
  nodes.prefetch = options.prefetch;
  nodes.link_delay = link_delay;
  nodes.observation = observation;
  nodes.display = output;
  return nodes;
}

/// Traces with the plain loop, or on nodes, which then display the run and write its results.
Result<StopReason> trace(LocalRun& run, const Scenario& scenario, const fs::path& folder,
                         const RunOptions& options, const StopRule& rule, RunOutput& output) {
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
  const auto nodes = nodes_options(options, delay.value(), watched, &output);
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

/// Options for displaying and writing the run. Errors: invalid time spans.
Result<RunOutputOptions> output_options(const RunFolder& folder, const RunRecord& record,
                                        const RunOptions& options) {
  RunOutputOptions output;
  output.folder = folder.path();
  output.record = record;
  output.keep_particles = folder.keep_particles;
  output.make_room = [room = folder.room.get()] { room->release(); };
  output.pictures = !options.no_views;
  if (auto ok = read_choices(options.picture, output.picture); !ok) return ok.problem();
  output.picture.progressive = true;
  output.picture.raw = options.raw;
  output.preview.paths_per_pixel = preview_paths;
  output.preview.human = output.picture.human;
  output.picture.interrupt = output.preview.interrupt = &interrupt_flag();
  if (!options.preview.empty()) {
    const auto every = parse_seconds(options.preview);
    if (!every) return every.problem();
    output.preview_s = every.value();
    output.preview_asked = &preview_flag();
    install_preview_handler();
  }
  if (options.checkpoint == "0") return output;
  const auto every = parse_seconds(options.checkpoint);
  if (!every) return every.problem();
  if (every.value() < 1)
    return problem("--checkpoint " + options.checkpoint + ": write 1s or more, or 0 for none");
  output.checkpoint_s = every.value();
  return output;
}

/// With a memory budget for scene parts, geometry must not be held elsewhere either.
std::unique_ptr<LocalRun> prepare(std::shared_ptr<const CompiledScene> scene, uint64_t seed,
                                  const RunOptions& options) {
  if (options.nodes == 0 || options.part_cache_mib == 0)
    return std::make_unique<LocalRun>(std::move(scene), seed, options.threads);
  OutOfCoreConfig config;
  config.threads = options.threads;
  // The nodes have ended by then, and have freed this memory.
  config.object_bytes =
      options.part_cache_bytes() * static_cast<size_t>(std::max(options.threads, options.nodes));
  config.sharing = !options.no_sharing;
  auto rows = std::make_unique<OutOfCoreParallelFor>(scene, config);
  return std::make_unique<LocalRun>(std::move(scene), seed, options.threads, std::move(rows));
}

/// Previews and checkpoints of a run of the plain loop in progress.
struct Watchers {
  Watchers(LocalRun& run, const RunOutputOptions& options) {
    if (options.preview_asked != nullptr)
      preview.emplace(options.folder, run, options.preview_s, *options.preview_asked,
                      options.preview);
    if (options.checkpoint_s > 0)
      checkpoint.emplace(options.folder, run, options.record, options.checkpoint_s,
                         options.keep_particles);
  }
  std::optional<Preview> preview;
  std::optional<Checkpoint> checkpoint;
};

struct Traced {
  StopReason reason;
  Json result;  // null if the folder keeps a longer run
};

/// One scenario, and the folder that is locked for it.
struct PreparedScenario {
  Scenario scenario;
  std::shared_ptr<const CompiledScene> scene;  // with several scenarios, compiled when its turn
                                               // comes
  std::optional<RunFolder> folder;             // none if nothing is to be written
};

/// Checks that the scenario can be computed and written, before anything is traced.
Result<PreparedScenario> prepare_scenario(
    const std::shared_ptr<const SceneDescription>& description, const Scenario& scenario,
    const fs::path& folder, const RunOptions& options, const StopRule& rule) {
  auto scene = compile_scene(description, scenario, {options.cells, options.error_of});
  if (!scene) return scene.problem();
  for (const Problem& w : scene.value()->warnings) warn(w);
  PictureOptions picture;
  if (auto ok = read_choices(options.picture, picture); !ok) return ok.problem();
  if (auto ok = check_views(*description, "", picture); !ok && !options.no_views)
    return ok.problem();
  PreparedScenario prepared{scenario, scene.value(), std::nullopt};
  if (options.plan) return prepared;
  // With several scenarios, the later ones may not have begun when the run was stopped.
  const bool begun = options.scenario != "all" || fs::exists(folder / "flux.lux");
  auto claimed =
      claim_run_folder(folder, *scene.value(),
                       {rule, options.resume && begun, options.overwrite, !options.no_views});
  if (!claimed) return claimed.problem();
  prepared.folder = std::move(claimed).value();
  return prepared;
}

/// The scene with the shares of its batches if these are allocated adaptively: those of the resumed
/// run, or found by a first round.
Result<std::shared_ptr<const CompiledScene>> scene_to_trace(
    const std::shared_ptr<const SceneDescription>& description, const PreparedScenario& prepared,
    uint64_t seed, const RunOptions& options) {
  CompileOptions compile{options.cells, options.error_of};
  auto scene = prepared.scene ? Result(prepared.scene)
                              : compile_scene(description, prepared.scenario, compile);
  if (!scene) return scene;
  const fs::path folder = prepared.folder ? prepared.folder->path() : fs::path();
  if (prepared.folder && prepared.folder->goes_on && fs::exists(folder / "result.json")) {
    const auto before = read_finished_run(folder);
    if (!before) return before.problem();
    if (before->batch_shares.empty()) return scene;
    compile.batch_shares = before->batch_shares;
    return compile_scene(description, prepared.scenario, compile);
  }
  if (!options.adaptive) return scene;
  ProgressLine line(scene.value()->scenario.name + ", first round");
  return dealt_adaptively(scene.value(), compile, seed, options.threads, interrupt_flag(),
                          [&](const Progress& p) { line.show(p); });
}

Result<Traced> print_plan(const LocalRun& run, const Scenario& scenario,
                          const RunOptions& options) {
  RunOutputFiles output(run, RunOutputOptions());
  const auto nodes = nodes_options(options, 0, nullptr, &output);
  if (!nodes) return nodes.problem();
  auto plan = plan_on_nodes(run, nodes.value());
  if (!plan) return plan.problem();
  std::printf("%s\n%s", scenario.name.c_str(), plan.value().c_str());
  return Traced{StopReason::particles, {}};
}

/// Runs one scenario into one folder.
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
    // A flux file holds no time: the result beside it does, if it describes the same batches.
    const auto before = read_finished_run(folder.path());
    if (before && before->batches == run.traced() && before->seconds)
      run.add_earlier_seconds(*before->seconds);
  }
  RunRecord record;
  record.scene_file = fs::absolute(options.scene).string();
  record.at_s = time_asked(options.at);
  record.cells = options.cells;
  record.stop = rule;
  auto shown = output_options(folder, record, options);
  if (!shown) return shown.problem();
  RunOutputFiles output(run, shown.value());
  std::optional<Watchers> watchers;
  if (options.nodes == 0) watchers.emplace(run, shown.value());
  auto reason = trace(run, scenario, folder.path(), options, rule, output);
  watchers.reset();
  if (!reason) return reason.problem();
  if (reason.value() == StopReason::interrupted && run.particles() <= folder.keep_particles) {
    log_warning("{} keeps the run of {} particles that it held: this one had {}",
                folder.output.named().string(),
                short_number(static_cast<double>(folder.keep_particles)),
                short_number(static_cast<double>(run.particles())));
    return Traced{StopReason::interrupted, {}};
  }
  if (reason.value() == StopReason::time && run.particles() == 0)
    return problem(
        fmt::format("the time was up before one batch of {} particles was traced: give "
                    "more time (--time), or smaller batches (batch_particles of [run])",
                    run.scene().batch_particles));
  if (options.nodes == 0) {
    if (auto ok = output.keep_flux(run, reason.value()); !ok) return ok.problem();
    if (auto ok = output.write_results(run, reason.value()); !ok) return ok.problem();
  }
  if (!options.json) {
    std::printf("%s, in %s\n%s", description->name.c_str(), folder.output.named().string().c_str(),
                summary_text(output.result(), options.verbose).c_str());
  }
  // Pictures may have been interrupted; the traced flux is written.
  if (interrupt_flag()) reason = StopReason::interrupted;
  return Traced{reason.value(), output.result()};
}

/// The folders of all scenarios are claimed before the first begins, so that a folder that cannot
/// be written is reported at once, not hours later.
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

/// The scenarios one after another, their results appended to `results`.
Result<ExitCode> run_scenarios(const std::shared_ptr<const SceneDescription>& description,
                               const std::vector<Scenario>& scenarios, const RunOptions& options,
                               const StopRule& rule, Json& results) {
  auto prepared = prepare_scenarios(description, scenarios, options, rule);
  if (!prepared) return prepared.problem();
  for (PreparedScenario& one : prepared.value()) {
    auto traced = run_scenario(description, one, options, rule);
    if (!traced) return traced.problem();
    one.folder.reset();
    if (!traced->result.is_null()) results.push_back(std::move(traced.value().result));
    if (traced.value().reason == StopReason::interrupted) {
      log_warning("interrupted; what there is was written; go on with --resume");
      return ExitCode::interrupted;
    }
  }
  return ExitCode::success;
}

Result<ExitCode> run_scene(const RunOptions& options) {
  if (auto ok = fit_together(options); !ok) return ok.problem();
  auto rule = stop_rule(options);
  if (!rule) return rule.problem();
  const auto [description, told] =
      load_scene(options.scene, ReadingWarnings::left_to_inspection, time_asked(options.at));
  if (!description) return exit_code_of(told);
  auto scenarios = chosen_scenarios(*description, options.scenario);
  if (!scenarios) return scenarios.problem();
  if (const auto refused = refused_by_inspection(description, scenarios.value(), options.threads))
    return exit_code_of(*refused);
  install_interrupt_handler();
  Json results = Json::array();
  auto ended = run_scenarios(description, scenarios.value(), options, rule.value(), results);
  if (options.plan) return ended;
  if (options.json && options.scenario == "all")
    std::fputs(json_text(results).c_str(), stdout);
  else if (options.json && !results.empty())
    std::fputs(json_text(results.front()).c_str(), stdout);
  return ended;
}

}  // namespace

Command run_command() {
  const auto o = std::make_shared<RunOptions>();
  return {.name = "run",
          .summary = "Trace a scene and write flux, illuminance, signs and pictures",
          .heading = "Results",
          .options = options_of(*o),
          .notes = run_notes(),
          .run = [o] { return exit_code_of(run_scene(*o)); }};
}

}  // namespace luxodus::cli
