// luxodus view: a live walk through the building, in a browser.
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/findings.hpp"
#include "actors/cli/finished_run.hpp"
#include "actors/cli/serve_view.hpp"
#include "actors/view/live_nodes.hpp"
#include "runtime/http/served_names.hpp"

namespace luxodus::cli {

namespace {

struct ViewOptions {
  std::string scene;
  HttpAddress server{"127.0.0.1", 8080};
  LiveOptions live;
  std::string scenario;
  std::string save_folder = ".";
  std::string particles = "100M";
  int nodes = 0;
};

/// What is asked for: a folder stands for what it is of.
Result<SceneState> wanted_state(const ViewOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.scene, ignored))
    return SceneState{options.scene, options.scenario};
  auto state = scene_of_folder(options.scene);
  if (state.ok() && !options.scenario.empty()) state.value().scenario = options.scenario;
  return state;
}

Result<ExitCode> view(const ViewOptions& options) {
  auto wanted = wanted_state(options);
  if (!wanted.ok()) return wanted.problem();
  const auto scene = load_scene(wanted->scene_file);
  if (!scene) return ExitCode::bad_input;
  const std::string scenario = scene->scenarios.empty() ? "" : wanted->scenario;
  const auto found = find_scenario(*scene, scenario);
  if (!found.ok()) return found.problem();
  if (!passes_inspection(scene, {found.value()}, options.live.threads)) return ExitCode::bad_input;
  install_interrupt_handler();
  HubOptions hub{options.live, {}, options.save_folder};
  hub.live.particles = parse_count(options.particles).value();
  hub.first.scenario = scenario;
  std::unique_ptr<LiveNodes> nodes;
  if (options.nodes > 0) {
    NodesOptions of_nodes;
    of_nodes.nodes = options.nodes;
    auto started = LiveNodes::start(scene, of_nodes);
    if (!started.ok()) return started.problem();
    nodes = std::move(started).value();
    hub.live.tracers = nodes->tracers();
  }
  const auto served = serve_view(scene, options.server, hub);
  if (!served.ok()) return served.problem();
  return ExitCode::success;
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  options->live.threads = default_threads();
  CLI::App* command = app.add_subcommand("view", "Walk through the building in a browser, live");
  command->footer(
      "Traces while you walk; dim, move, thicken, and see it at once. Beyond this machine\n"
      "(--address) the page is served to those alone who have the token that is printed.\n"
      "  luxodus view scenes/library/office_floor.toml\n"
      "  luxodus view office.toml --address 0.0.0.0 --port 9000\n"
      "A cluster traces for a view where its file has a table [view]: luxodus cluster up FILE.");
  command
      ->add_option("scene", options->scene,
                   "scene file (TOML), or the folder of a run or assessment of one")
      ->required();
  command->add_option("--scenario", options->scenario,
                      "state of the building [the first, or the folder's]");
  command->add_option("--port", options->server.port, "port; 0: any that is free [8080]");
  command->add_option("--address", options->server.address, "to listen on [127.0.0.1]");
  command
      ->add_option("--allow-host", options->server.allowed_hosts,
                   "a name under which browsers may ask for the page, as behind a proxy; may be "
                   "repeated [the address]")
      ->check(CLI::Validator(allowed_host_fault, "NAME[:PORT]"));
  command->add_option("--save-folder", options->save_folder, "where variants are saved [.]");
  command
      ->add_option("--particles", options->particles,
                   "of each state of the building, at most [100M]")
      ->check(CLI::Validator(
          [](std::string& text) {
            const auto count = parse_count(text);
            return count.ok() && count.value() > 0 ? "" : "a count such as 500k or 10M is wanted";
          },
          "COUNT"));
  command->add_option("--seed", options->live.seed, "of all random numbers [1]")
      ->check(seed_number());
  command->add_option("--threads", options->live.threads, "threads [all]")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--nodes", options->nodes,
                   "nodes of this process that trace, as those of a cluster do [none: threads]")
      ->check(CLI::Range(1, limits::nodes_in_process));
  command->callback([options, &exit_code] {
    const auto ended = view(*options);
    if (!ended.ok()) tell(ended.problem());
    exit_code = ended.ok() ? ended.value() : ExitCode::bad_input;
  });
}

}  // namespace luxodus::cli
