// luxodus view: serves a live walk through the building, in a browser.
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/findings.hpp"
#include "actors/apps/cli/finished_run.hpp"
#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/nodes_option.hpp"
#include "actors/apps/cli/people_asked.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/cli/serve_view.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/view/live_states.hpp"
#include "actors/cast/process/process_executor.hpp"
#include "runtime/http/served_names.hpp"

namespace luxodus::cli {

namespace {

struct ViewOptions {
  std::string scene;
  HttpAddress server{"127.0.0.1", 8080};
  LiveOptions live;
  std::string scenario;
  std::string at;
  std::string trajectories;
  std::string save_folder = ".";
  std::string particles = "100M";
  int nodes = 0;
};

/// The requested scene; a folder stands for the scene of its run.
Result<SceneState> wanted_state(const ViewOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.scene, ignored))
    return SceneState{options.scene, options.scenario, time_asked(options.at)};
  auto state = scene_of_folder(options.scene);
  if (state && !options.scenario.empty()) state.value().scenario = options.scenario;
  if (state && !options.at.empty()) state.value().at_s = time_asked(options.at);
  return state;
}

Result<ExitCode> view(const ViewOptions& options) {
  auto wanted = wanted_state(options);
  if (!wanted) return wanted.problem();
  const auto [scene, told] =
      load_scene(wanted->scene_file, ReadingWarnings::left_to_inspection, wanted->at_s);
  if (!scene) return exit_code_of(told);
  const std::string scenario = scene->scenarios.empty() ? "" : wanted->scenario;
  const auto found = find_scenario(*scene, scenario);
  if (!found) return found.problem();
  if (const auto refused = refused_by_inspection(scene, {found.value()}, options.live.threads))
    return exit_code_of(*refused);
  auto people = people_of_view(*scene, wanted->scene_file, options.trajectories);
  if (!people) return people.problem();
  install_interrupt_handler();
  const SceneAtTime scene_at = times_of_view(wanted->scene_file, *scene);
  LiveStates states(scene, scene_at);
  std::unique_ptr<ProcessExecutor> nodes;  // outlives all users of its executor
  HubOptions hub{options.live, {}, options.save_folder};
  hub.live.scene_at = scene_at;
  hub.live.judged = FrameScenes::of(*scene, wanted->scene_file, wanted->at_s);
  hub.live.particles = parse_count(options.particles).value();
  hub.first.scenario = scenario;
  hub.people = std::move(people).value();
  if (options.nodes > 0) {
    NodesOptions of_nodes;
    of_nodes.nodes = options.nodes;
    auto compiled = compile_scene(scene, found.value(), {1});
    if (!compiled) return compiled.problem();
    auto started = ProcessExecutor::start(compiled.value(), states, of_nodes);
    if (!started) return started.problem();
    nodes = std::move(started).value();
    hub.live.executor = nodes->executor();
  }
  const auto served = serve_view(scene, options.server, hub, [&] {
    return nodes ? nodes->executor()->goes_on() : Result<void>();
  });
  if (!served) return served.problem();
  return ExitCode::success;
}

}  // namespace

Command view_command() {
  const auto o = std::make_shared<ViewOptions>();
  o->live.threads = default_threads();
  return {.name = "view",
          .summary = "Walk through the building in a browser, live",
          .heading = "Live",
          .options =
              {{"scene",
                &o->scene,
                "Scene file, or the folder of a run or assessment of one",
                {.form = Form::scene, .required = true}},
               {"--scenario",
                &o->scenario,
                "State of the building",
                {.form = Form::name, .otherwise = "the first, or the folder's"}},
               at_option(o->at),
               trajectories_option(o->trajectories),
               {"--port", &o->server.port, "Port of the page; 0: any that is free"},
               {"--address", &o->server.address, "Address to listen on"},
               {"--allow-host",
                &o->server.allowed_hosts,
                "Name (HOST or HOST:PORT) under which browsers may ask for the page, as behind a "
                "proxy; may be repeated",
                {.otherwise = "the address", .check = check_allowed_host}},
               {"--save-folder",
                &o->save_folder,
                "Folder where variants are saved",
                {.form = Form::folder}},
               {"--particles",
                &o->particles,
                "Largest number of particles of each state of the building",
                {.form = Form::count,
                 .check =
                     [](const std::string& text) {
                       const auto count = parse_count(text);
                       return count ? Result<void>() : count.problem();
                     }}},
               {"--seed", &o->live.seed, "Seed of the random number generator"},
               threads_option(o->live.threads),
               nodes_option(o->nodes)},
          .notes =
              "Traces while you walk; dim, move, thicken, and see it at once. Beyond this machine "
              "(--address) the page is served only to those who have the token that is printed.\n"
              "  luxodus view scenes/library/office_floor.toml\n"
              "  luxodus view office.toml --address 0.0.0.0 --port 9000\n"
              "A cluster traces for a view where its file has a table [view]: luxodus cluster up "
              "FILE.",
          .run = [o] { return exit_code_of(view(*o)); }};
}

}  // namespace luxodus::cli
