// luxodus walk: follows people of trajectory files, and says which signs they read on their way.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "actors/apps/cli/assess_command.hpp"
#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/apps/cli/walk_figures.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/walk/walk_files.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"
#include "scenes/formats/scene_file/scene_people.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct WalkCommandOptions {
  std::string scene, out, trajectories;
  AssessOptions assess;
  std::string place = "known";
  WalkOptions walk;
  int nodes = 0;
  std::vector<std::string> at, figures;
};

/// The people of the scene, or those of the named file by the only [[people]] of the scene.
Result<std::vector<PeopleSettings>> people_asked(const WalkCommandOptions& o) {
  ReadPeople read = read_people_of_scene(o.scene);
  if (!read.problems.empty()) return read.problems.list().front();
  if (o.trajectories.empty()) {
    if (!read.people.empty()) return std::move(read.people);
    return problem_in(o.scene,
                      "nobody walks in this scene: state [[people]], or name a file by "
                      "--trajectories");
  }
  if (read.people.size() > 1)
    return problem_in(o.scene,
                      "--trajectories replaces the file of one [[people]], and this scene has "
                      "several");
  PeopleSettings one = read.people.empty() ? PeopleSettings() : std::move(read.people.front());
  if (one.name.empty()) one.name = fs::path(o.trajectories).stem().string();
  one.file = o.trajectories;
  return std::vector<PeopleSettings>{std::move(one)};
}

/// People of all groups, and what forms their files have.
struct AllPeople {
  std::vector<PlacedPerson> people;
  std::vector<std::string> forms;
};

Result<AllPeople> read_all_people(const std::vector<PeopleSettings>& groups,
                                  const SceneDescription& scene) {
  AllPeople out;
  for (const PeopleSettings& group : groups) {
    const WaitingLine waiting("reading " + group.file);
    const auto file = read_trajectories(group.file);
    if (!file) return file.problem();
    auto placed = place_people(group, file.value(), scene.assessment);
    if (!placed) return placed.problem();
    std::move(placed->begin(), placed->end(), std::back_inserter(out.people));
    out.forms.push_back(file->form);
  }
  return out;
}

/// Writes a scene with people as bodies for each time.
Result<void> write_figures(const fs::path& folder, const std::string& scene,
                           const std::vector<PlacedPerson>& people,
                           const std::vector<double>& times_s) {
  if (times_s.empty()) return {};
  std::error_code failed;
  fs::create_directories(folder / "figures", failed);
  if (failed) return system_problem(folder / "figures", "cannot make this folder", failed.value());
  for (const double time_s : times_s)
    if (auto ok = write_file_atomically(folder / figures_file(time_s),
                                        figures_scene(scene, people, time_s));
        !ok)
      return ok;
  return {};
}

/// Warns of signs about which nothing is known wherever people could look at them.
void warn_of_undecided(const SceneDescription& scene, const std::vector<SignSummary>& signs) {
  for (size_t i = 0; i < signs.size(); ++i) {
    const auto seconds = [&](SignAnswer answer) {
      return signs[i].by_answer_s[static_cast<size_t>(answer)];
    };
    const double decided_s =
        seconds(SignAnswer::read) + seconds(SignAnswer::seen) + seconds(SignAnswer::invisible);
    if (seconds(SignAnswer::undecided) == 0 || decided_s > 0) continue;
    warn(problem_in(scene.signs[i].place,
                    fmt::format("whether people read the sign \"{}\" is undecided wherever they "
                                "have it in view: luxodus assess says why, from an [[observer]]",
                                scene.signs[i].name)));
  }
}

void print_walk(const WalkOfScene& walk, const std::vector<PersonSummary>& people) {
  double all_s = 0, read_s = 0, undecided_s = 0, longest_s = 0;
  size_t never = 0;
  for (const PersonSummary& s : people) {
    read_s += s.read_s;
    undecided_s += s.undecided_s;
    all_s += s.read_s + s.undecided_s + s.unread_s;
    longest_s = std::max(longest_s, s.longest_unread_s);
    never += s.first_read_s ? 0 : 1;
  }
  std::printf("scenario %s: %zu people, %.0f person-seconds\n", walk.scenario.c_str(),
              people.size(), all_s);
  std::printf("%.2g %% of %zu steps cross walls or begin in solids\n", 100 * walk.walls.share(),
              walk.walls.steps);
  std::printf("with a sign that is read: %.1f %% of the time; undecided %.1f %%; without %.1f %%\n",
              100 * read_s / all_s, 100 * undecided_s / all_s,
              100 * (all_s - read_s - undecided_s) / all_s);
  std::printf("%zu people never read a sign; the longest time without is %.0f s\n", never,
              longest_s);
}

Result<ExitCode> walk(const WalkCommandOptions& o) {
  const auto groups = people_asked(o);
  if (!groups) return groups.problem();
  const AssessedStates states = assessed_states(o.scene, times_asked(o.at));
  const auto& scene = states.last;
  if (!scene) return exit_code_of(states.told);
  if (scene->packed)
    return problem_in(o.scene, "people walk in scene files: a pack does not hold all of them");
  auto people = read_all_people(groups.value(), *scene);
  if (!people) return people.problem();
  const auto scenario = judged_scenario(*scene, o.assess.scenario);
  if (!scenario) return scenario.problem();
  const std::vector<PlanLevel> levels = plan_levels(*scene, scenario.value());
  const fs::path folder =
      o.out.empty() ? fs::path("out") / file_name_of(scene->name + "-walked") : fs::path(o.out);
  OutputPlan plan{walk_files, {}};
  for (const char* what : {"map", "animation"})
    for (const std::string& file : level_files(what, levels.size())) plan.files.push_back(file);
  const std::vector<double> figures = times_asked(o.figures);
  if (!figures.empty()) plan.folders.push_back("figures");
  for (const double time_s : figures) plan.files.push_back(figures_file(time_s));
  const auto out = OutputFolder::claim(folder, plan);
  if (!out) return out.problem();
  install_interrupt_handler();
  const auto nodes = nodes_that_trace(o.nodes);
  WalkRequest request{
      .states = {scene, states.times, reader_at_times(*scene, o.scene, FireFrames::nearest)},
      .options = o.assess,
      .walk = o.walk,
      .people = std::move(people->people)};
  request.options.executor = nodes.get();
  request.options.place_unknown = o.place == "unknown";
  ProgressLine line("walk");
  const auto walked = walk_scene(
      request, interrupt_flag(),
      [&](const std::string& what, double share) { line.show_share(share, ", " + what); });
  if (!walked) {
    if (!interrupt_flag()) return walked.problem();
    log_warning("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  const WalkSummaries summaries =
      summaries_of(scene->signs.size(), walked->walks, request.walk.step_s);
  if (auto ok = write_walk(out->path(), {*scene, request.people, request.walk, walked.value(),
                                         summaries, levels, people->forms, build.version});
      !ok)
    return ok.problem();
  if (auto ok = write_figures(out->path(), o.scene, request.people, figures); !ok)
    return ok.problem();
  print_walk(walked.value(), summaries.people);
  warn_of_undecided(*scene, summaries.signs);
  std::printf("written to %s\n", out->named().string().c_str());
  return ExitCode::success;
}

/// Times at which people become bodies.
Option figures_option(std::vector<std::string>& figures) {
  Option out = times_option(figures);
  out.name = "--figures";
  out.meaning =
      "Times at which people are written as bodies, as scenes for pictures and films, e.g. "
      "30s,31s,32s";
  out.traits.otherwise.clear();
  return out;
}

}  // namespace

Command walk_command() {
  const auto o = std::make_shared<WalkCommandOptions>();
  o->assess.threads = default_threads();
  return {
      .name = "walk",
      .summary = "Follow people of evacuation programs: which signs they read on their way",
      .heading = "Assess",
      .options =
          {{"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
           {"--trajectories",
            &o->trajectories,
            "File of trajectories, instead of that of [[people]] in the scene",
            {.form = Form::file}},
           scenario_option(o->assess),
           times_option(o->at),
           {"--out",
            &o->out,
            "Folder of the results",
            {.form = Form::folder, .otherwise = "out/NAME-walked"}},
           {"--step",
            &o->walk.step_s,
            "Time between two looks of a person [s]",
            {.range = Range{0.05, 3600}}},
           {"--field-of-view",
            &o->walk.field_of_view_deg,
            "Angle in plan within which people look for signs, half of it on each side [deg]",
            {.range = Range{1, 360}}},
           {"--crowd-hides", &o->walk.crowd_hides, "People who hide signs from those behind them"},
           figures_option(o->figures),
           place_option(o->place),
           {"--seed", &o->assess.seed, "Seed of the random number generator"},
           threads_option(o->assess.threads),
           nodes_option(o->nodes),
           rounds_option(o->assess)},
      .notes =
          "Reads SQLite and HDF5 of JuPedSim, text of PeTrack, CSV and JSON of Pathfinder. Signs "
          "count that belong on the way (routes of the scene; all signs where it has none). Writes "
          "people.csv, signs.csv, steps.csv, curve.csv, curve.svg, walk.json, maps of where people "
          "stood without a sign that they read, and animations of them; with --figures scenes in "
          "which people stand as bodies. It says nothing of heat, gases or the time that is "
          "available for escape.\n"
          "  luxodus walk office.toml --trajectories jupedsim.sqlite --out out/walk\n"
          "  luxodus walk office.toml --crowd-hides --step 0.5\n"
          "  luxodus walk office.toml --figures 30s --out out/walk\n"
          "  luxodus run out/walk/figures/30s.toml --at 30s --out out/picture",
      .run = [o] { return exit_code_of(walk(*o)); }};
}

}  // namespace luxodus::cli
