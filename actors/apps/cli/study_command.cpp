// luxodus study: sweeps over graphs, delays, fibers and caches, and the costs they are charged by.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/lab/study/calibrate.hpp"
#include "actors/lab/study/runs.hpp"
#include "actors/lab/study/scenes.hpp"
#include "actors/lab/study/study_report.hpp"
#include "actors/results/formats/file_names.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct StudyCommandOptions {
  std::string file;
  std::string out;
  bool log = false;
};

struct CalibrateOptions {
  std::string scene, scenario;
  std::string out = "costs.toml";
  int cells = 64;
  int64_t lease_particles = 64;
  bool whole_tally = false;
};

/// A study with its scene and costs.
struct Prepared {
  Study study;
  MeasuredCosts measured;
  std::shared_ptr<const SceneDescription> scene;
};

ProblemKind tell_all(const Problems& problems) {
  for (const Problem& problem : problems.list()) tell(problem);
  return problems.empty() ? ProblemKind::bad_input : problems.kind();
}

/// None after every problem was told: `told` is their kind.
std::optional<Prepared> prepare_study(const std::string& file, ProblemKind& told) {
  ReadStudy read = read_study(file);
  told = tell_all(read.problems);
  for (const Problem& warning : read.warnings) warn(warning);
  if (!read.study) return std::nullopt;
  Prepared prepared{std::move(*read.study), {}, nullptr};
  if (!prepared.study.costs.empty()) {
    ReadCosts costs = read_costs(prepared.study.costs);
    told = tell_all(costs.problems);
    if (!costs.measured) return std::nullopt;
    prepared.measured = std::move(*costs.measured);
  }
  const LoadedScene loaded = load_scene(prepared.study.scene.string());
  told = loaded.told;
  prepared.scene = loaded.scene;
  if (!prepared.scene) return std::nullopt;
  return prepared;
}

/// Runs every point and seed, one after another, with a progress line.
class Sweep {
 public:
  /// `log`: show the log of nodes.
  Sweep(const Prepared& prepared, bool log)
      : log_(log),
        study_(prepared.study),
        scenes_(prepared.study, *prepared.scene),
        outcome_{prepared.study, prepared.measured, {}} {}

  /// Errors: a scene that cannot be compiled.
  Result<void> run();
  const StudyOutcome& outcome() const { return outcome_; }

 private:
  Result<StudyRow> run_one(const StudyPoint& point, uint64_t seed);
  Result<std::shared_ptr<const Recording>> recorded(const StudyRun& run);
  double weight(const StudyPoint& point) const;
  void show(double done);

  const bool log_;
  const Study& study_;
  StudyScenes scenes_;
  StudyOutcome outcome_;
  std::map<std::tuple<int64_t, uint64_t, int64_t>, std::shared_ptr<const Recording>> recordings_;
  const SystemClock clock_;
  Nanoseconds began_ = 0;
  size_t runs_ = 0;
  double all_ = 0;  // sum of the weights of all runs
  ProgressLine line_{"study"};
};

/// Roughly proportional to the time of a run: particles to trace, and nodes to simulate.
double Sweep::weight(const StudyPoint& point) const {
  return static_cast<double>(particles_of(study_, point)) + 100 * study_.number(point, "nodes");
}

void Sweep::show(double done) {
  const double passed = static_cast<double>(clock_.now() - began_) * 1e-9;
  const double left = done > 0 ? passed * (all_ - done) / done : 0;
  line_.put(fmt::format("{} of {} runs, {:.0f} s, about {:.0f} s left", outcome_.rows.size(), runs_,
                        passed, left),
            done >= all_);
}

Result<StudyRow> Sweep::run_one(const StudyPoint& point, uint64_t seed) {
  const auto scene = scenes_.get(static_cast<int>(study_.whole(point, "cells")),
                                 study_.whole(point, "lease_particles"));
  if (!scene) return scene.problem();
  StudyRun run{study_, point, scene.value(), seed, outcome_.measured.costs, nullptr};
  const bool real = is_real(study_.word(point, "on"));
  if (study_.word(point, "on") == "replay") {
    const auto recording = recorded(run);
    if (!recording) return recording.problem();
    run.recording = recording.value().get();
  }
  const auto level = spdlog::get_level();
  if (!log_) spdlog::set_level(spdlog::level::off);
  auto result = real ? run_real(run, interrupt_flag()) : run_simulated(run, interrupt_flag());
  spdlog::set_level(level);
  StudyRow row{point, seed, std::nullopt, ""};
  if (result)
    row.result = std::move(result).value();
  else
    row.refused = result.problem().what;
  return row;
}

/// Cached for other points: it depends only on partition and random numbers.
Result<std::shared_ptr<const Recording>> Sweep::recorded(const StudyRun& run) {
  const std::tuple key{study_.whole(run.point, "cells"), run.seed,
                       std::min(particles_of(study_, run.point), limits::recorded_particles)};
  auto& kept = recordings_[key];
  if (kept) return kept;
  auto made = Recording::make(*run.scene, run.seed, std::get<2>(key), run.costs);
  if (!made) return made.problem();
  kept = std::move(made).value();
  return kept;
}

Result<void> Sweep::run() {
  const auto points = study_.points();
  began_ = clock_.now();
  runs_ = points.size() * static_cast<size_t>(study_.seeds);
  for (const StudyPoint& point : points) all_ += weight(point) * study_.seeds;
  double done = 0;
  for (const StudyPoint& point : points) {
    for (int i = 0; i < study_.seeds; ++i) {
      auto row = run_one(point, study_.first_seed + static_cast<uint64_t>(i));
      if (interrupt_flag()) return {};
      if (!row) return row.problem();
      outcome_.rows.push_back(std::move(row).value());
      done += weight(point);
      show(done);
    }
  }
  return {};
}

void print_outcome(const StudyOutcome& outcome, const fs::path& out) {
  size_t refused = 0;
  for (const StudyRow& row : outcome.rows) refused += row.result ? 0 : 1;
  for (const StudyComparison& comparison : comparisons_of(outcome)) {
    std::printf("%s against %s\n", comparison.of.c_str(), comparison.against.c_str());
    for (const auto& error : comparison.errors())
      std::printf("  %-24s mean error %5.1f %%, largest %5.1f %%\n", error.column.c_str(),
                  100 * error.mean, 100 * error.most);
  }
  std::printf("%zu runs", outcome.rows.size());
  if (refused > 0) std::printf(", %zu of them without a result (the page says why)", refused);
  std::printf("; written to %s\n", out.string().c_str());
}

Result<ExitCode> study(const StudyCommandOptions& options) {
  if (options.file.empty())
    return problem("say which study: luxodus study FILE.toml, or luxodus study calibrate SCENE");
  ProblemKind told = ProblemKind::bad_input;
  const auto prepared = prepare_study(options.file, told);
  if (!prepared) return exit_code_of(told);
  const fs::path folder =
      options.out.empty() ? fs::path("out") / file_name_of(fs::path(options.file).stem().string())
                          : fs::path(options.out);
  const auto out = OutputFolder::claim(folder, study_output(prepared->study));
  if (!out) return out.problem();
  install_interrupt_handler();
  Sweep sweep(*prepared, options.log);
  const auto done = sweep.run();
  if (!done) return done.problem();
  if (interrupt_flag()) {
    log_warning("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  if (auto ok = write_study(out->path(), sweep.outcome()); !ok) return ok.problem();
  print_outcome(sweep.outcome(), folder);
  return ExitCode::success;
}

Result<void> write_costs(const CalibrateOptions& options) {
  if (auto ok = check_output_file(options.out); !ok) return ok.problem();
  const auto [description, told] = load_scene(options.scene);
  if (!description) return problem_in(options.scene, "the scene has problems, told above", told);
  Study study;
  study.scenario = options.scenario;
  study.whole_tally = options.whole_tally;
  StudyScenes scenes(study, *description);
  const auto scene = scenes.get(options.cells, options.lease_particles);
  if (!scene) return scene.problem();
  const auto report = [](const std::string& what) {
    std::fprintf(stderr, "measuring %s\n", what.c_str());
  };
  const auto measured = calibrate(*scene.value(), report);
  if (!measured) return measured.problem();
  const std::string text = costs_text(measured.value());
  if (auto ok = write_file_atomically(behind_links(options.out), text); !ok) return ok.problem();
  std::printf("%swritten to %s\n", text.c_str(), options.out.c_str());
  return {};
}

Command calibrate_command() {
  const auto o = std::make_shared<CalibrateOptions>();
  return {
      .name = "calibrate",
      .summary = "Measure on this machine what work costs, for simulations",
      .options = {{"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
                  {"--scenario",
                   &o->scenario,
                   "Name of a scenario",
                   {.form = Form::name, .otherwise = "the first"}},
                  {"--cells", &o->cells, "Number of geometry cells", {.range = Range{2, 100000}}},
                  {"--lease-particles",
                   &o->lease_particles,
                   "Number of particles of a batch",
                   {.range = Range{1, 1000000}}},
                  {"--whole-tally", &o->whole_tally,
                   "Bins as those of a study with tally = \"scene\""},
                  {"--out", &o->out, "File of costs", {.form = Form::file}}},
      .notes =
          "Costs of tracing are those of a scene and its partition; the rest is the "
          "machine's. Nothing else should run on the machine meanwhile: a few seconds.",
      .run = [o] { return exit_code_of(write_costs(*o)); }};
}

}  // namespace

Command study_command() {
  const auto o = std::make_shared<StudyCommandOptions>();
  return {.name = "study",
          .summary = "Vary graphs, delays, fibers, caches; write tables, plots and a page",
          .heading = "Study",
          .options = {{"file", &o->file, "Study file", {.form = Form::file}},
                      {"--out",
                       &o->out,
                       "Folder of the results",
                       {.form = Form::folder, .otherwise = "out/NAME"}},
                      {"--log", &o->log, "Log of the nodes"}},
          .notes =
              "A study is a TOML file: a scene, what is varied, what is drawn (its keys: "
              "`luxodus keys study`). Studies that ship, with their findings: "
              "tests/studies.\n"
              "  luxodus study tests/studies/fibers.toml --out out/fibers",
          .commands = {calibrate_command()},
          .run = [o] { return exit_code_of(study(*o)); }};
}

}  // namespace luxodus::cli
