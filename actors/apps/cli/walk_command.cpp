// luxodus walk: follows people of trajectory files, and says which signs they read on their way.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "actors/apps/cli/assess_command.hpp"
#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/people_asked.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/walk/walk_files.hpp"
#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct WalkCommandOptions {
  std::string scene, out, trajectories;
  AssessOptions assess;
  std::string place = "known";
  WalkOptions walk;
  int nodes = 0;
  std::vector<std::string> at;
};

/// Warns of signs about which nothing is known wherever people could look at them.
void warn_of_undecided(const SceneDescription& scene, const std::vector<PassedSign>& signs) {
  for (size_t i = 0; i < signs.size(); ++i) {
    const double decided_s = signs[i].read_s + signs[i].seen_s + signs[i].invisible_s;
    if (signs[i].undecided_s == 0 || decided_s > 0) continue;
    warn(problem_in(scene.signs[i].place,
                    fmt::format("whether people read the sign \"{}\" is undecided wherever they "
                                "have it in view: luxodus assess says why, from an [[observer]]",
                                scene.signs[i].name)));
  }
}

void print_walk(const WallCheck& walls, const FollowedPeople& followed) {
  const PeopleTotals totals = totals_of(followed.people);
  std::printf("scenario %s: %zu people, %.0f person-seconds\n", followed.scenario.c_str(),
              followed.people.size(), totals.all_s);
  std::printf("%.2g %% of %zu steps cross walls or begin in solids\n", 100 * walls.share(),
              walls.steps);
  std::printf("with a sign that is read: %.1f %% of the time; undecided %.1f %%; without %.1f %%\n",
              100 * totals.read_s / totals.all_s, 100 * totals.undecided_s / totals.all_s,
              100 * totals.unread_s() / totals.all_s);
  std::printf("%zu people never read a sign; the longest time without is %.0f s\n", totals.never,
              totals.longest_unread_s);
}

Result<ExitCode> walk(const WalkCommandOptions& o) {
  const AssessedStates states = assessed_states(o.scene, times_asked(o.at));
  const auto& scene = states.last;
  if (!scene) return exit_code_of(states.told);
  auto people = people_asked(*scene, o.scene, o.trajectories);
  if (!people) return people.problem();
  const auto scenario = judged_scenario(*scene, o.assess.scenario);
  if (!scenario) return scenario.problem();
  const std::vector<PlanLevel> levels = plan_levels(*scene, scenario.value());
  const fs::path folder =
      o.out.empty() ? fs::path("out") / file_name_of(scene->name + "-walked") : fs::path(o.out);
  OutputPlan plan{walk_files, {}};
  for (const char* what : {"map", "animation"})
    for (const std::string& file : level_files(what, levels.size())) plan.files.push_back(file);
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
  const WalkToWrite written{*scene, request.people, request.walk, walked.value(),
                            levels, people->forms,  build.version};
  const FollowedPeople followed = record_of(written);
  if (auto ok = write_walk(out->path(), written, followed); !ok) return ok.problem();
  print_walk(walked->walls, followed);
  warn_of_undecided(*scene, followed.signs);
  std::printf("written to %s\n", out->named().string().c_str());
  return ExitCode::success;
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
           trajectories_option(o->trajectories),
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
           place_option(o->place),
           {"--seed", &o->assess.seed, "Seed of the random number generator"},
           threads_option(o->assess.threads),
           nodes_option(o->nodes),
           rounds_option(o->assess)},
      .notes =
          "Reads SQLite and HDF5 of JuPedSim, text of PeTrack, CSV and JSON of Pathfinder. Signs "
          "count that belong on the way (routes of the scene; all signs where it has none). Writes "
          "people.csv, signs.csv, steps.csv, curve.csv, curve.svg, walk.json, maps of where people "
          "stood without a sign that they read, and animations of them. The report of an "
          "assessment in FOLDER takes in what is written into FOLDER/people. Pictures and films of "
          "people come from a scene with people_as_bodies = true. It says nothing of heat, gases "
          "or the time that is available for escape.\n"
          "  luxodus walk office.toml --trajectories jupedsim.sqlite --out out/walk\n"
          "  luxodus walk office.toml --crowd-hides --step 0.5",
      .run = [o] { return exit_code_of(walk(*o)); }};
}

}  // namespace luxodus::cli
