// luxodus people: trajectories of people who choose their way by the signs that they read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "actors/apps/cli/assess_command.hpp"
#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/cli/version.hpp"
#include "actors/cast/process/in_process.hpp"
#include "actors/judge/walkers/walkers_in_scene.hpp"
#include "actors/results/formats/output_folder.hpp"
#include "runtime/core/log.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

/// The end of the clock of a scene that has none [s].
constexpr double until_without_clock_s = 600;

struct PeopleCommandOptions {
  std::string scene, out = "people.sqlite";
  AssessOptions assess;
  std::string place = "known";
  WalkersRequest request;
  double floor_m = std::nan(""), until_s = std::nan("");
  std::vector<double> leave_at_s, speed_m_s;
  int nodes = 0;
  bool overwrite = false;
  std::vector<std::string> at;
};

Result<void> check_output(const PeopleCommandOptions& o) {
  if (auto ok = check_output_file(o.out); !ok) return ok;
  std::error_code error;
  if (!o.overwrite && fs::exists(fs::symlink_status(o.out, error)))
    return problem_in(o.out,
                      "this file is there: give another --out, or add --overwrite to "
                      "replace it");
  return {};
}

/// The clock, times and speeds of the people. Errors: too many values; an end after the states.
Result<PeopleOptions> people_of(const PeopleCommandOptions& o, const AssessedStates& states) {
  PeopleOptions out = o.request.people;
  const bool has_clock = states.times.size() > 1;
  out.from_s = has_clock ? states.times.front() : 0;
  out.until_s = has_clock ? states.times.back() : until_without_clock_s;
  if (!std::isnan(o.until_s)) {
    if (has_clock && o.until_s > out.until_s)
      return problem_in(o.scene, fmt::format("--until {:g} is after the last state of the scene, "
                                             "at {:g} s",
                                             o.until_s, out.until_s));
    out.until_s = o.until_s;
  }
  if (o.leave_at_s.size() > 2 || o.speed_m_s.size() > 2)
    return problem("--leave-at takes a time or a range, and --speed a mean and a deviation");
  out.leave_from_s = o.leave_at_s.empty() ? out.from_s : o.leave_at_s.front();
  out.leave_to_s = o.leave_at_s.empty() ? out.from_s : o.leave_at_s.back();
  if (!o.speed_m_s.empty()) {
    out.speed_m_s = o.speed_m_s.front();
    out.speed_deviation_m_s = o.speed_m_s.size() == 2 ? o.speed_m_s.back() : 0;
  }
  return out;
}

void print_people(const PeopleOptions& options, const WalkersWalked& walked) {
  std::vector<double> left_s;
  size_t by_sign = 0;
  for (const WalkerOutcome& one : walked.walked.people) {
    if (one.left_s) left_s.push_back(*one.left_s);
    by_sign += one.sign ? 1 : 0;
  }
  std::sort(left_s.begin(), left_s.end());
  const size_t all = walked.walked.people.size();
  std::printf("scenario %s: %zu people on %.3g m2 of the floor at %g m, from %g to %g s\n",
              walked.scenario.c_str(), all, walked.start_m2, walked.floor_m, options.from_s,
              options.until_s);
  if (walked.signs == 0) std::printf("no sign leads along a route of this floor\n");
  if (!left_s.empty())
    std::printf("%zu left, half of them by %.1f s, the last at %.1f s; ", left_s.size(),
                left_s[(left_s.size() - 1) / 2], left_s.back());
  std::printf("%zu are still inside at %g s\n", all - left_s.size(), options.until_s);
  std::printf("%zu followed a sign, %zu the way that they remembered\n", by_sign, all - by_sign);
  if (walked.walked.undecided_looks > 0)
    std::printf(
        "in %zu of %zu looks it is undecided whether a sign is read: it is taken as not read\n",
        walked.walked.undecided_looks, walked.walked.looks);
  for (const RouteUse& one : walked.routes)
    std::printf("  route \"%s\": %zu left, %zu on their way\n", one.route.c_str(), one.left,
                one.inside);
  std::printf(
      "Nobody avoids anybody, and stairs are not walked: this simulates no evacuation, and says "
      "nothing of\nthe available or required safe egress time (ASET, RSET).\n");
  if (walked.floor_m != 0)
    std::printf("the file has no heights: luxodus walk needs floor_m = %g in [[people]]\n",
                walked.floor_m);
}

Result<void> write_people(const PeopleCommandOptions& o, const SceneDescription& scene,
                          WalkersWalked walked) {
  WrittenTrajectories out;
  out.fps = walker_fps;
  out.low = walked.low;
  out.high = walked.high;
  out.metadata = {{"program", fmt::format("Luxodus {}", build.version)},
                  {"scene", fs::path(scene.file).filename().string()},
                  {"scene_hash", fmt::format("{:016x}", scene.content_hash)},
                  {"scenario", walked.scenario},
                  {"seed", fmt::format("{}", o.request.people.seed)}};
  out.places = std::move(walked.walked.places);
  return write_trajectories(o.out, out);
}

Result<ExitCode> people(const PeopleCommandOptions& o) {
  if (auto ok = check_output(o); !ok) return ok.problem();
  const AssessedStates states = assessed_states(o.scene, times_asked(o.at));
  const auto& scene = states.last;
  if (!scene) return exit_code_of(states.told);
  const auto options = people_of(o, states);
  if (!options) return options.problem();
  install_interrupt_handler();
  const auto nodes = nodes_that_trace(o.nodes);
  WalkersRequest request = o.request;
  request.states = {scene, states.times, reader_at_times(*scene, o.scene, FireFrames::nearest)};
  request.options = o.assess;
  request.options.executor = nodes.get();
  request.options.place_unknown = o.place == "unknown";
  request.people = options.value();
  if (!std::isnan(o.floor_m)) request.floor_m = o.floor_m;
  ProgressLine line("people");
  auto walked = walk_in_scene(
      request, interrupt_flag(),
      [&](const std::string& what, double share) { line.show_share(share, ", " + what); });
  if (!walked) {
    if (!interrupt_flag()) return walked.problem();
    log_warning("interrupted; nothing was written");
    return ExitCode::interrupted;
  }
  print_people(request.people, walked.value());
  if (auto ok = write_people(o, *scene, std::move(walked).value()); !ok) return ok.problem();
  std::printf("written to %s\n", o.out.c_str());
  return ExitCode::success;
}

/// Options of where people are, when they leave and how they walk.
std::vector<Option> model_options(PeopleCommandOptions& o) {
  PeopleOptions& people = o.request.people;
  return {
      {"--count",
       &people.count,
       "Number of people",
       {.range = Range{1, static_cast<double>(limits::walkers)}}},
      {"--within",
       &o.request.within,
       "Name of the [[room]] or open area in which they start",
       {.form = Form::name, .otherwise = "the whole floor"}},
      {"--floor-m",
       &o.floor_m,
       "Height of their floor [m]",
       {.otherwise = "that of --within, or the only one", .range = Range{-1e5, 1e5}}},
      {"--came-by",
       &people.came_by,
       "Route along which they came in, and leave while they read no sign",
       {.form = Form::name, .otherwise = "that whose end is nearest"}},
      {"--leave-at",
       &o.leave_at_s,
       "Time at which they set out, or a range [s]",
       {.otherwise = "the begin of the clock", .range = Range{-1e6, 1e6}, .comma_separated = true}},
      {"--until",
       &o.until_s,
       "Time at which the trajectories end [s]",
       {.otherwise = "the end of the clock, or 600", .range = Range{-1e6, 1e6}}},
      {"--speed",
       &o.speed_m_s,
       "Mean and standard deviation of their speeds in clear air [m/s]",
       {.otherwise = "1.34,0.26", .range = Range{0, 5}, .comma_separated = true}},
      {"--step",
       &people.look_s,
       "Time between two looks of a person, in tenths of a second [s]",
       {.range = Range{0.1, 60}}},
      {"--field-of-view",
       &people.field_of_view_deg,
       "Angle in plan within which people look for signs, half of it on each side [deg]",
       {.range = Range{1, 360}}},
      {"--cell",
       &o.request.cell_m,
       "Edge of the cells of the floor on which ways are searched [m]",
       {.range = Range{0.02, 0.25}}}};
}

}  // namespace

Command people_command() {
  const auto o = std::make_shared<PeopleCommandOptions>();
  o->assess.threads = default_threads();
  std::vector<Option> options{
      {"scene", &o->scene, "Scene file", {.form = Form::scene, .required = true}},
      {"--out",
       &o->out,
       "File of trajectories: SQLite of JuPedSim, version 2",
       {.form = Form::file}},
      scenario_option(o->assess),
      times_option(o->at)};
  const auto model = model_options(*o);
  options.insert(options.end(), model.begin(), model.end());
  for (Option& one : std::vector<Option>{
           place_option(o->place),
           {"--seed", &o->request.people.seed,
            "Seed of what is drawn of people; light has the same random numbers for all"},
           threads_option(o->assess.threads),
           nodes_option(o->nodes),
           rounds_option(o->assess),
           {"--overwrite", &o->overwrite, "Replacement of a file that is there"}})
    options.push_back(std::move(one));
  return {.name = "people",
          .summary = "Make trajectories of people who choose their way by the signs that they read",
          .heading = "Assess",
          .options = std::move(options),
          .notes =
              "For those without an evacuation program. People walk on one floor along the route "
              "by which they came in, until they read a sign that leads along a route; then they "
              "go where it leads. Smoke slows them. Nobody avoids anybody, stairs are not walked, "
              "and nothing is said of the available or required safe egress time (ASET, RSET): "
              "this simulates no evacuation.\n"
              "  luxodus people office.toml --count 50 --came-by main --out people.sqlite\n"
              "  luxodus people office.toml --within hall --leave-at 0,60 --seed 2\n"
              "  luxodus walk office.toml --trajectories people.sqlite --out out/walk",
          .run = [o] { return exit_code_of(people(*o)); }};
}

}  // namespace luxodus::cli
